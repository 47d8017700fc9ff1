"""Rings: runs with one hole, whose two walls may be the outer and the inner half of a torus."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.exact.changes.change import Change
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.soundness import sound
from sketchloft.exact.model.surgery import with_runs
from sketchloft.exact.section.segment_walls import tori
from sketchloft.stack import Run, section_boundary
from sketchloft.wall.profile import ArcProfile
from sketchloft.wall.revolved import Revolved

__all__ = ["rings"]

MOST_RUNS = 3
"""Runs that a ring is taken for at most: it is cut where it is widest, or where it begins to be narrower."""
HEIGHTS = 25
AROUND = 48
REACH = 1.05
"""Radius of the arcs that a ring starts with at least, in half its height."""


def rings(model: ExactModel) -> Iterator[Change]:
    """A ring in the place of each run with one hole, or of a few such runs, where what is there is sound."""
    if not sound(model):  # anything would be better
        return
    runs = model.stack.runs
    for first in range(len(runs)):
        for last in reversed(range(first, min(first + MOST_RUNS, len(runs)))):
            if _may_be_ring(runs[first : last + 1]):
                for ring in _rings(model, first, last):
                    yield Change(with_runs(model, first, last, ring), range(first, first + 1), free=True)


def _may_be_ring(runs: tuple[Run, ...]) -> bool:
    """Whether runs have one hole each, and are no torus already."""
    holed = all(len(run.walls) == 2 and run.holes for run in runs)
    return holed and (len(runs) > 1 or runs[0].torus is None)


def _rings(model: ExactModel, first: int, last: int) -> Iterator[Run]:
    """Rings as wide as some runs: whole tori, then of two arcs each.

    These go through all of the walls there, or begin half-way up, where the walls are steepest.
    """
    runs, breaks = model.stack.runs[first : last + 1], model.stack.breaks[first : last + 2]
    z = np.linspace(breaks[0], breaks[-1], HEIGHTS)
    at = np.clip(np.searchsorted(breaks, z) - 1, 0, len(runs) - 1)
    areas = [[run.walls[i].area(z) for run in runs] for i in (0, 1)]
    outer, inner = (np.sqrt(np.choose(at, area) / np.pi) for area in areas)
    centre = section_boundary(runs[0].walls[0], float(z[at == 0].mean()), AROUND).centre
    height, widest, narrowest = (float(row[HEIGHTS // 2]) for row in (z, outer, inner))
    radius = max((widest - narrowest) / 2, REACH * float(np.ptp(z)) / 2)
    starts = [
        [ArcProfile(height, widest - radius, radius), ArcProfile(height, narrowest + radius, radius, -1)]
    ]
    through = [*tori(z, outer), *tori(z, inner)]
    if [arc.side for arc in through] == [1, -1]:
        starts.insert(0, through)
    for arcs in (*map(_whole, starts), *starts):
        yield Run(tuple(Revolved(centre, arc) for arc in arcs), 1)


def _whole(arcs: list[ArcProfile]) -> list[ArcProfile]:
    """The halves of the torus between two arcs."""
    height, offset, radius = np.mean(
        [(arc.height, arc.offset or 0.0, arc.radius) for arc in arcs], axis=0
    ).tolist()
    return [ArcProfile(height, offset, radius, side) for side in (1, -1)]
