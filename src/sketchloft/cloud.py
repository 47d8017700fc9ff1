"""PointCloud: the points of a drawing, and the canonical order that makes results repeatable."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sketchloft.errors import CloudError

__all__ = ["UNITS", "CleanCloud", "Floats", "Ints", "PointCloud", "Unit", "clean"]

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]
Unit = Literal["mm", "cm", "m", "in"]
UNITS: tuple[Unit, ...] = get_args(Unit)

MIN_POINTS = 60
"""Fewer points than this cannot say what a solid looks like."""
MAX_COORDINATE = 1e100
"""Beyond this, and below its inverse as a size, squares overflow or vanish."""
MAX_OFFSET = 1e6
"""Largest distance from the origin, in sizes of the cloud, that a CAD kernel's 1e-7 can follow."""


@dataclass(frozen=True)
class PointCloud:
    """Points as they were read, in the order of the file.

    Parameters
    ----------
    points : (n, 3) float array
        Coordinates in `unit`. May hold NaN, infinities and repeats; `clean` sorts them out.
    unit : {"mm", "cm", "m", "in"}
        Unit of length of the coordinates.
    stroke : (n,) int array, optional
        Index of the stroke that each point belongs to, where the format knows it.
    name : str
        What the thing is called, for the model's name.
    """

    points: Floats
    unit: Unit = "mm"
    stroke: Ints | None = None
    name: str = "cloud"

    @classmethod
    def of(cls, points: ArrayLike, unit: Unit = "mm", name: str = "cloud") -> PointCloud:
        """Make a cloud of anything that numpy can turn into an (n, 3) array."""
        try:
            array = np.asarray(points, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise CloudError(f"expected numbers, one row x, y, z per point: {error}") from None
        if array.ndim != 2 or array.shape[1] != 3:
            raise CloudError(
                f"expected an array of shape (n, 3), found {array.shape}; give one row x, y, z per point"
            )
        return cls(array, unit, None, name)

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True)
class CleanCloud:
    """Finite, distinct points about their own centre, in canonical order.

    Parameters
    ----------
    points : (m, 3) float array
        Coordinates relative to `centre`, by growing distance from it.
    centre : (3,) float array
        The centroid of the finite, distinct points.
    n_read, n_not_finite, n_repeated : int
        How many points came in, and how many were left out for either reason.
    """

    points: Floats
    centre: Floats
    n_read: int
    n_not_finite: int
    n_repeated: int

    def __len__(self) -> int:
        return len(self.points)

    @property
    def size(self) -> float:
        """Diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))


def clean(cloud: PointCloud, min_points: int = MIN_POINTS) -> CleanCloud:
    """Drop points that are not finite or repeated, and put the rest in canonical order.

    Parameters
    ----------
    cloud : PointCloud
    min_points : int
        How many distinct points there must be.

    Returns
    -------
    CleanCloud

    Raises
    ------
    CloudError
        If too few points are left, if they are all equal, lie on a line or on a plane,
        or lie so far from the origin that a solid cannot be placed there.

    Notes
    -----
    The order is the distance from the centroid: the same for a shuffled, turned, shifted or
    scaled cloud, so that whatever depends on the order of the points does not depend on those.
    """
    finite = cloud.points[np.isfinite(cloud.points).all(axis=1)]
    distinct = _distinct(finite)
    n_read, n_finite = len(cloud.points), len(finite)
    left_out = f"{n_read} read, {n_read - n_finite} not finite, {n_finite - len(distinct)} repeated"
    if len(distinct) < min_points:
        raise CloudError(
            f"input: found {len(distinct)} distinct points ({left_out}), "
            f"need at least {min_points}; draw more, or check that the file holds the whole drawing"
        )
    _check_range(distinct)
    # The box's middle first: a plain mean far from the origin loses digits.
    middle = (distinct.min(axis=0) + distinct.max(axis=0)) / 2
    local = distinct - middle
    mean = local.mean(axis=0)
    local -= mean
    _check_extent(local, middle + mean)
    order = np.argsort(np.einsum("ij,ij->i", local, local), kind="stable")
    return CleanCloud(local[order], middle + mean, n_read, n_read - n_finite, n_finite - len(distinct))


def _distinct(points: Floats) -> Floats:
    """Return the distinct rows in lexicographic order (so that the file's order is forgotten)."""
    order = np.argsort(points[:, 2])
    same = np.diff(points[order, 2]) == 0
    tied = np.append(same, False) | np.append(False, same)
    if tied.any():  # seldom more than a few rows, and sorting by one key is faster than by three
        order[tied] = order[tied][np.lexsort(points[order[tied]].T)]
    ordered = points[order] + 0.0  # + 0.0 turns -0.0 into 0.0
    if len(ordered) < 2:
        return ordered
    new = np.r_[True, (ordered[1:] != ordered[:-1]).any(axis=1)]
    return ordered[new]


def _check_range(points: Floats) -> None:
    largest = float(np.abs(points).max(initial=0.0))
    if largest > MAX_COORDINATE:
        raise CloudError(
            f"input: found a coordinate of {largest:.1e}, expected at most {MAX_COORDINATE:.0e}; "
            "check that the file was written by the program it seems to be from"
        )
    size = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    if size < 1 / MAX_COORDINATE:
        raise CloudError(
            f"input: the points are all in one place, within {size:.1e}; a solid has three extents"
        )


def _check_extent(local: Floats, centre: Floats) -> None:
    size = float(np.linalg.norm(np.ptp(local, axis=0)))
    spread = np.linalg.svd(local / size, compute_uv=False)
    thin = spread / max(float(spread[0]), np.finfo(float).tiny)
    if thin[1] < 1e-6:
        raise CloudError(
            "input: the points lie on one straight line, a solid has three extents; draw in all directions"
        )
    if thin[2] < 1e-4:
        raise CloudError(
            f"input: the points lie on a plane (thickness {thin[2]:.1e} of the width), a solid has "
            "three extents; give the drawing some depth"
        )
    offset = float(np.abs(centre).max())
    if offset > MAX_OFFSET * size:
        where = ", ".join(f"{c:.6g}" for c in centre)
        raise CloudError(
            f"input: the cloud is {size:.3g} across but lies {offset:.3g} from the origin, and a CAD "
            f"kernel cannot tell its points apart beyond {MAX_OFFSET:.0e} sizes; subtract its centre "
            f"({where}) first"
        )
