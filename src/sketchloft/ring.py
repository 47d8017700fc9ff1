"""Rings: closed polygons of points in the plane, counter-clockwise, the first point not repeated."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats

__all__ = [
    "following",
    "ring_area",
    "ring_centre",
    "ring_depth",
    "ring_hull",
    "ring_is_simple",
    "ring_length",
]

T = TypeVar("T", bound=np.generic)

BLOCK = 4_000_000
"""Point-segment pairs that are worked on at once."""


def following(rows: NDArray[T]) -> NDArray[T]:
    """What comes after each of the rows (m, ...) of a ring; `np.roll` takes several times as long."""
    return np.concatenate((rows[1:], rows[:1]))


def ring_area(ring: Floats) -> float:
    """Signed area of a ring (m, 2), positive when counter-clockwise."""
    x, y = (ring - ring[0]).T
    return float((x * following(y) - y * following(x)).sum() / 2)


def ring_length(ring: Floats) -> float:
    """Length once around a ring (m, 2)."""
    return float(np.linalg.norm(following(ring) - ring, axis=1).sum())


def ring_centre(ring: Floats) -> Floats:
    """(2,) centroid of the area within a ring (m, 2)."""
    local = ring - ring[0]
    x, y = local.T
    cross = x * following(y) - y * following(x)
    return ring[0] + ((local + following(local)) * cross[:, None]).sum(axis=0) / (3 * cross.sum())


def ring_is_simple(ring: Floats) -> bool:
    """Whether a ring (m, 2) does not cross itself."""
    from shapely import LinearRing  # noqa: PLC0415  a fifth of a second that not every command needs

    return bool(LinearRing(ring).is_simple)


def ring_hull(ring: Floats) -> Floats:
    """Convex hull of a ring (m, 2), as a ring of some of its points."""
    from shapely import MultiPoint, get_coordinates  # noqa: PLC0415  as above

    hull: Floats = get_coordinates(MultiPoint(ring).convex_hull)
    return hull[:0:-1]  # shapely turns clockwise


def ring_depth(points: Floats, ring: Floats) -> Floats:
    """Distance (n,) of points (n, 2) from a ring (m, 2), negative outside."""
    rows = max(1, BLOCK // len(ring))
    parts = [_depth(points[i : i + rows], ring) for i in range(0, len(points), rows)]
    return np.concatenate(parts) if parts else np.zeros(0)


def _depth(points: Floats, ring: Floats) -> Floats:
    along = following(ring) - ring
    x, y = (points[:, None] - ring).transpose(2, 0, 1)
    ax, ay = along.T
    share = ((x * ax + y * ay) / np.maximum(ax * ax + ay * ay, 1e-300)).clip(0.0, 1.0)
    distance = np.sqrt(np.square(x - share * ax) + np.square(y - share * ay)).min(axis=1)
    # Crossings of a ray to the right: an edge crosses when one end is above the point and one is not.
    above = y > 0
    right = np.where(above, 1.0, -1.0) * (x * ay - y * ax) < 0
    crossed = (above != np.roll(above, -1, axis=1)) & right
    return np.where(crossed.sum(axis=1) % 2 == 1, distance, -distance)
