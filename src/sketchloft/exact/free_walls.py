"""Free walls: one ruled or lofted wall for a chain of runs, where it explains the points better."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.loft_start import loft_start
from sketchloft.exact.misfit import misfit
from sketchloft.exact.model import ExactModel
from sketchloft.exact.ruled_start import ruled_start
from sketchloft.exact.schwarz import price
from sketchloft.exact.surgery import with_runs
from sketchloft.exact.trial import Change, tried_free
from sketchloft.stack import Run
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled

__all__ = ["lofted", "ruled"]

GAIN = 20.0
"""What a free wall must gain."""
CHEAP = 2.5
"""What each pole of a loft must gain. Where no line or circle does, poles are there to follow the points, and
one that tells of more than chance brings the wall nearer to the truth (Akaike's criterion asks for 1)."""
HOPE = 8.0
"""How much more a loft may gain than the misfit shows, which counts points where walls weigh them."""
LOFTS = (((12, 2), (12, 4), (18, 4), (24, 6)), ((16, 1), (24, 1), (24, 3)))
"""Poles around and spans along of the free lofts that are tried, each list as long as it pays."""


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


def ruled(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One ruled wall for a chain of runs, or for one run, where it pays."""
    start = 0
    while start < len(model.stack.runs):
        stop = start + 1
        while stop < len(model.stack.runs) and _smooth(model, stop):
            stop += 1
        runs = range(start, stop)
        walls = [model.stack.runs[j].walls for j in runs]
        done = any(len(row) > 1 or isinstance(row[0], (Revolved, Ruled, Lofted)) for row in walls)
        if not done and HOPE * misfit(points, model, runs, together) > GAIN:
            ends = float(model.stack.breaks[start]), float(model.stack.breaks[stop])
            wall = ruled_start(points, ends, together)
            if wall is not None:
                change = with_runs(model, start, stop - 1, Run((wall,)))
                better, _ = tried_free(points, model, Change(change, range(start, start + 1)), together)
                model, stop = (better, start + 1) if better is not None else (model, stop)
        start = stop
    return model


def _best_loft(points: Floats, model: ExactModel, runs: range, together: float) -> ExactModel | None:
    ends = float(model.stack.breaks[runs.start]), float(model.stack.breaks[runs.stop])
    best: ExactModel | None = None
    for sizes in LOFTS:
        last = -np.inf
        for around, spans in sizes:
            held = None if best is None else best.stack.runs[runs.start].walls[0]
            if isinstance(held, Lofted):
                wall: Lofted | None = held.refined(around, spans)
            else:
                wall = loft_start(points, ends, around, spans, together)
            if wall is None:
                continue
            source, last_run = (model, runs.stop - 1) if best is None else (best, runs.start)
            change = with_runs(source, runs.start, last_run, Run((wall,)))
            more = change.size - source.size
            handicap = (GAIN if best is None else 0.0) + CHEAP * more - price(more, len(points), together)
            found = Change(change, range(runs.start, runs.start + 1), handicap)
            better, gain = tried_free(points, best or model, found, together)
            if better is None and (best is not None or gain < last):
                break
            best, last = better or best, gain
        if best is not None:
            break
    return best


def _promising(points: Floats, model: ExactModel, runs: range, together: float) -> bool:
    """Whether the points leave enough unexplained for the simplest loft to pay."""
    around, spans = LOFTS[0][0]
    held = sum(len(wall.vector) for j in runs for wall in model.stack.runs[j].walls)
    more = around * (spans + Lofted.degree) - held
    return HOPE * misfit(points, model, runs, together) > CHEAP * more + GAIN


def _smooth(model: ExactModel, k: int) -> bool:
    """Whether the walls below and above a break are one each and meet there, about."""
    below, above = model.stack.runs[k - 1], model.stack.runs[k]
    if len(below.walls) != 1 or len(above.walls) != 1:
        return False
    at = np.array([model.stack.breaks[k]])
    first, second = float(below.walls[0].area(at)[0]), float(above.walls[0].area(at)[0])
    return abs(np.sqrt(first) - np.sqrt(second)) < max(10 * model.sigma, 0.04)
