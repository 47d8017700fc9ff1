"""Resection: the sections of runs found anew between the breaks and along the direction found since."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.misfit import misfit
from sketchloft.exact.changes.trial import tried
from sketchloft.exact.fit.clear import clear
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.section.rarity import COMMON, rarer
from sketchloft.exact.section.segment_walls import segment_run
from sketchloft.exact.start.first_stack import FEWEST, sketchy
from sketchloft.exact.start.start import Start
from sketchloft.stack import Wall
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept
from sketchloft.workers import ALONE, Workers

__all__ = ["resectioned"]

MOVED = 1.5
"""Noise deviations that a break or a wall has moved by since its section was found that count."""
BESIDE = 2.0
"""Noise deviations beside a break within which points belong to neither run."""


def resectioned(
    points: Floats, model: ExactModel, start: Start, upright: float, workers: Workers = ALONE
) -> ExactModel:
    """Find the sections of runs anew whose breaks or direction have moved since, or whose points are few.

    What pays is kept.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    start : Start
        Where the search began.
    upright : float
        Cosine of the angle between the direction then and now.
    workers : Workers, optional
    """
    together = start.together
    among = {j: _between(points, model, j) for j in range(len(model.stack.runs))}
    moved = [
        j
        for j, (inner, _) in among.items()
        if len(inner) >= FEWEST
        and (sketchy(inner, together) or _moved(model, j, start.cuts, upright, together))
    ]
    settled = workers.each(_settled, [(points, model, j, together) for j in moved])
    again = {j: among[j] for j, done in zip(moved, settled, strict=True) if not done}
    parts = [(inner, ends, model.sigma, together, model.density) for inner, ends in again.values()]
    for j, run in zip(again, workers.beside(segment_run, parts), strict=True):
        if run is not None and run.kinds != model.stack.runs[j].kinds:
            handicap = rarer(run.walls, model.stack.runs[j].walls)
            change = Change(with_run(model, j, run), range(j, j + 1), handicap, free=True)
            model = tried(points, model, change, together) or model
    return model


def _moved(model: ExactModel, j: int, cuts: Floats, upright: float, together: float) -> bool:
    """Whether a break of a run, or its walls with the direction, are elsewhere; or strokes let it grow."""
    low, high = model.stack.breaks[[j, j + 1]].tolist()
    near = MOVED * model.sigma
    if together > 1 and ((cuts > low + near) & (cuts < high - near)).any():
        return True
    leaning = (high - low) * float(np.sqrt(max(1 - upright**2, 0.0)))
    return max(leaning, *(float(np.abs(cuts - z).min()) for z in (low, high))) > near


def _settled(points: Floats, model: ExactModel, j: int, together: float) -> bool:
    """Whether there is nothing simpler than the walls of a run, and the points have nothing against them."""
    if not all(_plain(wall) for wall in model.stack.runs[j].walls):
        return False
    runs = range(j, j + 1)
    return misfit(points, model, runs, together) == 0 if together == 1 else clear(points, model, runs)


def _plain(wall: Wall) -> bool:
    if isinstance(wall, Revolved):
        return not isinstance(wall.profile, SplineProfile)
    return isinstance(wall, Swept) and isinstance(wall.outline, COMMON)


def _between(points: Floats, model: ExactModel, j: int) -> tuple[Floats, tuple[float, float]]:
    """Points of a run away from its breaks, and between which heights."""
    low, high = model.stack.breaks[[j, j + 1]].tolist()
    margin = min(BESIDE * model.sigma, (high - low) / 5)
    ends = low + margin, high - margin
    return points[(points[:, 2] > ends[0]) & (points[:, 2] < ends[1])], ends
