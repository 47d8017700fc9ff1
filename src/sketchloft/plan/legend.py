"""The legend at the top of a plan: what it says, and how to edit it."""

__all__ = ["LEGEND"]

LEGEND = """\
# A plan of sketchloft: what was found in a cloud of points, to be read, edited and given back:
#     sketchloft build CLOUD --plan THIS_FILE
#
# fit = "nothing" keeps every number as it is written here. fit = "sizes" keeps the direction, the kinds and
# the number of runs, and fits the numbers to the points once more, starting from these; a body may have a
# fit of its own.
#
# A body is a pile of runs along its direction. Heights are along the direction, x and y across it, all from
# the centre and in the unit of the cloud; direction, x_axis and centre are in the cloud's own coordinates.
# Breaks, from low to high, are where the runs end, one break more than runs. A step is a plane at its
# height. The height of the others follows from the walls, near the one written: they cross, one is an arc
# that ends tangent to a line, or an arc meets the axis, or the other half of its torus, in a pole. Of two
# walls that share an outline the one that tapers, drifts or twists leaves the other one at its own height;
# edit that. To move another such break yourself, make it { height = ..., join = "step" }. To take out a run,
# take out one of the breaks beside it too.
#
# A run has one wall or more; walls with hole = true bound holes and come last. To close a hole, take out its
# wall. To change what a wall is, change its kind and give the keys of that kind:
#     cylinder           centre, radius
#     cone               centre, radius at height, slope: radius per height; without a slope it is a cylinder
#     sphere             centre, height of the centre, radius
#     torus              centre, height, minor_radius, major_radius, side = "outer" or "inner" (a waist)
#     spline revolve     centre, knots: heights, radii: the poles of the cubic spline r(height)
#     filleted prism     centre, width, depth, angle, fillet: radius along the edges, corners = "round" (the
#                        same fillet there) or "sharp", ends = "both", "bottom" or "top"
#     ruled              bottom_vertices, bottom_bulges, top_vertices, top_bulges: the outlines at both ends
#                        of the run, as many edges each, as those of a line-arc
#     square to round    square_centre, width, depth, angle: the rectangle at the bottom of the run, as below;
#                        round_centre, radius, first_cut, stagger: the circle at the top, cut in four where
#                        lines lead to it from the corners, at first_cut + stagger, first_cut + 90 - stagger,
#                        first_cut + 180 + stagger, first_cut + 270 - stagger
#     round to square    the same, the circle at the bottom
#     rectangle to rectangle  bottom_centre, bottom_width, bottom_depth, bottom_angle: the rectangle at the
#                        bottom of the run; top_centre, top_width, top_depth, top_angle: that at the top
#     loft               knots: heights, from break to break of its run, poles: a ring of points for each
#                        pole along the heights
#     circle             centre, radius
#     ellipse            centre, major_radius, minor_radius, angle
#     rectangle          centre, width, depth, angle of the width from x
#     rounded rectangle  centre, width, depth, angle, corner_radius
#     stadium            centre, length between the centres of its arcs, radius, angle of the length from x
#     regular polygon    centre, radius to the corners, angle of the first corner, sides
#     star               centre, radius to the tips, inner_radius to the corners between them, angle of the
#                        first tip, tips
#     rectilinear polygon  angle of the first edge, offsets of all from the origin, counter-clockwise: of the
#                        first, third, ... across that direction, of the others along it
#     polygon            vertices, counter-clockwise
#     rounded polygon    vertices, corner_radius
#     line-arc           vertices, bulges: tan(sweep / 4) of the arc after each vertex, 0 for a line
#     spline             poles of a closed cubic spline, counter-clockwise
# From circle on, walls are extruded from their outline, and may move along the heights: drift [x, y] per
# height, taper: growth per height as a share of the size at height, twist: degrees per height, both about
# pivot, or the outline's middle where none is given, and bow, which closes the wall like a dome: of z above
# height, the size is sqrt((1 + taper z)^2 - (bow z)^2). Angles are in degrees. A value may be the name of one
# in [body.shared], which then is the same for all walls that name it.
"""
