"""Void cells inside a solid, for which the paper dropped the octree (section 4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Ints
from sketchloft.compare.octree import Octree

__all__ = ["voids_inside"]


@dataclass(frozen=True)
class _Columns:
    """Columns of cubes along z that hold a full one, and the void gaps between the full cubes in them.

    Columns have ascending keys; the neighbours of column k are k - 1, k + 1, k - width, k + width.
    """

    width: int
    key: Ints
    first: Ints
    last: Ints
    gap_column: Ints
    gap_start: Ints
    gap_end: Ints


def voids_inside(octree: Octree) -> int:
    """Count the void cubes that no way through faces of void cubes leads out of.

    Notes
    -----
    The void of a column of cubes is a few gaps between full ones and the two ends, which are
    outside. Gaps of neighbouring columns that overlap are one void. So the work and the memory grow
    with the number of full cubes, however large the space around them.
    """
    from scipy.sparse import coo_array  # noqa: PLC0415  half a second that --help need not pay
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    columns = _columns(octree)
    count = len(columns.gap_start)
    links = [_links(columns, step) for step in (1, -1, columns.width, -columns.width)]
    one, other = (np.concatenate(side) for side in zip(*links, strict=True))
    graph = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(count + 1, count + 1))
    _, void = connected_components(graph, directed=False)
    enclosed = void[:-1] != void[-1]
    return int((columns.gap_end - columns.gap_start + 1)[enclosed].sum())


def _columns(octree: Octree) -> _Columns:
    width = 2**octree.depth + 2
    x, y, z = octree.cells.T + 1
    order = np.lexsort((z, x * width + y))
    column, z = (x * width + y)[order], z[order]
    new = column[1:] != column[:-1]
    gap = np.flatnonzero(~new & (np.diff(z) > 1))
    return _Columns(
        width,
        column[np.r_[True, new]],
        z[np.r_[True, new]],
        z[np.r_[new, True]],
        column[gap],
        z[gap] + 1,
        z[gap + 1] - 1,
    )


def _links(columns: _Columns, step: int) -> tuple[Ints, Ints]:
    """Pairs of gaps that touch between neighbouring columns; the number after the last gap is outside."""
    count = len(columns.gap_start)
    beside = columns.gap_column + step
    outside = np.flatnonzero(_reaches_out(columns, beside))
    start = columns.gap_column * columns.width + columns.gap_start
    end = columns.gap_column * columns.width + columns.gap_end
    low = np.searchsorted(end, beside * columns.width + columns.gap_start, side="left")
    high = np.searchsorted(start, beside * columns.width + columns.gap_end, side="right")
    one = np.repeat(np.arange(count), high - low)
    other = np.arange(len(one)) + np.repeat(low - np.cumsum(high - low) + (high - low), high - low)
    return np.concatenate([one, outside]), np.concatenate([other, np.full(len(outside), count)])


def _reaches_out(columns: _Columns, beside: Ints) -> NDArray[np.bool_]:
    """Whether each gap touches the void above, below or instead of the full cubes of a column."""
    at = np.searchsorted(columns.key, beside).clip(max=len(columns.key) - 1)
    missing = columns.key[at] != beside
    return missing | (columns.gap_start < columns.first[at]) | (columns.gap_end > columns.last[at])
