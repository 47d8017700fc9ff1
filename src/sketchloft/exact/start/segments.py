"""Segments: where along the axis the sections change their rule, from moments of the raw points.

For a cylinder, a cone, a sphere, an ellipsoid, and any outline that drifts and tapers, the number of points
per height, their mean and their second moments are polynomials of degree two in the height. So the
heights are cut, by dynamic programming, into the segments on which such polynomials explain them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.intervals import cheapest_chain

__all__ = ["SegmentsParams", "cut", "segments"]


@dataclass(frozen=True)
class SegmentsParams:
    """How finely and how willingly heights are cut.

    Parameters
    ----------
    price : float
        Log likelihood that a further segment must gain.
    most_bins : int
        Heights that a cut may have.
    shortest : int
        Bins of a segment at least.
    """

    price: float = 24.0
    most_bins: int = 144
    shortest: int = 2


WINDOWS = 8
"""Most stretches of one in so many of the heights hold no cut: what is left there is noise. Points of one
stroke go together, so that it is more than independent points would leave."""


def segments(points: Floats, params: SegmentsParams, dispersion: float = 1.0) -> Floats:
    """Cut the heights of points (n, 3), of which so many go together.

    Returns
    -------
    (k + 1,) float array
        The ends, and the cuts between segments.
    """
    return cut(points, params, dispersion)[0]


def cut(points: Floats, params: SegmentsParams, dispersion: float) -> tuple[Floats, float]:
    """Cut the heights, and tell the cost: negative log likelihood and price."""
    z = points[:, 2]
    low, high = float(z.min()), float(z.max())
    bins = int(np.clip(len(points) / 50, 24, params.most_bins))
    edges = np.linspace(low, high, bins + 1)
    place = np.minimum(((z - low) / (high - low) * bins).astype(np.intp), bins - 1)
    count = np.bincount(place, minlength=bins).astype(float)
    t = (edges[:-1] + edges[1:]) / 2 / (high - low)
    values, weights = [count], [1 / np.maximum(_smooth(count, np.ones(bins)), 1.0)]
    x, y = points[:, 0], points[:, 1]
    for feature in (x, y, x * x, y * y, x * y):
        mean = np.bincount(place, feature, bins) / np.maximum(count, 1)
        square = np.bincount(place, feature**2, bins) / np.maximum(count, 1)
        spread = _smooth(np.maximum(square - mean**2, 0), count)
        values.append(mean)
        weights.append(count / np.maximum(spread, 1e-4 * float(spread.max()) + 1e-30))
    cost = _costs(t, np.array(values), np.array(weights), shortest=params.shortest)
    chain, best = cheapest_chain(cost / dispersion + params.price)
    return edges[chain], best


def _smooth(values: Floats, weights: Floats) -> Floats:
    """Weighted mean with the two neighbours."""
    kernel = np.array([1.0, 2.0, 1.0])
    return np.convolve(values * weights, kernel, "same") / np.maximum(
        np.convolve(weights, kernel, "same"), 1e-12
    )


def _costs(t: Floats, values: Floats, weights: Floats, shortest: int) -> Floats:
    """(b + 1, b + 1) half the weighted squares of features (f, b) left by parabolas over bins i to j - 1.

    Each feature's are measured in what it leaves over short stretches; inf where there are too few bins.
    """
    b = len(t)
    powers = np.stack([t**k for k in range(5)])
    sums = _summed(weights[:, None] * powers)
    right = _summed((weights * values)[:, None] * powers[:3])
    total = _summed((weights * values**2)[:, None])[:, 0]
    i, j = np.triu_indices(b + 1, shortest)
    s, r = sums[..., j] - sums[..., i], right[..., j] - right[..., i]
    matrix = np.moveaxis(s[:, np.add.outer(np.arange(3), np.arange(3))], 3, 1)
    scale = 1e-9 * matrix[..., 0, 0][..., None, None] + 1e-12
    best = np.linalg.solve(matrix + scale * np.eye(3), np.moveaxis(r, 1, 2)[..., None])[..., 0]
    left = (total[:, j] - total[:, i]) - np.einsum("fik,fki->fi", best, r)
    cost = np.full((len(values), b + 1, b + 1), np.inf)
    cost[:, i, j] = 0.5 * np.maximum(left, 0)
    window = max(b // WINDOWS, 8)
    typical = np.median(2 * np.diagonal(cost, window, 1, 2), axis=1) / (window - 3)
    found: Floats = (cost / np.maximum(1.0, typical)[:, None, None]).sum(axis=0)
    return found


def _summed(values: Floats) -> Floats:
    """Sums of values (f, k, b) before each bin, (f, k, b + 1)."""
    return np.concatenate([np.zeros((*values.shape[:2], 1)), np.cumsum(values, axis=2)], axis=2)
