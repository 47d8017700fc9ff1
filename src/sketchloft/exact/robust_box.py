"""Robust box: where a cloud is and how large, whatever a few strays say."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["middle_and_size"]

OUTSIDE = 0.004
"""Share of the points that lies beyond each side of the box."""


def middle_and_size(points: Floats) -> tuple[Floats, float]:
    """Middle (3,) and diagonal of the box around most of the points (n, 3)."""
    low, high = np.quantile(points, [OUTSIDE, 1 - OUTSIDE], axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low))
