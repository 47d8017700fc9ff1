"""Beside ball: the direction from the middle of a ball that fits the wall to what sticks out of it."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["beside_ball"]

FAR = np.geomspace(0.05, 0.02, 8)
"""Distances from the ball, in sizes of the cloud, at which a piece of wall counts a quarter, step by step."""
CLEAR = 0.05
"""Distance from the ball from which on points stick out."""
FEWEST = 0.01
"""Share of the points that stick out at least, for these to tell where the rest is."""


def beside_ball(points: Floats, at: Floats) -> Floats | None:
    """Direction (3,) from the middle of a ball to the points outside it.

    Parameters
    ----------
    points : (n, 3) float array
        About 1 across.
    at : (k, 3) float array
        Places on the wall.

    Notes
    -----
    A ball looks the same from everywhere, so that normals hardly tell the axis of a ball and what is on it.
    But if the thing is revolved as a whole, the axis goes through both. The ball is fitted by
    ``|x|**2 = 2 c x + d``, least squares, weighted anew. None where nothing sticks out of it.
    """
    rows = np.column_stack([2 * at, np.ones(len(at))])
    weight = np.ones(len(at))
    for far in FAR:
        root = np.sqrt(weight)
        found = np.linalg.lstsq(rows * root[:, None], (at**2).sum(axis=1) * root, rcond=None)[0]
        centre, radius = found[:3], np.sqrt(max(float(found[3] + found[:3] @ found[:3]), 0.0))
        miss = np.linalg.norm(at - centre, axis=1) - radius
        weight = 1 / (1 + (miss / far) ** 2) ** 2
    outside = points[np.linalg.norm(points - centre, axis=1) > radius + CLEAR]
    if len(outside) < FEWEST * len(points):
        return None
    arm = outside.mean(axis=0) - centre
    length = float(np.linalg.norm(arm))
    return np.asarray(arm / length) if length > CLEAR else None
