"""Half-density level set of a blurred histogram, by marching cubes of scikit-image (BSD)."""

from __future__ import annotations

import numpy as np

from meshers.mesher import Mesher, Points, Triangles

__all__ = ["HALF_DENSITY"]

CELLS_PER_BLUR = 2.0
MARGIN = 4.0
"""Blurs between the outermost points and the end of the grid, where the density has fallen to nothing."""


def _build(points: Points, spacing: float, *, blur: float) -> Triangles:
    from scipy import ndimage  # noqa: PLC0415  part of the time
    from skimage.measure import marching_cubes  # noqa: PLC0415  an extra, and part of the time

    cell = blur * spacing / CELLS_PER_BLUR
    margin = MARGIN * blur * spacing
    low = points.min(axis=0) - margin
    shape = tuple(np.ceil((np.ptp(points, axis=0) + 2 * margin) / cell).astype(int) + 1)
    at = tuple(np.rint((points - low) / cell).astype(int).T)
    counts = np.bincount(np.ravel_multi_index(at, shape), minlength=int(np.prod(shape)))
    density = ndimage.gaussian_filter(
        counts.reshape(shape).astype(np.float32), CELLS_PER_BLUR, mode="constant"
    )
    inside = float(np.median(density[at]))
    vertices, triangles, _, _ = marching_cubes(density, inside / 2)
    return low + cell * vertices, triangles.astype(np.int64)


HALF_DENSITY = Mesher(
    "half density (scikit-image)",
    "skimage",
    "scikit-image",
    tuple({"blur": blur} for blur in (1.0, 1.3, 2.4)),
    _build,
)
