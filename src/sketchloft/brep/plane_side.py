"""Plane side: a flat face of a wall between two straight rims."""

from __future__ import annotations

import numpy as np
from OCP.Geom import Geom_Line, Geom_Plane
from OCP.gp import gp_Ax3

from sketchloft.brep.kernel import CONFUSION, UP, direction, point
from sketchloft.brep.shell_parts import CurvePart
from sketchloft.brep.tube import Side
from sketchloft.cloud import Floats

__all__ = ["line_part", "plane_side"]


def plane_side(bottom: Floats, top: Floats) -> Side:
    """Make the flat face between two rims, each its start and end (2, 3); one of them may be a point."""
    (a, b), (c, d) = bottom, top
    long = max(b - a, d - c, key=lambda rim: float(rim @ rim))
    plane = Geom_Plane(gp_Ax3(point(a), direction(np.cross(long, c - a)), direction(long)))
    return Side(plane, (0, 1), (0, 1), line_part(a, b), line_part(c, d))


def line_part(a: Floats, b: Floats) -> CurvePart:
    """Straight part from a to b; in a tip, where they are one point, its direction does not matter."""
    length = float(np.linalg.norm(b - a))
    return CurvePart(Geom_Line(point(a), direction(b - a) if length > CONFUSION else UP), 0.0, length)
