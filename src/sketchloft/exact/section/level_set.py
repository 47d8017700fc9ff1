"""Level set: the density of the points on a grid, and where it falls to half of what it is inside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints

__all__ = ["LevelSet", "hollow_share", "level_set", "on_grid"]

POINTS_PER_BLUR = 22.0
"""Points that the blurring kernel averages over inside."""
CELLS_PER_BLUR = 1.25
WIDE = 3.0
"""The inside density around a place is averaged over this many blurs."""
MOST_CELLS = 2_000_000
PIECE = 0.02
"""Share of the points that a piece holds at least."""


@dataclass(frozen=True)
class LevelSet:
    """Blurred density relative to the one inside nearby.

    Parameters
    ----------
    origin : (d,) float array
        Centre of the first cell.
    cell : float
        Width of a cell.
    blur : float
        Standard deviation of the blur.
    counts : float32 array of d axes
        Points in each cell.
    level : float32 array of d axes
        1 deep inside, one half on the wall, 0 outside.
    around : float32 array of d axes
        Points per cell inside nearby.
    inside : bool array of d axes
        The connected pieces above one half that hold a fair share of the points.
    """

    origin: Floats
    cell: float
    blur: float
    counts: NDArray[np.float32]
    level: NDArray[np.float32]
    around: NDArray[np.float32]
    inside: NDArray[np.bool_]


def level_set(points: Floats, together: float = 1.0) -> LevelSet:
    """Blur a histogram of the points (n, d), in space or in a plane, and compare it with the density inside.

    Parameters
    ----------
    points : (n, d) float array
    together : float
        How many of the points go together where they are blurred (`clump`).

    Notes
    -----
    The blur is as wide as is needed to average over some 20 points, so it falls with the cube root of
    their number. The inside density nearby is the blurred density as points see it, averaged over a
    wider neighbourhood, so a cloud drawn denser at one end has its walls in the right place at both.
    """
    from scipy import ndimage  # noqa: PLC0415

    axes = points.shape[1]
    low, high = np.quantile(points, [0.002, 0.998], axis=0)
    volume = 0.5 * float(np.prod(np.maximum(high - low, 1e-9)))
    for _ in range(2):
        blur = (POINTS_PER_BLUR * together * volume / len(points)) ** (1 / axes) / (2 * np.sqrt(np.pi))
        blur = max(blur, CELLS_PER_BLUR * float(np.prod(high - low) / MOST_CELLS) ** (1 / axes))
        cell = blur / CELLS_PER_BLUR
        origin = low - 5 * blur
        shape = np.ceil((high - low + 10 * blur) / cell).astype(int) + 1
        index, _ = _cells(points, origin, cell, shape)
        flat = np.ravel_multi_index(index, tuple(shape))
        counts = np.bincount(flat, minlength=int(np.prod(shape))).reshape(shape).astype(np.float32)
        density = ndimage.gaussian_filter(counts, CELLS_PER_BLUR, truncate=3)
        seen, all_points = (
            ndimage.gaussian_filter(a, WIDE * CELLS_PER_BLUR, truncate=2) for a in (counts * density, counts)
        )
        occupied = np.sort(density[counts > 0])
        typical = float(occupied[int(0.6 * len(occupied))])
        around = np.maximum(seen / np.maximum(all_points, 1e-6), 0.1 * typical)
        level = density / around
        inside = _large_pieces(level > 0.5, counts)
        volume = max(float(inside.sum()) * cell**axes, 1e-12)
    return LevelSet(origin, cell, blur, counts, level, around, inside)


def _cells(
    points: Floats, origin: Floats, cell: float, shape: Ints
) -> tuple[tuple[Ints, ...], NDArray[np.bool_]]:
    """Indices of the cells that points (n, d) lie in, one array an axis, and which points (n,) lie in any."""
    index = np.rint((points - origin) / cell).astype(np.intp)
    within = np.all((index >= 0) & (index < shape), axis=1)
    return tuple(index[within].T), np.asarray(within)


def _large_pieces(mask: NDArray[np.bool_], counts: NDArray[np.float32]) -> NDArray[np.bool_]:
    from scipy import ndimage  # noqa: PLC0415

    labels, count = ndimage.label(mask)
    held = np.bincount(labels.ravel(), counts.ravel(), count + 1)
    held[0] = 0.0
    kept: NDArray[np.bool_] = (held >= PIECE * held.sum())[labels]
    return kept


def hollow_share(grid: LevelSet) -> float:
    """Share of the volume that the inside encloses without filling it: near 1 for a closed skin."""
    from scipy import ndimage  # noqa: PLC0415

    filled = ndimage.binary_fill_holes(grid.inside)
    return 1.0 - float(grid.inside.sum()) / max(float(filled.sum()), 1.0)


def on_grid(grid: LevelSet, points: Floats, margin: float) -> NDArray[np.bool_]:
    """(n,) whether points lie within a margin of the inside."""
    from scipy import ndimage  # noqa: PLC0415

    far = ndimage.distance_transform_edt(~grid.inside) * grid.cell
    index, within = _cells(points, grid.origin, grid.cell, np.array(grid.level.shape))
    found = np.zeros(len(points), dtype=bool)
    found[within] = far[index] <= margin
    return found
