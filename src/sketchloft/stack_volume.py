"""The volume of a stack, from the areas of its sections."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.gauss import gauss_between
from sketchloft.stack import Stack, Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["stack_volume"]

POINTS = 6
"""Gauss points of a span; exact for the squares of cubics."""
ARC_POINTS = 16


def stack_volume(stack: Stack) -> float:
    """Volume of a stack.

    Notes
    -----
    Gauss-Legendre quadrature along z of the areas of the sections, span by span of splines; on arcs in
    their angle, where the radius is smooth up to the pole.
    """
    total = 0.0
    for run, low, high in stack.slabs():
        for index, wall in enumerate(run.walls):
            heights, weights = _quadrature(wall, low, high)
            total += run.sign(index) * float(wall.area(heights) @ weights)
    return total


def _quadrature(wall: Wall, low: float, high: float) -> tuple[Floats, Floats]:
    """Heights and weights between two heights."""
    if not isinstance(wall, Revolved):
        return _swept_quadrature(wall, low, high)
    match wall.profile:
        case SplineProfile(knots):
            return gauss_between(_ends(knots, low, high), POINTS)
        case LineProfile(height, radius, slope) if slope:  # a cone ends at its apex
            return gauss_between(_ends(np.array([height - radius / slope]), low, high), POINTS)
        case ArcProfile(height, offset, radius):
            reach = (
                np.sqrt(max(radius**2 - (offset or 0.0) ** 2, 0.0)) if (offset or 0.0) < radius else radius
            )
            ends = np.clip([low, high], height - radius, height + radius)
            inner = height + np.array([-reach, reach])
            sines = (_ends(inner, float(ends[0]), float(ends[1])) - height) / radius
            angles = np.arcsin(np.clip(sines, -1, 1))
            angle, weights = gauss_between(angles, ARC_POINTS)
            return height + radius * np.sin(angle), weights * radius * np.cos(angle)
    return gauss_between(np.array([low, high]), POINTS)


def _swept_quadrature(
    wall: Swept | Ruled | Filleted | Lofted, low: float, high: float
) -> tuple[Floats, Floats]:
    """The same of a wall that is not revolved."""
    if isinstance(wall, Lofted):
        return gauss_between(_ends(wall.knots, low, high), POINTS)
    if isinstance(wall, Filleted):
        heights, weights = zip(*wall.spans(low, high), strict=True)
        return np.concatenate(heights), np.concatenate(weights)
    return gauss_between(np.clip(wall.tips(), low, high), POINTS)


def _ends(inner: Floats, low: float, high: float) -> Floats:
    return np.unique(np.concatenate([[low, high], inner[(inner > low) & (inner < high)]]))
