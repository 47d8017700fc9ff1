"""Free walls: one ruled or lofted wall for a chain of runs, where it explains the points better."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.deciding import BESIDE
from sketchloft.exact.changes.free_trial import BEYOND, BLURRED, tried_free
from sketchloft.exact.changes.loft_start import loft_start
from sketchloft.exact.changes.misfit import HOPE, misfit
from sketchloft.exact.changes.ruled_start import ruled_start
from sketchloft.exact.changes.square_to_round import square_to_round
from sketchloft.exact.changes.worth import PER_RUN
from sketchloft.exact.fit.clear import clear
from sketchloft.exact.fit.climb import promise
from sketchloft.exact.fit.likelihood import beside_walls, evaluate
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_runs, with_split
from sketchloft.stack import Run
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.workers import ALONE, Workers

__all__ = ["lofted", "ruled", "smooth_chains"]

GAIN = 20.0
"""What a free wall must gain."""
CHEAP = 2.5
"""What each pole of a loft must gain. Where no line or circle does, poles are there to follow the points, and
one that tells of more than chance brings the wall nearer to the truth (Akaike's criterion asks for 1)."""
SIMPLEST = 10
"""Parameters of a ruled wall at least: those of a rectangle and a circle."""
MUCH = 10.0
"""`HOPE` for a loft."""
FAR = 0.005
"""Noise of strokes above which walls are so far off that slopes do not tell what their halves would gain."""
LOFTS = (((12, 2), (12, 4), (18, 4), (24, 6)), ((16, 1), (24, 1), (24, 3)))
"""Poles around and spans along of the free lofts that are tried, each list as long as it pays."""


def smooth_chains(model: ExactModel) -> list[range]:
    """Runs of one wall each that meet where they touch, in chains as long as they can be."""
    chains: list[range] = []
    for j, run in enumerate(model.stack.runs):
        if chains and chains[-1].stop == j and _smooth(model, j):
            chains[-1] = range(chains[-1].start, j + 1)
        elif len(run.walls) == 1:
            chains.append(range(j, j + 1))
    return chains


def lofted(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One free wall for a chain of runs, or for a run that is not revolved, where it pays."""
    for chain in reversed(smooth_chains(model)):
        walls = [model.stack.runs[j].walls[0] for j in chain]
        revolved = all(isinstance(wall, Revolved) for wall in walls)
        free = len(walls) == 1 and isinstance(walls[0], (Filleted, Lofted))
        if not revolved and not free and _promising(points, model, chain, together):
            model = _best_loft(points, model, chain, together) or model
    return model


def ruled(points: Floats, model: ExactModel, together: float, workers: Workers = ALONE) -> ExactModel:
    """One ruled wall for a chain of runs, or for one run, where it pays."""
    for chain in reversed(smooth_chains(model)):
        better = _best_ruled(points, model, chain, together, workers)
        if better is None and len(chain) > 1:
            for j in reversed(chain):
                model = _best_ruled(points, model, range(j, j + 1), together, workers) or model
        model = better or model
    return model


def _best_ruled(
    points: Floats, model: ExactModel, chain: range, together: float, workers: Workers
) -> ExactModel | None:
    if not _may_be_ruled(points, model, chain, together):
        return None
    ends = float(model.stack.breaks[chain.start]), float(model.stack.breaks[chain.stop])
    parts = []
    for wall in (*square_to_round(model, chain), ruled_start(points, ends, together, workers)):
        if wall is not None:
            change = with_runs(model, chain.start, chain.stop - 1, Run((wall,)))
            parts.append((points, model, Change(change, range(chain.start, chain.start + 1)), together))
    found = [(gain, better) for better, gain in workers.each(tried_free, parts) if better is not None]
    return max(found, key=lambda one: one[0])[1] if found else None


def _may_be_ruled(points: Floats, model: ExactModel, chain: range, together: float) -> bool:
    """Whether the points leave enough unexplained for the simplest ruled wall to pay."""
    walls = [model.stack.runs[j].walls[0] for j in chain]
    revolved = all(isinstance(wall, Revolved) for wall in walls)
    if revolved or any(isinstance(wall, (Ruled, Filleted, Lofted)) for wall in walls):
        return False
    more = SIMPLEST - sum(len(wall.vector) for wall in walls)
    more = max(more, 0) if len(walls) == 1 else more
    least = GAIN + price(more - PER_RUN * (len(walls) - 1), len(points), together)
    if HOPE * misfit(points, model, chain, together) > least:
        return True
    if together == 1 or clear(points, model, chain):
        return False
    if len(chain) > 1 or model.sigma > FAR:
        return True
    halves = price(len(walls[0].vector), len(points), together) + GAIN
    return BEYOND * _by_halves(points, model, chain) / together + BLURRED > max(least, halves)


def _by_halves(points: Floats, model: ExactModel, runs: range) -> float:
    """Log likelihood that the two halves of a run promise to gain by parameters of their own."""
    low, high = model.stack.breaks[[runs.start, runs.stop]].tolist()
    wall = model.stack.runs[runs.start].walls[0]
    halves = with_split(model, runs.start, [(low + high) / 2], [wall, wall])
    both = range(runs.start, runs.stop + 1)
    near = points[beside_walls(points, model, BESIDE * model.sigma)]
    return promise(evaluate(near, halves), both) - promise(evaluate(near, model), runs)


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
    saved = price(PER_RUN * (len(runs) - 1), len(points), together)
    return MUCH * misfit(points, model, runs, together) > CHEAP * more + GAIN - saved


def _smooth(model: ExactModel, k: int) -> bool:
    """Whether the walls below and above a break are one each and meet there, about."""
    below, above = model.stack.runs[k - 1], model.stack.runs[k]
    if len(below.walls) != 1 or len(above.walls) != 1:
        return False
    at = np.array([model.stack.breaks[k]])
    first, second = float(below.walls[0].area(at)[0]), float(above.walls[0].area(at)[0])
    return abs(np.sqrt(first) - np.sqrt(second)) < max(10 * model.sigma, 0.04)
