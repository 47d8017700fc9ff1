"""Resection: the sections of runs found anew between the breaks and along the direction found since."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.misfit import misfit
from sketchloft.exact.changes.trial import Change, tried
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.section.rarity import COMMON
from sketchloft.exact.section.segment_walls import segment_run
from sketchloft.exact.start.first_stack import FEWEST
from sketchloft.stack import Wall
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

__all__ = ["resectioned"]

MOVED = 1.5
"""Noise deviations that a break or a wall has moved by since its section was found that count."""
BESIDE = 2.0
"""Noise deviations beside a break within which points belong to neither run."""


def resectioned(
    points: Floats, model: ExactModel, together: float, cuts: Floats, upright: float
) -> ExactModel:
    """Find the sections of runs anew whose breaks or direction have moved since, and keep what pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    together : float
        How many of the points go together.
    cuts : (k + 1,) float array
        Between which sections were found.
    upright : float
        Cosine of the angle between the direction then and now.
    """
    for j in range(len(model.stack.runs)):
        again = _moved(model, j, cuts, upright, together) and not _settled(points, model, j, together)
        change = _change(points, model, j, together) if again else None
        if change is not None:
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
    walls = model.stack.runs[j].walls
    return (
        together == 1
        and all(_plain(wall) for wall in walls)
        and misfit(points, model, range(j, j + 1), together) == 0
    )


def _plain(wall: Wall) -> bool:
    if isinstance(wall, Revolved):
        return not isinstance(wall.profile, SplineProfile)
    return isinstance(wall, Swept) and isinstance(wall.outline, COMMON)


def _change(points: Floats, model: ExactModel, j: int, together: float) -> Change | None:
    """A run with its section found anew; None where there is none, or walls of the same kinds."""
    low, high = model.stack.breaks[[j, j + 1]].tolist()
    margin = min(BESIDE * model.sigma, (high - low) / 5)
    ends = low + margin, high - margin
    inner = points[(points[:, 2] > ends[0]) & (points[:, 2] < ends[1])]
    if len(inner) < FEWEST:
        return None
    found = segment_run(inner, ends, model.sigma, together, model.density)
    kinds = [wall.kind for wall in model.stack.runs[j].walls]
    if found is None or [wall.kind for wall in found.walls] == kinds:
        return None
    return Change(with_run(model, j, found), range(j, j + 1), free=True)
