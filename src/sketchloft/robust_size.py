"""Robust size: where a cloud is and how large, however it is turned and whatever a few strays say."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["middle_and_size"]

STRAYS = 0.01
"""Share of the points, the farthest ones, that are left out."""
ROUNDS = 3


def middle_and_size(points: Floats) -> tuple[Floats, float]:
    """Middle (3,) of most of the points (n, 3), and the diagonal of the box of the same second moments.

    Notes
    -----
    A box of edges a, b, c has variances a^2/12, b^2/12 and c^2/12. Their sum, unlike the extents of a cloud,
    is the same however the cloud is turned.
    """
    kept = points
    for _ in range(ROUNDS):
        middle = kept.mean(axis=0)
        square = np.einsum("ij,ij->i", points - middle, points - middle)
        kept = points[square <= np.quantile(square, 1 - STRAYS)]
    return kept.mean(axis=0), float(np.sqrt(12 * kept.var(axis=0).sum()))
