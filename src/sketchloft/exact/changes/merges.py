"""Merges: runs left to their neighbours, or to nobody, or one wall for two of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.simpler_walls import profiles_like
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import sole_profile
from sketchloft.exact.model.surgery import with_runs, without_run
from sketchloft.stack import Run, Wall, section_boundary
from sketchloft.wall.profile import LineProfile
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.swept import Freedom, Swept

__all__ = ["merges"]

TINY = 1e-12
HEIGHTS = 25


def merges(model: ExactModel) -> Iterator[Change]:
    """A run left to a neighbour, to both as one, or to nobody, or one wall for two, the shortest first."""
    runs = model.stack.runs
    count = len(runs)
    if count == 1:
        return
    order = np.argsort(np.diff(model.stack.breaks))
    for j in (int(k) for k in order):
        for heir in (j - 1, j + 1):
            if 0 <= heir < count:
                first = min(j, heir)
                yield Change(without_run(model, j, heir), range(first, first + 1))
                for run in (_slanted(model, heir, j), *_through_both(model, first)):
                    if run is not None:
                        yield Change(with_runs(model, first, first + 1, run), range(first, first + 1))
        if 0 < j < count - 1 and _alike(runs[j - 1], runs[j + 1]):
            lengths = np.diff(model.stack.breaks)
            heir = j - 1 if lengths[j - 1] > lengths[j + 1] else j + 1
            yield Change(with_runs(model, j - 1, j + 1, runs[heir]), range(j - 1, j))
        if j in (0, count - 1):
            place = 0 if j == 0 else count - 2
            yield Change(without_run(model, j, None), range(place, place + 1))


def _alike(below: Run, above: Run) -> bool:
    """Whether two runs may be one that a third divides."""
    return below.holes == above.holes and below.kinds == above.kinds


def _through_both(model: ExactModel, first: int) -> Iterator[Run]:
    """The cone and the sphere nearest to the profiles of a run and the next one, if both are revolved."""
    walls = [sole_profile(run) for run in model.stack.runs[first : first + 2]]
    below, above = walls
    if below is None or above is None:
        return
    low, middle, high = model.stack.breaks[first : first + 3].tolist()
    z = np.linspace(low, high, HEIGHTS)
    r = np.where(z < middle, radius_at(below.profile, z)[0], radius_at(above.profile, z)[0])
    longer = below if middle - low > high - middle else above
    for profile in profiles_like(z, r):
        if not (isinstance(profile, LineProfile) and profile.slope is None):
            yield Run((Revolved(longer.centre, profile),))


def _slanted(model: ExactModel, heir: int, other: int) -> Run | None:
    """The run of the heir, moving and growing so that it leads into the other; None if it cannot."""
    walls, breaks = model.stack.runs[heir].walls, model.stack.breaks
    others = model.stack.runs[other].walls
    if len(walls) != len(others):
        return None
    here, there = ((breaks[k] + breaks[k + 1]) / 2 for k in (heir, other))
    slanted: list[Wall] = []
    for wall, beyond in zip(walls, others, strict=True):
        if not isinstance(wall, Swept):
            return None
        free: tuple[Freedom, ...] = (
            ("drift", "taper", "twist") if "twist" in wall.free else ("drift", "taper")
        )
        if wall.free:
            slanted.append(replace(wall, free=free))
            continue
        start, end = (section_boundary(w, z, 48).centre for w, z in ((wall, here), (beyond, there)))
        areas = [max(float(w.area(np.array([z]))[0]), TINY) for w, z in ((wall, here), (beyond, there))]
        growth = np.sqrt(areas[1] / areas[0]) - 1
        drift, taper = (end - start) / (there - here), float(growth) / (there - here)
        slanted.append(replace(wall, pivot=start, drift=drift, taper=taper, height=here, free=free))
    return Run(tuple(slanted), model.stack.runs[heir].holes)
