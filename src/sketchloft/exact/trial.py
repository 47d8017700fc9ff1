"""Trial: whether a change of the stack explains the points better than it costs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit import climb, fit_density, promise
from sketchloft.exact.joins import natural_joins
from sketchloft.exact.likelihood import beside_walls, value_of
from sketchloft.exact.model import ExactModel
from sketchloft.exact.schwarz import price
from sketchloft.exact.soundness import detached

__all__ = ["MOST_NOISE", "Change", "tried", "worth"]

BESIDE = 6.0
"""Noise deviations from the walls within which points decide."""
STEPS = (2, 4)
SETTLED = 12
"""Steps after which the noise of a model is the one that suits it."""
HOPELESS = 40.0
"""A change that is still so much worse after the first few steps is given up."""
HOPE = 2.0
"""How much more than the slopes promise a change may gain: they hold for small movements."""
PATIENCE = 400.0
"""`HOPELESS` for a free wall, which starts from contours and has far to go."""
SHARP = 0.006
"""Noise that a free wall starts with at most."""
MOST_NOISE = 0.012
"""Largest noise that is believed, as a share of the size; more is a wall in the wrong place."""
SHORT = 8.0
"""Runs shorter than so many noise deviations are taken for noise unless they gain a lot."""
DETACHED = 300.0
"""What a wall must gain that does not reach the run beside it."""
SHORTNESS = 12.0
"""What a run of no length at all must gain."""


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
    nested : bool
        Whether the model before it is a special case of it, which it starts from.
    """

    model: ExactModel
    runs: range
    handicap: float = 0.0
    nested: bool = False

    @property
    def key(self) -> tuple[object, ...]:
        """The same for changes that start from the same numbers."""
        kinds = tuple(wall.kind for run in self.model.stack.runs for wall in run.walls)
        return kinds, self.runs, self.model.vector.tobytes(), self.model.stack.breaks.tobytes()


def tried(
    points: Floats, model: ExactModel, change: Change, together: float, *, free: bool = False
) -> ExactModel | None:
    """Fit a changed model around its change; None if it does not pay.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        What is changed.
    change : Change
    together : float
        How many of the points go together.
    free : bool
        Whether the change is a free wall. A bad model is a noisy one and a better one need not be, so that
        then both are judged with the noise that suits them; and a free wall has farther to go.
    """
    candidate, runs = change.model, change.runs
    if free:
        candidate = replace(candidate, sigma=min(candidate.sigma, SHARP))
    near = _around(points, model, candidate, runs)
    if not len(near):
        return None
    # Where the density is fitted anew, the points inside say how well it fits.
    judges = points if free else near
    if free:
        model, _, _ = climb(near, fit_density(points, model, 1), SETTLED, noise=True, most=MOST_NOISE)
        model = fit_density(points, model, 1)
    count = len(points)
    least = worth(judges, model, together, count) + change.handicap
    if change.nested and HOPE * promise(near, candidate) / together < least - worth(
        near, candidate, together, count
    ):
        return None
    wide = range(max(runs.start - 1, 0), min(runs.stop + 1, len(candidate.stack.runs)))
    for steps in (*STEPS, SETTLED) if free else STEPS:
        candidate, _, _ = climb(near, candidate, steps, runs=wide)
        if worth(judges, candidate, together, count) < least - (PATIENCE if free else HOPELESS):
            return None
        if free:
            candidate = fit_density(points, candidate, 1)
            candidate, _, _ = climb(near, candidate, steps, runs=wide, noise=True, most=MOST_NOISE)
    candidate = natural_joins(candidate)
    return candidate if worth(judges, candidate, together, count) > least else None


def worth(points: Floats, model: ExactModel, together: float, count: int) -> float:
    """Log likelihood of some of a cloud's points (n, 3), less the price of the model for all of them."""
    lengths = np.diff(model.stack.breaks)
    short = np.maximum(1 - lengths / (SHORT * model.sigma), 0.0)
    runs = len(lengths) * float(np.log(count / together)) + SHORTNESS * float(short.sum())
    runs += DETACHED * detached(model)
    return value_of(points, model) / together - (price(model.parameters, count, together) + runs)


def _around(points: Floats, model: ExactModel, candidate: ExactModel, runs: range) -> Floats:
    """Points beside the walls of either model, at the heights of the new runs and their neighbours."""
    breaks = candidate.stack.breaks
    low = -np.inf if runs.start <= 1 else breaks[runs.start - 1]
    high = np.inf if runs.stop >= len(breaks) - 2 else breaks[runs.stop + 1]
    near = points[(points[:, 2] > low) & (points[:, 2] < high)]
    width = BESIDE * model.sigma
    return near[beside_walls(near, model, width) | beside_walls(near, candidate, width)]
