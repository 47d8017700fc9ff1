"""Stray space: the volume that strays are taken to come from."""

from __future__ import annotations

from sketchloft.cloud import Floats

__all__ = ["stray_space"]

ROOM = 1.5
"""The volume, in that of the points' convex hull."""
WIDE_ROOM = 2.5
"""The same among strokes, which stray as wholes, and few of which fill the thin parts of a thing."""


def stray_space(points: Floats, together: float) -> float:
    """Volume around points, the same from all sides, so that models along any direction can be compared.

    Parameters
    ----------
    points : (n, 3) float array
    together : float
        How many of them go together.
    """
    from scipy.spatial import ConvexHull  # noqa: PLC0415

    return (ROOM if together == 1 else WIDE_ROOM) * float(ConvexHull(points).volume)
