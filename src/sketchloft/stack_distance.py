"""The distance of points from the surface of a stack."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.stack import Stack
from sketchloft.wall.lofted import Lofted

__all__ = ["distance_from_stack"]

NONE = 1e-7
"""A distance that is none, in a stack about 1 across."""
PER_POLE = 64
"""Sides of the polygon that stands for a section of a lofted wall, per pole around."""


def distance_from_stack(points: Floats, stack: Stack) -> Floats:
    """Distance (n,) of points (n, 3) from the nearest break, or wall of the run that they are in.

    Notes
    -----
    First order exact near the surface. All of a break's plane counts, not its ledges alone.
    """
    away = np.abs(points[:, 2, None] - stack.breaks).min(axis=1)
    index = np.clip(np.searchsorted(stack.breaks, points[:, 2]) - 1, 0, len(stack.runs) - 1)
    for i, run in enumerate(stack.runs):
        for wall in run.walls:
            rows = np.flatnonzero((index == i) & (away > NONE))
            away[rows] = np.minimum(away[rows], np.abs(wall.foot(points[rows]).distance))
            if isinstance(wall, Lofted):
                # The few Newton steps of its foot, made for fits, do not always end at the nearest point.
                rows = rows[away[rows] > NONE]
                away[rows] = np.minimum(away[rows], _distance_from_loft(points[rows], wall))
    return away


def _distance_from_loft(points: Floats, wall: Lofted) -> Floats:
    """Distance (n,) of points from the sections at their heights, taken as polygons."""
    count = PER_POLE * wall.poles.shape[1]
    rings = wall.ring(points[:, 2], np.arange(count + 1) / count)
    along = np.diff(rings, axis=1)
    spokes = points[:, None, :2] - rings[:, :-1]
    share = np.einsum("nkd,nkd->nk", spokes, along) / np.einsum("nkd,nkd->nk", along, along)
    gaps = spokes - np.clip(share, 0, 1)[..., None] * along
    nearest: Floats = np.sqrt(np.einsum("nkd,nkd->nk", gaps, gaps).min(axis=1))
    return nearest
