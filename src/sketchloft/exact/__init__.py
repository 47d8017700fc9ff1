"""The exact method.

`body` is its orchestrator, `planned` the same from a plan. Imports run one way through the packages: `model`,
what is fitted; `fit`, how likely the points are and the climb to where they are most likely; `section`, the
outline and walls of one segment; `changes`, what a stack could be instead and whether that pays; `start`, the
direction and the first stack; `search`, from there to the end.
"""
