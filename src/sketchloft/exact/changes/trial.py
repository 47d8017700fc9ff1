"""Trial: whether a change of the stack explains the points better than it costs."""

from __future__ import annotations

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.deciding import deciding
from sketchloft.exact.changes.free_trial import BEYOND, ENOUGH, SETTLED, STEPS, tried_free
from sketchloft.exact.changes.worth import worth_of
from sketchloft.exact.fit.climb import climb, climbed, promise
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import evaluate
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined, natural_joins

__all__ = ["fitted", "tried"]

FAR = 300.0
"""A change that is so much worse before the first step is given up."""
HOPELESS = 40.0
"""A change that is still so much worse after the first few steps is given up."""
JOINS = 10.0
"""What a change may gain beside by joins that it makes natural."""


def tried(points: Floats, model: ExactModel, change: Change, together: float) -> ExactModel | None:
    """Fit a changed model around its change; None if it does not pay.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        What is changed.
    change : Change
    together : float
        How many of the points go together.
    """
    if change.free:
        return tried_free(points, model, change, together)[0]
    near = deciding(points, model, change)
    if not len(near):
        return None
    count, enough = len(points), ENOUGH * together
    before, now = evaluate(near, joined(model)), evaluate(near, joined(change.model))
    least = worth_of(before, together, count) + change.handicap
    lacking = least - worth_of(now, together, count)
    if lacking > FAR or lacking > BEYOND * promise(now, change.around) / together:
        return None
    for steps in STEPS:
        now, _ = climbed(now, steps, runs=change.around, enough=enough)
        gain = worth_of(now, together, count) - least
        if not gain > -HOPELESS or gain + BEYOND * promise(now, change.around) / together < -JOINS:
            return None
    candidate = natural_joins(now.model)
    if candidate.joins != now.model.joins:
        now = evaluate(near, candidate)
    value = worth_of(now, together, count)
    if not value > least:
        return None
    # What the model would gain by the same steps is not to the credit of the change.
    before, _ = climbed(before, sum(STEPS), runs=change.before(model), enough=enough)
    return now.model if value > worth_of(before, together, count) + change.handicap else None


def fitted(
    points: Floats, model: ExactModel, change: Change, together: float, steps: int = SETTLED
) -> ExactModel:
    """Fit a changed model around its change, whether it pays or not.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        What is changed.
    change : Change
    together : float
        How many of the points go together.
    steps : int
        At most this many.
    """
    near = deciding(points, model, change)
    candidate, _, _ = climb(near, change.model, steps, runs=change.around, enough=ENOUGH * together)
    return fit_density(points, natural_joins(candidate), 1)
