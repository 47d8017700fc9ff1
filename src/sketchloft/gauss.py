"""Gauss's rule: nodes and weights to integrate with, found once for each number of points."""

from __future__ import annotations

import functools

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["gauss", "gauss_between"]


@functools.cache
def gauss(count: int) -> tuple[Floats, Floats]:
    """Nodes (count,) from -1 to 1 and weights that add up to 2, exact to degree 2 count - 1; read only."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    nodes.flags.writeable = weights.flags.writeable = False
    return nodes, weights


def gauss_between(ends: Floats, count: int) -> tuple[Floats, Floats]:
    """Nodes and weights of that rule on every span between rising ends (k + 1,), each (k * count,)."""
    nodes, weights = gauss(count)
    half = np.diff(ends)[:, None] / 2
    return (ends[:-1, None] + half * (1 + nodes)).ravel(), (half * weights).ravel()
