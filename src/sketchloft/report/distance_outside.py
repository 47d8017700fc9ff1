"""Distance outside: how far points lie out of a stack, negative within it."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.stack import Run, Stack

__all__ = ["distance_from_walls", "distance_outside"]

AT_ONCE = 16_384
"""Points that are looked at together; walls of many parameters need much memory for each."""


def distance_outside(points: Floats, stack: Stack) -> Floats:
    """Signed distance of points from a stack.

    Parameters
    ----------
    points : (n, 3) float array
        In the stack's frame and unit.
    stack : Stack

    Returns
    -------
    (n,) float array
        Positive outside. As exact as the walls' own distances: to first order near the surface.

    Notes
    -----
    Outside it is the least of the distances from the runs; inside it is the way to the wall or to a ledge.
    The end of a run is no ledge where the next run's section goes on: there the way leads to that
    section's rim.
    """
    parts = [points[i : i + AT_ONCE] for i in range(0, len(points), AT_ONCE)]
    return np.concatenate([_distance(part, stack) for part in parts]) if parts else np.zeros(0)


def distance_from_walls(points: Floats, stack: Stack) -> Floats:
    """Signed distance (n,) of points (n, 3) from the walls of the run they are in; NaN beyond the ends."""
    found = np.full(len(points), np.nan)
    for run, low, high in stack.slabs():
        rows = np.flatnonzero((points[:, 2] >= low) & (points[:, 2] < high))
        if len(rows):
            found[rows] = _from_section(points[rows], run)
    return found


def _distance(points: Floats, stack: Stack) -> Floats:
    z, breaks = points[:, 2], stack.breaks
    within = [_from_section(_clamped(points, low, high), run) for run, low, high in stack.slabs()]
    outside = np.full(len(points), np.inf)
    depth = np.zeros(len(points))
    for j, section in enumerate(within):
        down, up = z - breaks[j], breaks[j + 1] - z
        beyond = np.maximum(-np.minimum(down, up), 0.0)
        outside = np.minimum(outside, np.hypot(np.maximum(section, 0.0), beyond))
        ends = [
            np.hypot(way, np.maximum(-within[k], 0.0)) if 0 <= k < len(within) else way
            for way, k in ((down, j - 1), (up, j + 1))
        ]
        held = (section <= 0) & (beyond == 0)
        depth = np.where(held, np.maximum(depth, np.minimum(-section, np.minimum(*ends))), depth)
    return np.where(outside > 0, outside, -depth)


def _clamped(points: Floats, low: float, high: float) -> Floats:
    """Points (n, 3) with their heights brought between two."""
    return np.column_stack([points[:, :2], np.clip(points[:, 2], low, high)])


def _from_section(points: Floats, run: Run) -> Floats:
    """Signed distance (n,) from a run's walls, without its ends."""
    distance = [wall.foot(points).distance for wall in run.walls]
    outer = len(distance) - run.holes
    section = np.minimum.reduce(distance[:outer]) if outer else np.full(len(points), -np.inf)
    return np.asarray(np.maximum.reduce([section, *(-hole for hole in distance[outer:])]))
