"""Free walls: one spline for a chain of runs, where it explains the points better than lines and arcs."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.joins import sole_profile
from sketchloft.exact.loft_start import loft_start
from sketchloft.exact.misfit import misfit
from sketchloft.exact.model import ExactModel
from sketchloft.exact.schwarz import price
from sketchloft.exact.surgery import with_runs
from sketchloft.exact.trial import Change, tried
from sketchloft.stack import Run
from sketchloft.surface import basis_matrix, even_knots
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at

__all__ = ["lofted", "splined"]

GAIN = 20.0
"""What a free wall must gain over a chain of lines and arcs."""
HOPE = 5.0
"""How much more a loft may gain than the misfit shows, which counts points where walls weigh them."""
SPANS = (4, 7, 11)
"""Knot spans of the free profiles that are tried."""
LOFTS = (((12, 2), (16, 4), (24, 4)), ((16, 1), (24, 1)))
"""Poles around and spans along of the free lofts that are tried, each list as long as it pays."""


def splined(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One free profile for a chain of revolved runs, with as many spans as pay."""
    start = 0
    while start < len(model.stack.runs):
        stop = start
        while stop < len(model.stack.runs) and sole_profile(model.stack.runs[stop]) is not None:
            if stop > start and not _continuous(model, stop):
                break
            stop += 1
        best: ExactModel | None = None
        for spans in SPANS if stop > start else ():
            source, last = (model, stop) if best is None else (best, start + 1)
            wall = _spline_through(source, start, last, spans)
            change = with_runs(source, start, last - 1, Run((wall,)))
            handicap = GAIN if best is None else 0.0
            better = tried(points, source, Change(change, range(start, start + 1), handicap), together)
            if better is None and (best is not None or stop - start == 1):
                break
            best = better or best
        model = best or model
        start = start + 1 if best is not None else max(stop, start + 1)
    return model


def lofted(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One free wall for a chain of runs, or for a run that is not revolved, where it pays."""
    start = 0
    while start < len(model.stack.runs):
        stop = start + 1
        while stop < len(model.stack.runs) and _smooth(model, stop):
            stop += 1
        runs = model.stack.runs[start:stop]
        single = all(len(run.walls) == 1 for run in runs)
        revolved = all(isinstance(run.walls[0], Revolved) for run in runs)
        free = len(runs) == 1 and isinstance(runs[0].walls[0], Lofted)
        if single and not revolved and not free and _promising(points, model, range(start, stop), together):
            best = _best_loft(points, model, range(start, stop), together)
            model = best or model
            stop = start + 1 if best is not None else stop
        start = stop
    return model


def _best_loft(points: Floats, model: ExactModel, runs: range, together: float) -> ExactModel | None:
    ends = float(model.stack.breaks[runs.start]), float(model.stack.breaks[runs.stop])
    best: ExactModel | None = None
    for sizes in LOFTS:
        for around, spans in sizes:
            wall = loft_start(points, ends, around, spans, together)
            if wall is None:
                continue
            change = with_runs(model, runs.start, runs.stop - 1, Run((wall,)))
            found = Change(change, range(runs.start, runs.start + 1), GAIN)
            better = tried(points, best or model, found, together, free=True)
            if better is None and best is not None:
                break
            best = better or best
    return best


def _promising(points: Floats, model: ExactModel, runs: range, together: float) -> bool:
    """Whether the points leave enough unexplained for the simplest loft to pay."""
    around, spans = LOFTS[0][0]
    held = sum(len(wall.vector) for j in runs for wall in model.stack.runs[j].walls)
    more = 2 * around * (spans + Lofted.degree) - held
    return HOPE * misfit(points, model, runs, together) > price(more, len(points), together) + GAIN


def _smooth(model: ExactModel, k: int) -> bool:
    """Whether the walls below and above a break are one each and meet there, about."""
    below, above = model.stack.runs[k - 1], model.stack.runs[k]
    if len(below.walls) != 1 or len(above.walls) != 1:
        return False
    at = np.array([model.stack.breaks[k]])
    first, second = float(below.walls[0].area(at)[0]), float(above.walls[0].area(at)[0])
    return abs(np.sqrt(first) - np.sqrt(second)) < max(10 * model.sigma, 0.04)


def _continuous(model: ExactModel, k: int) -> bool:
    first, second = sole_profile(model.stack.runs[k - 1]), sole_profile(model.stack.runs[k])
    if first is None or second is None:
        return False
    at = np.array([model.stack.breaks[k]])
    gap = abs(float(radius_at(first.profile, at)[0][0] - radius_at(second.profile, at)[0][0]))
    return gap < max(10 * model.sigma, 0.03)


def _spline_through(model: ExactModel, start: int, stop: int, spans: int) -> Revolved:
    """Free profile nearest to those of a chain of runs."""
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
    margin = 0.05 * (high - low) + 0.01
    knots = even_knots(low - margin, high + margin, spans)
    basis = basis_matrix(knots, SplineProfile.degree, z)
    smooth = 1e-3 * np.diff(np.eye(basis.shape[1]), 2, axis=0)
    rows = np.concatenate([w[:, None] * basis, smooth * float(w.mean())])
    poles = np.linalg.lstsq(rows, np.r_[w * r, np.zeros(len(smooth))], rcond=None)[0]
    return Revolved(np.sum(centres, axis=0) / (high - low), SplineProfile(knots, poles))
