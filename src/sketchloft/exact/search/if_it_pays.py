"""If it pays: a model of fewer parameters in the place of one that is fitted, where it is as good."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.fit.sharpen import judged, sharpened
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.search.as_many_as_pay import BESIDE

__all__ = ["fitted_if_it_pays"]

BLURRED, MOST_NOISE = 8.0, 0.006
"""Noise, in that of a model, that a simpler one begins to be fitted with, as it has some way to go; and where
that has less, the most of it: blurred walls leave their places."""


def fitted_if_it_pays(
    points: Floats, model: ExactModel, simpler: Iterable[ExactModel], together: float
) -> ExactModel:
    """Return the first of some models of fewer parameters that is as good, fitted; else the model.

    Parameters
    ----------
    points : (n, 3) float array
        All points.
    model : ExactModel
        Fitted to them.
    simpler : iterable of ExactModel
        The simplest first; each may cost what its fewer parameters are worth by Schwarz's criterion.
    together : float
        How many of the points go together.
    """
    candidates = list(simpler)
    if not candidates:
        return model
    seen = judged(points, points, beside_walls(points, model, BESIDE * model.sigma))
    still = np.eye(3)
    value = seen.value(model, still)
    for candidate in candidates:
        blurred = replace(candidate, sigma=min(BLURRED * model.sigma, max(model.sigma, MOST_NOISE)))
        fitted, _, _ = sharpened(points, blurred, tilt=False)
        saved = price(model.size - candidate.size, len(points), together)
        if seen.every * (value - seen.value(fitted, still)) < together * saved:
            return fitted
    return model
