"""Sharpness: how densely the points of a section lie at each, which is more the sharper its outline."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["place_density"]

BLUR = 0.012
"""Standard deviation that sections are blurred with, in sizes of the cloud."""
CELLS = 1.5
"""Cells per blur."""


def place_density(points: Floats) -> Floats:
    """Blurred density (n,) of points (n, 2) in the plane, without each point's own share."""
    from scipy import ndimage  # noqa: PLC0415

    cell = BLUR / CELLS
    index = np.rint((points - points.min(axis=0)) / cell).astype(int) + 5
    shape = index.max(axis=0) + 6
    if np.prod(shape) > 1_000_000:
        return np.full(len(points), 1e-3)
    flat = np.ravel_multi_index(tuple(index.T), tuple(shape))
    counts = np.bincount(flat, minlength=int(np.prod(shape))).reshape(shape).astype(np.float64)
    density = ndimage.gaussian_filter(counts, CELLS, truncate=3, mode="constant")
    own = 1 / (2 * np.pi * CELLS**2)
    seen = density.ravel()[flat] - own
    return np.maximum(seen, 0.02) / ((len(points) - 1) * cell**2)
