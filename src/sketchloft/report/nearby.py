"""Nearby: the points of a run that lie close to a height, moved to it along the walls."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.stack import Run

__all__ = ["nearby"]

ENOUGH = 500
"""Points of a slab, if the run has so many nearby."""
THICKEST = 0.5
"""Largest half thickness of a slab, as a share of the way to the nearer end of the run."""
THINNEST = 0.002
"""Least half thickness, in the body's unit."""
STEEPEST = 2.0
"""Largest sideways movement per height; walls less steep than that are seen as they are."""


def nearby(points: Floats, run: Run, height: float, low: float, high: float) -> tuple[Floats, float]:
    """Points of a slab about a height within a run, as they would lie at that height.

    Parameters
    ----------
    points : (n, 3) float array
        In the body's frame and unit.
    run : Run
    height, low, high : float
        Middle of the slab, and ends of the run.

    Returns
    -------
    (m, 2) float array
    float
        Half the thickness of the slab.

    Notes
    -----
    Each point keeps its distance from the nearest wall, to first order: it moves along the section's normal
    as the wall does.
    """
    away = np.abs(points[:, 2] - height)
    widest = max(THICKEST * min(height - low, high - height), THINNEST)
    within = away[away <= widest]
    half = float(np.partition(within, ENOUGH)[ENOUGH]) if len(within) > ENOUGH else widest
    half = max(half, THINNEST)
    slab = points[away <= half]
    feet = [wall.foot(slab) for wall in run.walls]
    nearest = np.argmin([np.abs(foot.distance) for foot in feet], axis=0)
    normal = np.stack([foot.normal for foot in feet])[nearest, np.arange(len(slab))]
    flat = np.linalg.norm(normal[:, :2], axis=1)
    slope = np.clip(-normal[:, 2] / np.maximum(flat, 1e-12), -STEEPEST, STEEPEST)
    across = normal[:, :2] / np.maximum(flat, 1e-12)[:, None]
    return slab[:, :2] + ((height - slab[:, 2]) * slope)[:, None] * across, half
