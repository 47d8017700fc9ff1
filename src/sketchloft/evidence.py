"""Evidence: the stack is changed as long as a change explains the points better than it costs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact_model import ExactModel, tied
from sketchloft.fit import climb
from sketchloft.joins import natural_joins, sole_profile
from sketchloft.likelihood import beside_walls, evaluate
from sketchloft.segment_walls import evidence_price, spline_knots
from sketchloft.simpler_walls import walls_like
from sketchloft.stack import Run
from sketchloft.surface import basis_matrix
from sketchloft.surgery import with_run, with_runs, without_run
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at

__all__ = ["coaxial", "improved"]

BESIDE = 6.0
"""Noise deviations from the walls within which points decide."""
STEPS = 5
SHORT = 8.0
"""Runs shorter than so many noise deviations are taken for noise unless they gain a lot."""
SPLINE_GAIN = 20.0
"""What one free profile must gain over a chain of lines and arcs."""
Change = tuple[ExactModel, range, float]


def improved(points: Floats, model: ExactModel, together: float, rounds: int = 3) -> ExactModel:
    """Change runs, one at a time, as long as it pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    rounds : int
        How often all changes are looked through at most.
    """
    for _ in range(rounds):
        before = model
        for changes in (_merges, _chains, _swaps):
            model = _through(points, model, together, changes)
        if model is before:
            break
    return model


def _through(points: Floats, model: ExactModel, together: float, changes) -> ExactModel:  # type: ignore[no-untyped-def]
    """Look through a kind of changes; after one that pays, start again from there."""
    place = 0
    while True:
        for place_now, change in enumerate(changes(model)):
            if place_now < place:
                continue
            better = _tried(points, model, change, together)
            place = place_now + 1
            if better is not None:
                model, place = better, 0 if changes is _merges else place_now
                break
        else:
            return model


def _tried(points: Floats, model: ExactModel, change: Change, together: float) -> ExactModel | None:
    """Fit a changed model beside its change; None if it does not pay."""
    candidate, runs, handicap = change
    breaks = candidate.stack.breaks
    low = -np.inf if runs.start <= 1 else breaks[runs.start - 1]
    high = np.inf if runs.stop >= len(breaks) - 2 else breaks[runs.stop + 1]
    near = points[(points[:, 2] > low) & (points[:, 2] < high)]
    near = near[beside_walls(near, model, BESIDE * model.sigma) | beside_walls(near, candidate, BESIDE * model.sigma)]
    if not len(near):
        return None
    old = evaluate(near, model).value / together - _price(model, len(points), together)
    wide = range(max(runs.start - 1, 0), min(runs.stop + 1, len(breaks) - 1))
    fitted, _, _ = climb(near, candidate, STEPS, runs=wide)
    fitted = natural_joins(fitted)
    new = evaluate(near, fitted).value / together - _price(fitted, len(points), together)
    return fitted if new > old + handicap else None


def _price(model: ExactModel, count: int, together: float) -> float:
    lengths = np.diff(model.stack.breaks)
    short = np.maximum(1 - lengths / (SHORT * model.sigma), 0.0)
    runs = len(lengths) * float(np.log(count / together))
    return evidence_price(model.parameters, count, together) + runs + 12.0 * float(short.sum())


def _merges(model: ExactModel) -> Iterator[Change]:
    runs = model.stack.runs
    count = len(runs)
    if count == 1:
        return
    order = np.argsort(np.diff(model.stack.breaks))
    for j in (int(k) for k in order):
        for heir in (j - 1, j + 1):
            if 0 <= heir < count:
                first = min(j, heir)
                yield without_run(model, j, heir), range(first, first + 1), 0.0
        if j in (0, count - 1):
            place = 0 if j == 0 else count - 2
            yield without_run(model, j, None), range(place, place + 1), 0.0


def _chains(model: ExactModel) -> Iterator[Change]:
    """One spline for a chain of revolved runs."""
    runs, breaks = model.stack.runs, model.stack.breaks
    start = 0
    while start < len(runs):
        stop = start
        while stop < len(runs) and sole_profile(runs[stop]) is not None:
            if stop > start and not _continuous(model, stop):
                break
            stop += 1
        if stop - start >= 2:
            for spans in (4, 7, 11):
                wall = _spline_through(model, start, stop, spans)
                yield (
                    with_runs(model, start, stop - 1, Run((wall,))),
                    range(start, start + 1),
                    SPLINE_GAIN if stop - start > 2 else SPLINE_GAIN / 2,
                )
        start = max(stop, start + 1)
    for j, run in enumerate(runs):
        sole = sole_profile(run)
        if sole is not None and isinstance(sole.profile, SplineProfile):
            spans = len(sole.profile.radii) - 3
            for other in (spans - 1, spans - 2, spans + 2):
                if other >= 1:
                    wall = _spline_through(model, j, j + 1, other)
                    yield with_run(model, j, Run((wall,))), range(j, j + 1), 0.0
    del breaks


def _continuous(model: ExactModel, k: int) -> bool:
    first, second = sole_profile(model.stack.runs[k - 1]), sole_profile(model.stack.runs[k])
    if first is None or second is None:
        return False
    at = np.array([model.stack.breaks[k]])
    gap = abs(float(radius_at(first.profile, at)[0][0] - radius_at(second.profile, at)[0][0]))
    return gap < max(10 * model.sigma, 0.03)


def _spline_through(model: ExactModel, start: int, stop: int, spans: int) -> Revolved:
    breaks = model.stack.breaks
    heights, radii, centres, weights = [], [], [], []
    for j in range(start, stop):
        wall = sole_profile(model.stack.runs[j])
        if wall is None:
            continue
        length = float(breaks[j + 1] - breaks[j])
        z = breaks[j] + length * (np.arange(12) + 0.5) / 12
        heights.append(z)
        radii.append(radius_at(wall.profile, z)[0])
        weights.append(np.full(12, length))
        centres.append(length * wall.centre)
    z, r, w = np.concatenate(heights), np.concatenate(radii), np.sqrt(np.concatenate(weights))
    low, high = float(breaks[start]), float(breaks[stop])
    knots = spline_knots(low, high, spans, 0.02 * (high - low))
    basis = basis_matrix(knots, 3, z)
    smooth = 1e-3 * np.diff(np.eye(basis.shape[1]), 2, axis=0)
    rows = np.concatenate([w[:, None] * basis, smooth * float(w.mean())])
    poles = np.linalg.lstsq(rows, np.r_[w * r, np.zeros(len(smooth))], rcond=None)[0]
    return Revolved(np.sum(centres, axis=0) / (high - low), SplineProfile(knots, poles))


def _swaps(model: ExactModel) -> Iterator[Change]:
    breaks = model.stack.breaks
    for j, run in enumerate(model.stack.runs):
        for i, wall in enumerate(run.walls):
            for other in walls_like(wall, float(breaks[j]), float(breaks[j + 1])):
                walls = (*run.walls[:i], other, *run.walls[i + 1 :])
                yield with_run(model, j, Run(walls, run.holes)), range(j, j + 1), 0.0


def coaxial(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Let all revolved walls have one axis, if it pays."""
    places = [
        (j, i)
        for j, run in enumerate(model.stack.runs)
        for i, wall in enumerate(run.walls)
        if isinstance(wall, Revolved)
    ]
    if len(places) < 2:
        return model
    pairs = [((*places[0], k), (*place, k)) for place in places[1:] for k in (0, 1)]
    change = tied(model, pairs), range(len(model.stack.runs)), 0.0
    return _tried(points, replace(model), change, together) or model
