"""Stage 2: find the slicing direction (paper, section 4.3)."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Literal

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.errors import UsageError
from sketchloft.frame import principal_axes

__all__ = ["Direction", "DirectionParams", "parse_axis", "slicing_direction"]

Axis = Literal["auto"] | tuple[float, float, float]

NAMED: dict[str, tuple[float, float, float]] = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}
SAMPLE = 50_000
"""Points that the directions are judged on."""
SLABS = 7
CELL_POINTS = 10
"""About how many points of a slab fall into a cell of the grid that sections are compared on."""
SIZE_WEIGHT = 0.1
"""What a change of size counts against the same change of shape."""
PART_SHARE = 0.05
"""Parts and holes of a section smaller than this share of it do not count."""
TIE = 6.0
"""Values of the target function that differ by less than this over the root of the number of points are
equal."""


@dataclass(frozen=True)
class DirectionParams:
    """How the slicing direction is chosen.

    Parameters
    ----------
    axis : "auto" or (3,) tuple of float
        Any vector but zero, or "auto" to find it.
    """

    axis: Axis = "auto"


@dataclass(frozen=True)
class Direction:
    """The slicing direction and what it was chosen from.

    Parameters
    ----------
    vector : (3,) float array
        Unit vector.
    candidates : (c, 3) float array
        Unit vectors that were compared; empty when the direction was given.
    targets : (c,) float array
        Their values of the target function; the least is best.
    """

    vector: Floats
    candidates: Floats
    targets: Floats


def parse_axis(text: str) -> Axis:
    """Read "auto", "x", "y", "z" or three numbers with commas between them.

    Raises
    ------
    UsageError
        If the text is none of these, or the vector is zero or not finite.
    """
    word = text.strip().lower()
    if word == "auto":
        return "auto"
    if word in NAMED:
        return NAMED[word]
    try:
        x, y, z = (float(part) for part in word.split(","))
    except ValueError:
        raise UsageError(
            f"axis: found '{text}', expected x, y, z, auto, or three numbers such as 0,0.2,1"
        ) from None
    if not np.isfinite([x, y, z]).all() or x == y == z == 0:
        raise UsageError(f"axis: found the vector '{text}', expected one that is finite and not zero")
    return (x, y, z)


def slicing_direction(points: Floats, params: DirectionParams) -> Direction:
    """Choose the direction in which the sections change least and stay one simple contour.

    Parameters
    ----------
    points : (n, 3) float array
        About their centre, in canonical order.
    params : DirectionParams

    Returns
    -------
    Direction

    Notes
    -----
    The paper names three ways: by hand, the best of x, y and z, or the minimum of a target function. Here
    a given vector always wins; else x, y, z and the principal axes are candidates, and the target
    function is the sum, over neighbouring slabs across the direction, of the change of shape (squared
    difference of the densities after centring and scaling, with the part that chance explains taken
    off), a tenth of the change of size, and the number of further parts and holes. People draw along the
    axes of their coordinate system, so that of equal candidates x, y or z is taken, the longest extent
    first.
    """
    if params.axis != "auto":
        vector = np.array(params.axis, dtype=np.float64)
        return Direction(vector / np.linalg.norm(vector), np.zeros((0, 3)), np.zeros(0))
    sample = points[:: -(-len(points) // SAMPLE)]
    candidates = np.concatenate([np.eye(3), principal_axes(sample)])
    targets = np.array([_target(sample, vector) for vector in candidates])
    extents = np.ptp(sample @ candidates.T, axis=0)
    equal = np.flatnonzero(targets <= targets.min() + TIE / np.sqrt(len(sample)))
    best = max(equal.tolist(), key=lambda i: (i < 3, round(float(extents[i] / extents.max()), 2)))
    return Direction(candidates[best], candidates, targets)


def _target(points: Floats, direction: Floats) -> float:
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    across = np.cross(helper, direction)
    across /= np.linalg.norm(across)
    height = points @ direction
    plane = points @ np.stack([across, np.cross(direction, across)], axis=1)
    low, high = np.quantile(height, [0.002, 0.998])
    slab = np.floor((height - low) / (high - low) * SLABS).astype(np.intp)
    parts = [plane[slab == i] for i in range(SLABS)]
    parts = [part for part in parts if len(part) >= 4 * CELL_POINTS]
    if len(parts) < 2:
        return np.inf
    sizes = np.array([np.sqrt(np.square(part - part.mean(axis=0)).sum(axis=1).mean()) for part in parts])
    cells = int(np.clip(np.sqrt(len(points) / SLABS / CELL_POINTS * 16 / np.pi), 6, 40))
    grids = [
        _histogram((part - part.mean(axis=0)) / size, cells) for part, size in zip(parts, sizes, strict=True)
    ]
    shape = sum(_change(a, b) for a, b in itertools.pairwise(grids))
    size_change = np.abs(np.diff(np.log(sizes))).sum()
    pieces = float(np.mean([_pieces(grid) for grid in grids]))
    return float(shape + SIZE_WEIGHT * size_change + pieces)


def _histogram(points: Floats, cells: int) -> Floats:
    """Counts (cells, cells) over four root-mean-square radii; a filled disc reaches 1.4 of them."""
    place = np.clip((points + 2) / 4 * cells, 0, cells - 1).astype(np.intp)
    counts = np.bincount(place[:, 0] * cells + place[:, 1], minlength=cells * cells)
    return counts.reshape(cells, cells).astype(np.float64)


def _change(a: Floats, b: Floats) -> float:
    """Squared difference of two densities as a share of their squares, free of what chance adds."""
    na, nb = a.sum(), b.sum()
    difference = np.square(a / na - b / nb).sum() - 1 / na - 1 / nb
    norm = (np.square(a).sum() - na) / na**2 + (np.square(b).sum() - nb) / nb**2
    return float(difference / norm) if norm > 0 else 1.0


def _pieces(grid: Floats) -> int:
    """Number of parts and holes of a section beyond the one part that it should have."""
    from scipy import ndimage  # noqa: PLC0415  only where a direction is looked for

    filled = ndimage.binary_closing(grid > 0, iterations=1)
    return _large(ndimage.label(filled)[0], filled) - 1 + _holes(filled)


def _holes(filled: np.ndarray) -> int:
    from scipy import ndimage  # noqa: PLC0415  as above

    holes = ndimage.binary_fill_holes(filled) & ~filled
    return _large(ndimage.label(holes)[0], filled)


def _large(labels: np.ndarray, section: np.ndarray) -> int:
    return int((np.bincount(labels.ravel())[1:] > PART_SHARE * section.sum()).sum())
