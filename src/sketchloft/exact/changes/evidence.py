"""Evidence: the stack is changed as long as a change explains the points better than it costs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator

from sketchloft.cloud import Floats
from sketchloft.exact.changes.bends import bends
from sketchloft.exact.changes.change import Change, Key
from sketchloft.exact.changes.filleted_walls import filleted
from sketchloft.exact.changes.free_outlines import with_poles_that_pay
from sketchloft.exact.changes.free_profiles import splined
from sketchloft.exact.changes.free_trial import ENOUGH, SETTLED
from sketchloft.exact.changes.free_walls import lofted, ruled
from sketchloft.exact.changes.merges import merges
from sketchloft.exact.changes.rings import rings
from sketchloft.exact.changes.round_ends import round_ends
from sketchloft.exact.changes.run_changes import closings, fillings, splits, swaps
from sketchloft.exact.changes.trial import tried
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.likelihood import rising
from sketchloft.exact.model.exact_model import ExactModel, Join
from sketchloft.workers import ALONE, Workers

__all__ = ["improved", "merged"]

CHAIN = 3
"""Runs that merging may hide from a free profile in their place."""
ROUNDS = 3
"""How often all changes are looked through at most."""
RETURNS = 2
"""How often a model may be left for another before it is not gone back to."""

Form = tuple[tuple[Join, ...], tuple[tuple[tuple[str, int], ...], ...]]
Changes = Callable[[ExactModel], Iterator[Change]]


def improved(
    points: Floats, model: ExactModel, together: float, *, lofts: bool = True, workers: Workers = ALONE
) -> ExactModel:
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
    workers : Workers, optional

    Notes
    -----
    A change that pays may bar the way to a better one: what is merged first is no chain that a free profile
    could stand in for. So both ways are gone where there is one, and the better end is taken, when each is
    fitted as a whole: a change is fitted around itself only.
    """
    points = rising(points)  # once for all that look at them
    found = _changed(points, model, together, lofts=lofts, workers=workers)
    if len(found.stack.runs) == 1:
        return found
    smooth = splined(points, model, together, CHAIN, workers=workers)
    if smooth is model:
        return found
    other = _changed(points, smooth, together, lofts=lofts, workers=workers)
    ends = [climb(points, end, SETTLED, enough=ENOUGH * together)[0] for end in (found, other)]
    return max(ends, key=lambda end: worth(points, end, together, len(points)))


def merged(points: Floats, model: ExactModel, together: float, workers: Workers = ALONE) -> ExactModel:
    """Leave runs to their neighbours, one at a time, as long as it pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    workers : Workers, optional
    """
    return _through(rising(points), model, together, merges, set(), again=True, workers=workers)


def _changed(
    points: Floats, model: ExactModel, together: float, *, lofts: bool, workers: Workers
) -> ExactModel:
    """Look through all kinds of changes as long as one pays."""
    failed: set[Key] = set()
    settled: ExactModel | None = None

    def through(model: ExactModel, changes: Changes, *, again: bool = False) -> ExactModel:
        return _through(points, model, together, changes, failed, again=again, workers=workers)

    for _ in range(ROUNDS):
        before = model
        model = through(model, merges, again=True)
        for changes in (fillings, rings, closings, round_ends):
            model = through(model, changes)
        model = splined(points, model, together, failed=failed, workers=workers)
        model = through(model, lambda m: splits(points, m, together))
        model = through(model, bends)
        model = through(model, swaps)
        if model is settled:
            break
        model = with_poles_that_pay(points, model, together)
        if lofts:
            model = filleted(points, model, together)
            model = lofted(points, ruled(points, model, together, workers), together)
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
    failed: set[Key],
    *,
    again: bool = False,
    workers: Workers,
) -> ExactModel:
    """Look through a kind of changes but those that failed from the same start; keep those that fail now.

    After one that pays go on in its place, or `again` from the start. As not all changes are judged with the
    same noise, two may lead to and fro for ever, so that what was left twice is not gone back to.
    """
    place, left = 0, Counter[Form]()
    while True:
        seen: list[tuple[int, Key]] = []
        fresh = _fresh(changes(model), seen, place, failed, left)
        found = workers.first(tried, ((points, model, change, together) for change in fresh))
        failed.update(key for _, key in seen[: None if found is None else found[0]])
        if found is None:
            return model
        left[_form(model)] += 1
        model, place = found[1], 0 if again else seen[found[0]][0]


def _fresh(
    changes: Iterator[Change], seen: list[tuple[int, Key]], place: int, failed: set[Key], left: Counter[Form]
) -> Iterator[Change]:
    """Changes from a place on that have not failed; note where they are, and their keys, as they are seen."""
    known = set(failed)
    for k, change in enumerate(changes):
        if k >= place and change.key not in known and left[_form(change.model)] < RETURNS:
            known.add(change.key)
            seen.append((k, change.key))
            yield change
