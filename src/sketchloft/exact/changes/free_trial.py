"""Free trial: whether a change that has far to go, such as to a free wall, explains the points better."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.deciding import at_heights, beside, beside_either
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climbed, promise
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import evaluate
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined, natural_joins

__all__ = ["BEYOND", "BLURRED", "ENOUGH", "MOST_NOISE", "SETTLED", "STEPS", "tried_free"]

STEPS = (2, 4)
SETTLED = 12
"""Steps after which the noise of a model is the one that suits it."""
ENOUGH = 0.05
"""Log likelihood of independent points that a step gains for there to be another."""
BEYOND = 2.0
"""How much more than the slopes promise a change may gain: they hold for small movements."""
BLURRED = 10.0
"""What the noise that suits a free wall may gain beside."""
MUCH = 5.0
"""What a model must promise to gain by itself for that to be found out before the change is fitted."""
PATIENCE = 400.0
"""A free wall that is still so much worse is given up: it starts from contours and has far to go."""
SHARP = 0.006
"""Noise that a free wall starts with at most."""
MOST_NOISE = 0.012
"""Largest noise that is believed, as a share of the size; more is a wall in the wrong place."""


def tried_free(
    points: Floats, model: ExactModel, change: Change, together: float
) -> tuple[ExactModel | None, float]:
    """Fit a change to a free wall, as `tried`, and say by how much more than it must it gains.

    A bad model is a noisy one and a better one need not be, so that both are judged with the noise and the
    density that suit them; and a free wall has farther to go.
    """
    candidate = replace(change.model, sigma=min(change.model.sigma, SHARP))
    sigma, count, enough = model.sigma, len(points), ENOUGH * together
    here = at_heights(points, change)
    inner, rest = points[here], points[~here]
    near = beside_either(inner, model, candidate)
    if not len(near):
        return None, -np.inf

    def value(model: ExactModel) -> float:
        """Worth by all points, those at other heights as ones inside, which the density matters to."""
        others = float(np.log(model.density.at(rest)).sum()) / together
        return worth(inner, model, together, count) + others

    model = fit_density(points, model, 1)
    base = value(model)
    least = base + change.handicap
    gain = value(candidate) - least
    if gain + BEYOND * promise(evaluate(near, candidate), change.around) / together < -BLURRED:
        return None, gain

    def credit() -> float:
        """What the model would gain by the same steps, which is not to the credit of the change."""
        settled, _ = climbed(held, SETTLED, runs=before, noise=True, most=MOST_NOISE, enough=enough)
        return max(value(fit_density(points, settled.model, 1)) - base, 0.0)

    held, before = evaluate(near, joined(model)), change.before(model)
    early = promise(held, before, noise=True) / together > MUCH
    owed = credit() if early else 0.0
    best = -np.inf, candidate
    for k, steps in enumerate((STEPS[0], *STEPS, SETTLED)):
        if k:
            candidate = fit_density(points, candidate, 1)
        now = evaluate(beside(near, candidate), joined(candidate))
        now, _ = climbed(now, steps, runs=change.around, noise=k > 0, most=MOST_NOISE, enough=enough)
        candidate = now.model
        gain = value(candidate) - least - owed
        if gain > best[0]:
            best = gain, candidate
        left = BEYOND * promise(now, change.around, noise=True) / together
        if gain < -PATIENCE or gain + left < -BLURRED:
            return None, gain
    candidate = natural_joins(best[1])
    gain = value(candidate) - least - owed
    if gain > 0 and not early:
        gain -= credit()
    return replace(candidate, sigma=sigma) if gain > 0 else None, gain
