"""Octree: full and void cubes of a cloud (paper, section 3.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.errors import CloudError, UsageError

__all__ = ["MAX_DEPTH", "Octree", "octree_cells"]

MAX_DEPTH = 20
"""Three coordinates of this many bits fit a 64-bit key."""
POINTS_PER_CUBE = 6.0
"""Points in a full cube on average at which the boundary is nearest to the goal: with more the cubes are
coarse, with fewer some inside are void by chance (measured on evenly filled goals)."""
SPREAD = (
    (32, 0x1F00000000FFFF),
    (16, 0x1F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)
"""Shifts and masks that move the bits of a number three places apart."""


@dataclass(frozen=True)
class Octree:
    """The full cubes at the last level of an octree; all others at that level are void.

    Parameters
    ----------
    origin : (3,) float array
        Lowest corner of the whole.
    edge : float
        Of a cube at the last level.
    depth : int
        How often the whole was divided: it holds 8**depth cubes.
    cells : (k, 3) int array
        Indices of the full cubes along x, y and z, from 0, in Morton order.
    counts : (k,) int array
        How many points each holds.
    """

    origin: Floats
    edge: float
    depth: int
    cells: Ints
    counts: Ints


def octree_cells(points: Floats, depth: int | None = None) -> Octree:
    """Divide the smallest cube about the points again and again into eight, and tell full from void.

    Parameters
    ----------
    points : (n, 3) float array
        Not all equal.
    depth : int, optional
        How often to divide. If not given, so often that full cubes hold about `POINTS_PER_CUBE` points.

    Returns
    -------
    Octree

    Raises
    ------
    CloudError
        If the points are all equal.
    UsageError
        If the depth is not between 1 and `MAX_DEPTH`.

    Notes
    -----
    An octant with full and void parts is mixed and is divided, down to the last level; one whose parts
    are alike is full or void as a whole, which doesn't change the boundary. So the full cubes of the
    last level are the whole tree (Gargantini's linear octree). Sorted by Morton key, the cubes of every
    level are runs of points, and all levels are counted by comparing neighbours.

    References
    ----------
    D. Meagher, Geometric modeling using octree encoding, Computer Graphics and Image Processing 19, 1982.
    I. Gargantini, An effective way to represent quadtrees, Communications of the ACM 25(12), 1982.
    """
    if depth is not None and not 1 <= depth <= MAX_DEPTH:
        raise UsageError(f"octree depth: found {depth}, expected 1 to {MAX_DEPTH}")
    low, high = points.min(axis=0), points.max(axis=0)
    side = float((high - low).max())
    if side == 0:
        raise CloudError(f"octree: found {len(points)} equal points, expected a cloud with an extent")
    origin = (low + high - side) / 2
    places = ((points - origin) * (2.0**MAX_DEPTH / side)).astype(np.int64).clip(0, 2**MAX_DEPTH - 1)
    x, y, z = (_spread(column) for column in places.T)
    key = x | y << 1 | z << 2
    order = np.argsort(key)
    changed = np.bitwise_xor(key[order[1:]], key[order[:-1]])
    if depth is None:
        depth = _depth_by_filling(changed)
    first = np.flatnonzero(np.r_[True, _differs(changed, depth)])
    counts = np.diff(np.r_[first, len(points)])
    return Octree(origin, side / 2**depth, depth, places[order[first]] >> (MAX_DEPTH - depth), counts)


def _spread(places: Ints) -> Ints:
    """Move the bits of each number three places apart."""
    for shift, mask in SPREAD:
        places = (places | places << shift) & mask
    return places


def _differs(changed: Ints, depth: int) -> NDArray[np.bool_]:
    """Whether neighbours in Morton order lie in different cubes of a level."""
    return changed >> 3 * (MAX_DEPTH - depth) != 0


def _depth_by_filling(changed: Ints) -> int:
    """The level whose full cubes hold `POINTS_PER_CUBE` points on average, or the nearest, by ratio."""
    levels = range(1, MAX_DEPTH + 1)
    full = np.array([1 + np.count_nonzero(_differs(changed, level)) for level in levels])
    ratio = (len(changed) + 1) / full / POINTS_PER_CUBE
    return levels[int(np.abs(np.log(ratio)).argmin())]
