"""Thinning: an even sample of points where more would only hide each other."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["thinned"]


def thinned(points: Floats, most: int) -> Floats:
    """Every k-th of points (n, ...), so that at most so many are left; even for points in canonical order."""
    return np.asarray(points[:: max(1, -(-len(points) // most))])
