"""Trial: whether a change of the stack explains the points better than it costs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.exact.changes.worth import worth, worth_of
from sketchloft.exact.fit.climb import climb, climbed, fit_density, promise
from sketchloft.exact.fit.likelihood import beside_walls, evaluate, rising
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined, natural_joins

__all__ = [
    "BESIDE",
    "BEYOND",
    "BLURRED",
    "CHAIN_GAIN",
    "ENOUGH",
    "FREE_GAIN",
    "MOST_NOISE",
    "SETTLED",
    "Change",
    "Key",
    "fitted",
    "free_gain",
    "tried",
    "tried_free",
]

BESIDE = 6.0
"""Noise deviations from the walls within which points decide."""
STEPS = (2, 4)
SETTLED = 12
"""Steps after which the noise of a model is the one that suits it."""
ENOUGH = 0.05
"""Log likelihood of independent points that a step gains for there to be another."""
FAR = 300.0
"""A change that is so much worse before the first step is given up."""
HOPELESS = 40.0
"""A change that is still so much worse after the first few steps is given up."""
BEYOND = 2.0
"""How much more than the slopes promise a change may gain: they hold for small movements."""
BLURRED = 10.0
"""What the noise that suits a free wall may gain beside."""
JOINS = 10.0
"""What a change may gain beside by joins that it makes natural."""
PATIENCE = 400.0
"""`HOPELESS` for a free wall, which starts from contours and has far to go."""
SHARP = 0.006
"""Noise that a free wall starts with at most."""
MOST_NOISE = 0.012
"""Largest noise that is believed, as a share of the size; more is a wall in the wrong place."""
FREE_GAIN = 20.0
"""What a free profile must gain over lines and arcs."""
CHAIN_GAIN = 6.0
"""The same over three of them or more: a designer draws so many rarely where one curve would do."""


Key = tuple[object, ...]


@dataclass(frozen=True)
class Change:
    """A changed model, not fitted yet.

    Parameters
    ----------
    model : ExactModel
    runs : range
        The runs of it that are new.
    handicap : float
        What it must gain beside its price.
    free : bool
        Whether it puts a free wall in, takes one out, lets go of right corners or starts from a section found
        anew, so that its walls have far to go, or its noise must tell, and `tried_free` judges it.
    """

    model: ExactModel
    runs: range
    handicap: float = 0.0
    free: bool = False

    @property
    def key(self) -> Key:
        """The same for changes that start from the same numbers."""
        kinds = tuple(wall.kind for wall in self.model.stack.walls)
        return kinds, self.runs, self.model.vector.tobytes(), self.model.stack.breaks.tobytes()


def free_gain(walls: int, tangents: int, count: int, together: float) -> float:
    """What a free profile must gain over lines and arcs.

    Parameters
    ----------
    walls : int
        How many lines and arcs.
    tangents : int
        How many of them run into the next.
    count : int
        Number of points.
    together : float
        How many of them go together.

    Notes
    -----
    In the end the lines and arcs have one axis, and those that run into each other one radius (`coaxial`),
    but as yet each is priced with its own. Among strokes, which drift, the curve that follows them is the
    nearer one more often than not, so that there this does not count.
    """
    shared = 2 * (walls - 1) + tangents if together == 1 else 0
    return (FREE_GAIN if walls < 3 else CHAIN_GAIN) + price(shared, count, together)


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
    candidate, runs = change.model, change.runs
    near = _deciding(points, model, change)
    if not len(near):
        return None
    count, enough = len(points), ENOUGH * together
    wide = _with_neighbours(candidate, runs)
    before, now = evaluate(near, joined(model)), evaluate(near, joined(candidate))
    least = worth_of(before, together, count) + change.handicap
    if least - worth_of(now, together, count) > min(BEYOND * promise(now, wide) / together, FAR):
        return None
    for steps in STEPS:
        now, _ = climbed(now, steps, runs=wide, enough=enough)
        gain = worth_of(now, together, count) - least
        if not gain > -HOPELESS or gain + BEYOND * promise(now, wide) / together < -JOINS:
            return None
    candidate = natural_joins(now.model)
    if candidate.joins != now.model.joins:
        now = evaluate(near, candidate)
    value = worth_of(now, together, count)
    if not value > least:
        return None
    # What the model would gain by the same steps is not to the credit of the change.
    before, _ = climbed(before, sum(STEPS), runs=_before(model, candidate, runs), enough=enough)
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
    near = _deciding(points, model, change)
    wide = _with_neighbours(change.model, change.runs)
    candidate, _, _ = climb(near, change.model, steps, runs=wide, enough=ENOUGH * together)
    return fit_density(points, natural_joins(candidate), 1)


def tried_free(
    points: Floats, model: ExactModel, change: Change, together: float
) -> tuple[ExactModel | None, float]:
    """Fit a change to a free wall, as `tried`, and say by how much more than it must it gains.

    A bad model is a noisy one and a better one need not be, so that both are judged with the noise and the
    density that suit them; and a free wall has farther to go.
    """
    candidate, runs = replace(change.model, sigma=min(change.model.sigma, SHARP)), change.runs
    sigma, count, enough = model.sigma, len(points), ENOUGH * together
    here = _at_heights(points, candidate, runs)
    inner, rest = points[here], points[~here]
    near = _beside_either(inner, model, candidate)
    if not len(near):
        return None, -np.inf

    def value(model: ExactModel) -> float:
        """Worth by all points, those at other heights as ones inside, which the density matters to."""
        others = float(np.log(model.density.at(rest)).sum()) / together
        return worth(inner, model, together, count) + others

    wide = _with_neighbours(candidate, runs)
    model = fit_density(points, model, 1)
    least = value(model) + change.handicap
    gain = value(candidate) - least
    if gain + BEYOND * promise(evaluate(near, candidate), wide) / together < -BLURRED:
        return None, gain
    # What the model would gain by the same steps is not to the credit of the change.
    before = _before(model, candidate, runs)
    settled, _, _ = climb(near, model, SETTLED, runs=before, noise=True, most=MOST_NOISE, enough=enough)
    least = max(least, value(fit_density(points, settled, 1)) + change.handicap)
    for k, steps in enumerate((STEPS[0], *STEPS, SETTLED)):
        if k:
            candidate = fit_density(points, candidate, 1)
        now = evaluate(_beside(near, candidate), joined(candidate))
        now, _ = climbed(now, steps, runs=wide, noise=k > 0, most=MOST_NOISE, enough=enough)
        candidate = now.model
        gain = value(candidate) - least
        if gain < -PATIENCE or (k and gain + BEYOND * promise(now, wide) / together < -BLURRED):
            return None, gain
    candidate = natural_joins(candidate)
    gain = value(candidate) - least
    return replace(candidate, sigma=sigma) if gain > 0 else None, gain


def _with_neighbours(model: ExactModel, runs: range) -> range:
    return range(max(runs.start - 1, 0), min(runs.stop + 1, len(model.stack.runs)))


def _before(model: ExactModel, candidate: ExactModel, runs: range) -> range:
    """What the changed runs and their neighbours were before."""
    wide = _with_neighbours(candidate, runs)
    return range(wide.start, wide.stop + len(model.stack.runs) - len(candidate.stack.runs))


def _beside(points: Floats, model: ExactModel) -> Floats:
    return points[beside_walls(points, model, BESIDE * model.sigma)]


def _deciding(points: Floats, model: ExactModel, change: Change) -> Floats:
    """Points at the heights of a change beside the walls before it or after it, rising."""
    here = rising(points[_at_heights(points, change.model, change.runs)])
    return _beside_either(here, model, change.model)


def _beside_either(points: Floats, model: ExactModel, candidate: ExactModel) -> Floats:
    """Points beside the walls of either model, as far as the noise of the first reaches."""
    width = BESIDE * model.sigma
    return points[beside_walls(points, model, width) | beside_walls(points, candidate, width)]


def _at_heights(points: Floats, model: ExactModel, runs: range) -> NDArray[np.bool_]:
    """(n,) whether points (n, 3) lie at the heights of runs and their neighbours."""
    breaks = model.stack.breaks
    low = -np.inf if runs.start <= 1 else breaks[runs.start - 1]
    high = np.inf if runs.stop >= len(breaks) - 2 else breaks[runs.stop + 1]
    return np.asarray((points[:, 2] > low) & (points[:, 2] < high))
