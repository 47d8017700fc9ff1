"""Evidence: the stack is changed as long as a change explains the points better than it costs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator

from sketchloft.cloud import Floats
from sketchloft.exact.changes.changes import closings, fillings, splits, swaps
from sketchloft.exact.changes.filleted_walls import filleted
from sketchloft.exact.changes.free_outlines import with_poles_that_pay
from sketchloft.exact.changes.free_profiles import splined
from sketchloft.exact.changes.free_walls import lofted, ruled
from sketchloft.exact.changes.merges import merges
from sketchloft.exact.changes.rings import rings
from sketchloft.exact.changes.trial import Change, tried
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.model.exact_model import ExactModel, Join

__all__ = ["improved", "merged"]

CHAIN = 3
"""Runs that merging may hide from a free profile in their place."""
ROUNDS = 2
"""How often all changes are looked through at most."""
RETURNS = 2
"""How often a model may be left for another before it is not gone back to."""

Form = tuple[tuple[Join, ...], tuple[tuple[tuple[str, int], ...], ...]]
Changes = Callable[[ExactModel], Iterator[Change]]


def improved(points: Floats, model: ExactModel, together: float, *, lofts: bool = True) -> ExactModel:
    """Change runs, one at a time, as long as it pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    lofts : bool
        Whether free lofts are tried.

    Notes
    -----
    A change that pays may bar the way to a better one: what is merged first is no chain that a free profile
    could stand in for. So both ways are gone where there is one, and the better end is taken.
    """
    found = _changed(points, model, together, lofts=lofts)
    if len(found.stack.runs) == 1:
        return found
    smooth = splined(points, model, together, CHAIN)
    if smooth is model:
        return found
    other = _changed(points, smooth, together, lofts=lofts)
    return max(found, other, key=lambda end: worth(points, end, together, len(points)))


def merged(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Leave runs to their neighbours, one at a time, as long as it pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    """
    return _through(points, model, together, merges, set(), again=True)


def _changed(points: Floats, model: ExactModel, together: float, *, lofts: bool) -> ExactModel:
    """Look through all kinds of changes as long as one pays."""
    failed: set[tuple[object, ...]] = set()
    settled: ExactModel | None = None
    for _ in range(ROUNDS):
        before = model
        model = _through(points, model, together, merges, failed, again=True)
        model = _through(points, model, together, fillings, failed)
        model = _through(points, model, together, rings, failed)
        model = _through(points, model, together, closings, failed)
        model = splined(points, model, together)
        model = _through(points, model, together, lambda m: splits(points, m, together), failed)
        model = _through(points, model, together, swaps, failed)
        if model is settled:
            break
        model = with_poles_that_pay(points, model, together)
        if lofts:
            model = filleted(points, model, together)
            model = lofted(points, ruled(points, model, together), together)
        if model is before:
            break
        settled = model
    return model


def _form(model: ExactModel) -> Form:
    """The joins, and kind and number of parameters of all walls, run by run."""
    walls = tuple(tuple((wall.kind, len(wall.vector)) for wall in run.walls) for run in model.stack.runs)
    return model.joins, walls


def _through(
    points: Floats,
    model: ExactModel,
    together: float,
    changes: Changes,
    failed: set[tuple[object, ...]],
    *,
    again: bool = False,
) -> ExactModel:
    """Look through a kind of changes but those that failed from the same start; keep those that fail now.

    After one that pays go on in its place, or `again` from the start. As not all changes are judged with the
    same noise, two may lead to and fro for ever, so that what was left twice is not gone back to.
    """
    place, left = 0, Counter[Form]()
    while True:
        for k, change in enumerate(changes(model)):
            if k < place or change.key in failed or left[_form(change.model)] == RETURNS:
                continue
            better = tried(points, model, change, together)
            if better is not None:
                left[_form(model)] += 1
                model, place = better, 0 if again else k
                break
            failed.add(change.key)
            place = k + 1
        else:
            return model
