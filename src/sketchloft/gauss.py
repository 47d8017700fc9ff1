"""Gauss's rule: nodes and weights to integrate with, found once for each number of points."""

from __future__ import annotations

import functools

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["gauss"]


@functools.cache
def gauss(count: int) -> tuple[Floats, Floats]:
    """Nodes (count,) from -1 to 1 and weights that add up to 2, exact to degree 2 count - 1; read only."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    nodes.flags.writeable = weights.flags.writeable = False
    return nodes, weights
