"""Absorbed: runs that are there for a stray stroke, left to their neighbours together with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.free_trial import SETTLED
from sketchloft.exact.changes.merges import merges
from sketchloft.exact.changes.trial import fitted
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.search.stray_strokes import Strays, stray_strokes
from sketchloft.workers import ALONE, Workers

__all__ = ["without_absorbed"]

SMALL = 0.1
"""Share of the points that a run holds less of if a stroke may be what it is there for."""
FAR = 800.0
"""A model that is so much worse than the other before its fit is given up."""
FIRST, PATIENCE = 3, 400.0
"""Steps of its fit after which one that is so much worse is given up."""
HOPELESS = 100.0
"""A model that is so much worse than the other before its strays are left out is given up."""


def without_absorbed(points: Floats, model: ExactModel, together: float, workers: Workers = ALONE) -> Strays:
    """Leave out stray strokes, and with them, as long as it pays, small runs that hold little else.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    workers : Workers, optional

    Notes
    -----
    A stroke beside a narrow part of the thing is no stray to a model that has a run of its own for it, and
    without that run it is to be explained. Only both together pay.
    """
    strays = stray_strokes(points, model, together, workers)
    while together > 1 and _holds_few(points[strays.kept], strays.model):
        better = _simpler(points, strays, together, workers)
        if better is None:
            break
        strays = better
    return strays


def _holds_few(points: Floats, model: ExactModel) -> bool:
    counts, _ = np.histogram(points[:, 2], model.stack.breaks)
    return len(counts) > 1 and bool((counts < SMALL * len(points)).any())


def _simpler(points: Floats, strays: Strays, together: float, workers: Workers) -> Strays | None:
    """A run less, with a stroke less, the best of all that pay."""
    inner = points[strays.kept]
    changes = {change.key: change for change in merges(strays.model)}
    most = worth(inner, strays.model, together, len(points))
    parts = [(inner, strays.model, change, together, most) for change in changes.values()]
    found = [(value, less) for value, less in workers.each(_less, parts) if less is not None]
    value, best = max(found, key=lambda one: one[0], default=(most, None))
    if best is None or value <= most:
        return None
    kept = strays.kept.copy()
    kept[kept] = best.kept
    return replace(best, kept=kept, worth=strays.worth + best.worth)


def _less(
    points: Floats, model: ExactModel, change: Change, together: float, most: float
) -> tuple[float, Strays | None]:
    """What a model with a run and a stroke less is worth; none where there is no hope or no such stroke."""
    candidate = change.model
    for steps, worse in ((0, FAR), (FIRST, PATIENCE), (SETTLED, HOPELESS)):
        if steps:
            candidate = fitted(points, model, replace(change, model=candidate), together, steps)
        if worth(points, candidate, together, len(points)) < most - worse:
            return -np.inf, None
    found = stray_strokes(points, candidate, together)
    if found.kept.all():
        return -np.inf, None
    return worth(points[found.kept], found.model, together, len(points)) + found.worth, found
