"""Wall counts: how many points a model expects at every distance from its walls."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.report.distance_outside import distance_outside

__all__ = ["expected_counts"]

PLACES = 60_000
"""Places, evenly spread over the box around the model, that stand for the volume around the walls."""
KRONECKER = 1.2207440846057596 ** -np.arange(1.0, 4.0)
"""Steps of a sequence that fills a cube evenly: powers of the root of x**4 = x + 1."""
FINE = 400


def expected_counts(model: ExactModel, edges: Floats, share: float) -> tuple[Floats, Floats]:
    """Points expected in an interval at every distance from the walls.

    Parameters
    ----------
    model : ExactModel
    edges : (m + 1,) float array
        Of equal intervals of the distance, rising, the walls in the middle.
    share : float
        How many of the points are counted.

    Returns
    -------
    distance, expected : (k,) float arrays

    Notes
    -----
    The volume at each distance, and how densely it was drawn, come from a Kronecker sequence, smoothed by a
    parabola (Steiner's formula for how volume grows). Across the walls the density falls as the normal
    distribution of the noise does.
    """
    from scipy.special import ndtr  # noqa: PLC0415

    low, high = _box(model)
    low, high = low - edges[-1], high + edges[-1]
    places = low + (high - low) * (np.arange(PLACES)[:, None] * KRONECKER % 1.0)
    distance = distance_outside(places, model.stack)
    near = (distance >= edges[0]) & (distance < edges[-1])
    middle, cell = (edges[:-1] + edges[1:]) / 2, float(np.prod(high - low)) / PLACES
    at = np.linspace(edges[0], edges[-1], FINE)
    inner = np.clip(places[near], *_box(model))
    found = []
    for weight in (model.density.at(inner), np.full(len(inner), model.stray)):
        counted, _ = np.histogram(distance[near], edges, weights=cell * weight)
        found.append(np.maximum(np.polyval(np.polyfit(middle, counted, 2), at), 0.0))
    return at, share * (found[0] * ndtr(-at / model.sigma) + found[1])


def _box(model: ExactModel) -> tuple[Floats, Floats]:
    """Lower and upper corner of the box around the walls."""
    slabs = model.stack.slabs()
    walls = [wall.boundary(low, high, 400).points for run, low, high in slabs for wall in run.walls]
    points = np.concatenate(walls)
    low, high = points.min(axis=0), points.max(axis=0)
    low[2], high[2] = model.stack.breaks[[0, -1]]
    return low, high
