"""The exact method, in the order in which a body passes through it.

`body` is its orchestrator. robust_size, level_set, dispersion, inside_density: what the points say by
themselves. direction, rule_likelihood: along which axis. segments, section_contours, twist,
recognise_section, segment_walls, first_stack: the first walls, segment by segment. model, density, joins,
soundness, expected, likelihood, fit: how well walls explain points, and how they move. evidence, trial,
changes, simpler_walls, surgery, misfit, free_walls, loft_start, schwarz: which walls are worth having.
upright, coaxial, tilt, sharpen, flush: the last fit. planned: the same from a plan.
"""
