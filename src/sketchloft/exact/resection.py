"""Resection: the sections of runs found anew between the breaks and along the direction found since."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.first_stack import FEWEST
from sketchloft.exact.model import ExactModel
from sketchloft.exact.segment_walls import segment_run
from sketchloft.exact.surgery import with_run
from sketchloft.exact.trial import Change, tried

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
    place = 0
    while True:
        for change in _changes(points, model, together, cuts, upright):
            if change.runs.start < place:
                continue
            place = change.runs.start + 1
            better = tried(points, model, change, together)
            if better is not None:
                model = better
                break
        else:
            return model


def _changes(
    points: Floats, model: ExactModel, together: float, cuts: Floats, upright: float
) -> Iterator[Change]:
    for j, (run, low, high) in enumerate(model.stack.slabs()):
        leaning = (high - low) * float(np.sqrt(max(1 - upright**2, 0.0)))
        moved = max(leaning, *(float(np.abs(cuts - z).min()) for z in (low, high)))
        if moved < MOVED * model.sigma:
            continue
        margin = min(BESIDE * model.sigma, (high - low) / 5)
        ends = float(low + margin), float(high - margin)
        inner = points[(points[:, 2] > ends[0]) & (points[:, 2] < ends[1])]
        if len(inner) < FEWEST:
            continue
        found = segment_run(inner, ends, model.sigma, together, model.density)
        if found is None or [wall.kind for wall in found.walls] == [wall.kind for wall in run.walls]:
            continue
        yield Change(with_run(model, j, found), range(j, j + 1), free=True)
