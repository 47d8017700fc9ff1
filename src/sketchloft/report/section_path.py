"""Section path: the closed curve in which a wall cuts a plane across the slicing direction."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.outline import Arc, Closed, Edge, Segment
from sketchloft.shapes.spline import ClosedSpline
from sketchloft.stack import Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["section_path"]

STEPS = 240
"""Pieces that a whole curve is drawn with."""
ARC_STEPS = 24
TURN = 2 * np.pi * np.arange(STEPS + 1) / STEPS


def section_path(wall: Wall, height: float) -> Floats:
    """Points (m, 2) along the section of a wall at a height, the first repeated at the end."""
    match wall:
        case Revolved(centre, profile):
            radius = float(radius_at(profile, np.array([height]))[0][0])
            return np.asarray(centre + radius * np.column_stack([np.cos(TURN), np.sin(TURN)]))
        case Swept():
            return _swept(wall, height)
        case Ruled():
            tau = np.linspace(-1, 1, ARC_STEPS + 1)
            path = wall.ring(np.array([height]), tau)[0].reshape(-1, 2)
            return np.concatenate([path, path[:1]])
        case Filleted():
            return np.concatenate([_along(edge) for edge in wall.section(height).edges()])
        case Lofted():
            return wall.ring(np.array([height]), np.arange(STEPS + 1) / STEPS)[0]


def _swept(wall: Swept, height: float) -> Floats:
    """The outline, carried to the height."""
    path = np.concatenate([_along(edge) for edge in wall.outline.edges()])
    return wall.carried(path, np.array([height]))[0]


def _along(edge: Edge) -> Floats:
    """Points (m, 2) along an edge, from its start to its end."""
    match edge:
        case Segment(start, end):
            return np.stack([start, end])
        case Arc(start, middle, end):
            return _arc(start, middle, end)
        case Closed("spline", poles):
            return ClosedSpline(poles).evaluate(np.arange(STEPS + 1) / STEPS)
        case Closed(_, poles):
            centre, (major, minor) = poles[:2]
            x, y = poles[2] if len(poles) > 2 else (1.0, 0.0)
            on_axes = np.column_stack([major * np.cos(TURN), minor * np.sin(TURN)])
            return np.asarray(centre + on_axes @ np.array([[x, y], [-y, x]]))


def _arc(start: Floats, middle: Floats, end: Floats) -> Floats:
    """Points along the circle through three points; a straight line if they lie on one."""
    a, b = middle - start, end - start
    cross = 2 * float(a[0] * b[1] - a[1] * b[0])
    if abs(cross) <= 1e-12 * float(b @ b):
        return np.stack([start, end])
    lift = (a @ a) * b - (b @ b) * a
    spoke = np.array([-lift[1], lift[0]]) / cross  # from the centre to the start
    centre = start - spoke
    first, last = np.arctan2(spoke[1], spoke[0]), np.arctan2(*(end - centre)[::-1])
    sweep = (last - first) % (2 * np.pi) if cross > 0 else -((first - last) % (2 * np.pi))
    angle = first + sweep * np.arange(ARC_STEPS + 1) / ARC_STEPS
    radius = float(np.hypot(*spoke))
    return np.asarray(centre + radius * np.column_stack([np.cos(angle), np.sin(angle)]))
