"""As many as pay: constraints put on a model, all at once or one after another, where the points allow it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from sketchloft.cloud import Floats
from sketchloft.exact.fit.likelihood import beside_walls, value_of
from sketchloft.exact.model.exact_model import ExactModel

__all__ = ["BESIDE", "as_many_as_pay", "telling"]

BESIDE = 8.0
"""Noise deviations beside the walls within which points tell what a constraint costs."""

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
