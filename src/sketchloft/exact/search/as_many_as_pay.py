"""As many as pay: constraints put on a model, all at once or one after another, where the points allow it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TypeVar

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.likelihood import beside_walls, value_of
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.fit.sharpen import judged, sharpened
from sketchloft.exact.model.exact_model import ExactModel

__all__ = ["as_many_as_pay", "fitted_if_it_pays", "telling"]

BESIDE = 8.0
"""Noise deviations beside the walls within which points tell what a constraint costs."""

BLURRED, MOST_NOISE = 8.0, 0.006
"""Noise, in that of a model, that a simpler one begins to be fitted with, as it has some way to go; and where
that has less, the most of it: blurred walls leave their places."""

T = TypeVar("T")


def telling(points: Floats, model: ExactModel) -> Floats:
    """Points that tell what a constraint on the walls of a model costs."""
    return points[beside_walls(points, model, BESIDE * model.sigma)]


def as_many_as_pay(
    near: Floats,
    model: ExactModel,
    asked: list[T],
    worth: float,
    under: Callable[[list[T]], ExactModel | None],
) -> ExactModel:
    """Put constraints on a model as long as they cost less than they are worth.

    Parameters
    ----------
    near : (n, 3) float array
        Points beside the walls.
    model : ExactModel
    asked : list
        The constraints.
    worth : float
        Log likelihood of all points that each may cost.
    under : callable
        Makes the model under some constraints; None where there is none.
    """
    value = value_of(near, model)
    best, kept = model, list[T]()
    for more in [asked, *([one] for one in asked)]:
        candidate = under(kept + more)
        if candidate is not None and value - value_of(near, candidate) < worth * len(kept + more):
            best, kept = candidate, kept + more
        if len(kept) == len(asked):
            break
    return best


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
