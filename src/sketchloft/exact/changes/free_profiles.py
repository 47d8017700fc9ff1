"""Free profiles: one spline for a chain of revolved runs, where it explains the points better."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import FREE_GAIN, Change, Key, free_gain
from sketchloft.exact.changes.misfit import HOPE, misfit
from sketchloft.exact.changes.profile_start import profile_start, respanned
from sketchloft.exact.changes.trial import tried
from sketchloft.exact.fit.clear import clear
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import sole_profile
from sketchloft.exact.model.surgery import with_run, with_runs
from sketchloft.stack import Run
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.workers import ALONE, Workers

__all__ = ["splined"]

SPANS = {4: 0.0, 7: 1.0, 11: 2.5, 16: 2.5}
"""Knot spans that are tried, and what each must gain that is more than before.

A few poles more are no question of kind, and a curve that is too stiff is farther off than one that is a
little too free (Akaike's criterion); where there are many, strokes lead some of them astray.
"""


def splined(
    points: Floats,
    model: ExactModel,
    together: float,
    fewest: int = 1,
    *,
    failed: set[Key] | None = None,
    workers: Workers = ALONE,
) -> ExactModel:
    """One free profile for a chain of so many revolved runs or more, with as many spans as pay.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    together : float
        How many of the points go together.
    fewest : int
    failed : set of tuple, optional
        Keys of changes that need no second look; those that fail now are put in.
    workers : Workers, optional

    References
    ----------
    H. Akaike, A new look at the statistical model identification, IEEE Trans. Autom. Control 19 (1974).
    """
    start, failed = 0, set() if failed is None else failed
    while True:
        seen: list[tuple[int, int, Key]] = []
        changes = _first_changes(points, model, (start, fewest), together, (seen, failed))
        parts = ((points, model, change, together, chain) for change, chain in changes)
        found = workers.first(_tried, parts)
        failed.update(key for *_, key in seen[: None if found is None else found[0]])
        if found is None:
            return model
        j, place, _ = seen[found[0]]
        model, start = _with_more_spans(points, found[1], j, place, together), j + 1


def _tried(
    points: Floats, model: ExactModel, change: Change, together: float, chain: range
) -> ExactModel | None:
    """Try a free profile for a chain that is not right as it is."""
    return None if _right(points, model, chain, together) else tried(points, model, change, together)


def _first_changes(
    points: Floats,
    model: ExactModel,
    sought: tuple[int, int],
    together: float,
    notes: tuple[list[tuple[int, int, Key]], set[Key]],
) -> Iterator[tuple[Change, range]]:
    """A free profile for each chain from a run on, of so many runs or more, with few spans and with more.

    As they are given the run that stands for the chain, the place of the spans and the key are noted. Those
    that failed are left out.
    """
    (start, fewest), (seen, failed) = sought, notes
    for chain in _chains(model, start):
        if len(chain) < max(fewest, 1):
            continue
        entry = 0.0
        if not _has_spline(model, chain):
            tangents = model.joins[chain.start + 1 : chain.stop].count("tangent")
            entry = free_gain(len(chain), tangents, len(points), together)
        one = range(chain.start, chain.start + 1)
        changes = (
            Change(_with_spline(points, model, chain, spans), one, entry, free=True)
            for spans in (SPANS if len(chain) > 1 else [*SPANS][:1])
        )
        for place, change in enumerate(changes):
            if change.key not in failed:
                seen.append((chain.start, place, change.key))
                yield change, chain


def _chains(model: ExactModel, start: int) -> Iterator[range]:
    """Chains, from a run on, of revolved runs that go on where the last one ended."""
    while start < len(model.stack.runs):
        stop = start
        while stop < len(model.stack.runs) and sole_profile(model.stack.runs[stop]) is not None:
            if stop > start and not _continuous(model, stop):
                break
            stop += 1
        if stop > start:
            yield range(start, stop)
        start = max(stop, start + 1)


def _with_more_spans(points: Floats, model: ExactModel, j: int, place: int, together: float) -> ExactModel:
    """The model with more spans in the free profile of a run, as long as that pays.

    It starts from the profile as it is: points say little of a waist, or an end, that few strokes reach, and
    a start that is far off there takes more steps than a change is given.
    """
    for spans, each in [*SPANS.items()][place + 1 :]:
        wall = sole_profile(model.stack.runs[j])
        if wall is None:
            break
        low, high = model.stack.breaks[j : j + 2].tolist()
        finer = with_run(model, j, Run((respanned(wall, (low, high), spans),)))
        more = finer.parameters - model.parameters
        handicap = each * more - price(more, len(points), together)
        better = tried(points, model, Change(finer, range(j, j + 1), handicap, free=True), together)
        if better is None:
            break
        model = better
    return model


def _with_spline(points: Floats, model: ExactModel, chain: range, spans: int) -> ExactModel:
    wall = _spline_through(points, model, chain.start, chain.stop, spans)
    return with_runs(model, chain.start, chain.stop - 1, Run((wall,)))


def _has_spline(model: ExactModel, runs: range) -> bool:
    """Whether a chain of runs, two or more, has a free profile in it, so that one more costs no faith."""
    walls = [sole_profile(model.stack.runs[j]) for j in runs]
    return len(walls) > 1 and any(w is not None and isinstance(w.profile, SplineProfile) for w in walls)


def _right(points: Floats, model: ExactModel, runs: range, together: float) -> bool:
    """Whether a line or an arc is all that the points ask for."""
    wall = sole_profile(model.stack.runs[runs.start])
    if len(runs) > 1 or wall is None or isinstance(wall.profile, SplineProfile):
        return False
    if together > 1:
        return clear(points, model, runs)
    return HOPE * misfit(points, model, runs, together) <= FREE_GAIN


def _continuous(model: ExactModel, k: int) -> bool:
    first, second = sole_profile(model.stack.runs[k - 1]), sole_profile(model.stack.runs[k])
    if first is None or second is None:
        return False
    at = np.array([model.stack.breaks[k]])
    gap = abs(float(radius_at(first.profile, at)[0][0] - radius_at(second.profile, at)[0][0]))
    return gap < max(10 * model.sigma, 0.03)


def _spline_through(points: Floats, model: ExactModel, start: int, stop: int, spans: int) -> Revolved:
    """Free profile that the points beside those of a chain of runs have."""
    breaks = model.stack.breaks
    heights, radii, centres = [], [], []
    for j in range(start, stop):
        wall = sole_profile(model.stack.runs[j])
        if wall is None:
            continue
        length = float(breaks[j + 1] - breaks[j])
        z = breaks[j] + length * (np.arange(12) + 0.5) / 12
        heights.append(z)
        radii.append(radius_at(wall.profile, z)[0])
        centres.append(length * wall.centre)
    low, high = float(breaks[start]), float(breaks[stop])
    centre = np.sum(centres, axis=0) / (high - low)
    near = np.concatenate(heights), np.concatenate(radii)
    return profile_start(points, centre, near, (low, high), spans)
