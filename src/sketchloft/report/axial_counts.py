"""Axial counts: the area of the section at every height, as the number of points there tells it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.body import ExactBody

__all__ = ["AxialCounts", "axial_counts"]

BINS = 72
"""About how many intervals of height there are along a body."""
BEYOND = 2
"""Intervals beyond each end."""


@dataclass(frozen=True)
class AxialCounts:
    """Areas in intervals of height, in the body's unit.

    Parameters
    ----------
    heights : (m,) float array
        Middles of the intervals.
    areas, errors : (m,) float array
        Area of the section, and the standard error that counting independent points leaves.
    """

    heights: Floats
    areas: Floats
    errors: Floats


def axial_counts(body: ExactBody) -> AxialCounts:
    """Area of the section in intervals that no break divides.

    Notes
    -----
    The sum over the points of one over the density there, per height: how densely things were drawn comes
    from the model, where they are from the points alone. What strays add outside is taken off.
    """
    model, points = body.model, body.points
    edges = _edges(model.stack.breaks)
    low, high = (np.quantile(points, q, axis=0) for q in (0.01, 0.99))
    weight = 1 / (model.density.at(np.clip(points, low, high)) + model.stray)
    first, *_ = np.histogram(points[:, 2], edges, weights=weight)
    second, *_ = np.histogram(points[:, 2], edges, weights=weight**2)
    width = np.diff(edges)
    across = float(np.prod(np.ptp(points[:, :2], axis=0)))
    strays = model.stray * model.space / float(np.ptp(points[:, 2])) * float(np.median(weight))
    areas = (first / width - strays) / (1 - min(strays / across, 0.5))
    return AxialCounts((edges[:-1] + edges[1:]) / 2, np.maximum(areas, 0.0), np.sqrt(second) / width)


def _edges(breaks: Floats) -> Floats:
    """Ends of the intervals; those between two breaks are equally long."""
    width = float(np.ptp(breaks)) / BINS
    inner = [
        np.linspace(low, high, max(1, round((high - low) / width)) + 1)[:-1]
        for low, high in pairwise(breaks.tolist())
        if high > low
    ]
    beyond = width * np.arange(1, BEYOND + 1)
    return np.concatenate([breaks[0] - beyond[::-1], *inner, breaks[-1:], breaks[-1] + beyond])
