"""Search: from a first stack to the model that explains the points best, fitted to all of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.evidence import improved, merged
from sketchloft.exact.changes.misfit import misfit
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.inward_gap import without_gap
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.fit.sharpen import least_noise, sharpened
from sketchloft.exact.model.exact_model import ExactModel, thicker
from sketchloft.exact.model.joins import natural_joins
from sketchloft.exact.model.soundness import sound
from sketchloft.exact.search.absorbed import without_absorbed
from sketchloft.exact.search.coaxial import coaxial
from sketchloft.exact.search.flush import flush
from sketchloft.exact.search.resection import resectioned
from sketchloft.exact.search.stray_strokes import counted
from sketchloft.exact.search.upended import upended
from sketchloft.exact.search.upright import upright
from sketchloft.exact.start.start import BESIDE, Start
from sketchloft.wall.lofted import Lofted

__all__ = ["Found", "searched"]

AT_LEAST = 0.004
"""Noise that the evidence is judged with at least: sharper walls would trap the search."""
BLURRED = 0.006
"""Noise, as a share of the size, above which the walls of a cloud of strokes may be the wrong ones."""
WRONG = 15.0
"""Misfit above which those of an even cloud may be."""


@dataclass(frozen=True)
class Found:
    """Where a search ended.

    Parameters
    ----------
    start : Start
        Where it began.
    model : ExactModel
        Of all points.
    points : (n, 3) float array
        Those of the start, turned with the direction.
    turn : (3, 3) float array
        The rotation: these points = the start's points @ turn.
    value : float
        What the model is worth.
    misfit : float
        What other walls might gain, about.
    """

    start: Start
    model: ExactModel
    points: Floats
    turn: Floats
    value: float
    misfit: float


def searched(starts: tuple[Start, ...], *, tilt: bool, progress: Callable[[str], None]) -> Iterator[Found]:
    """Yield where searches end, the best first; those after it are for a model that makes no solid.

    Parameters
    ----------
    starts : tuple of Start
        The best first.
    tilt : bool
        Whether the direction moves, too.
    progress : callable
        Called with "fit" when the runs are found.

    Notes
    -----
    The first is searched for from the best start. Others are from the next one, where the points have
    something against its walls or a free loft beside other runs hides what they have; and from the next and
    the sharpest, where strokes leave its walls blurred. Each end with a free loft is followed by one without.
    """

    def search(start: Start, *, lofts: bool = True) -> Found:
        return _found(start, tilt=tilt, lofts=lofts, progress=progress)

    found = [search(starts[0])]
    others = list(starts[1:])
    if others and starts[0].together == 1 and (found[0].misfit > WRONG or _patched(found[0].model)):
        found.append(search(others.pop(0)))
    elif others and starts[0].together > 1 and found[0].model.sigma >= BLURRED:
        sharpest = min(others, key=lambda start: start.merged.sigma)
        for start in [others[0]] if others[0] is sharpest else [others[0], sharpest]:
            found.append(search(start))
            others.remove(start)
    found.sort(key=lambda end: -end.value)
    for end in chain(found, map(search, others)):
        yield end
        if any(isinstance(wall, Lofted) for run in end.model.stack.runs for wall in run.walls):
            yield search(end.start, lofts=False)


def _patched(model: ExactModel) -> bool:
    """Whether a free loft lies beside other runs, as it may where a simpler thing is seen from its side."""
    runs = model.stack.runs
    return len(runs) > 1 and any(isinstance(wall, Lofted) for run in runs for wall in run.walls)


def _found(start: Start, *, tilt: bool, lofts: bool, progress: Callable[[str], None]) -> Found:
    """Find the runs on a sample and fit them to all points."""
    sample, together, model = start.sample, start.together, start.settled
    sigma = max(model.sigma, AT_LEAST)
    natural = natural_joins(replace(natural_joins(model), sigma=sigma))
    model = natural if sound(natural) else replace(model, sigma=sigma)
    model, _, _ = climb(sample[beside_walls(sample, model, BESIDE * model.sigma)], model, 8)
    turn = np.eye(3)
    if tilt:
        model, turn = upright(sample, model, together)
    model = improved(sample @ turn, model, together, lofts=lofts)
    if tilt:
        model, rotation = upended(sample @ turn, start.merged, model, together, lofts=lofts)
        turn = turn @ rotation
        model, rotation = upright(sample @ turn, model, together)
        turn = turn @ rotation
    again = resectioned(sample @ turn, model, together, start.cuts, (start.settling @ turn)[2, 2])
    if again is not model:
        model = improved(sample @ turn, again, together, lofts=lofts)
    strays = without_absorbed(sample @ turn, model, together)
    points, model = start.points @ start.settling, strays.model
    if not strays.kept.all():
        points, sample = points[strays.among(points, sample)], sample[strays.kept]
        model = improved(sample @ turn, model, together, lofts=lofts)
    model, _, rotation = coaxial(sample @ turn, model, together, tilt=tilt)
    turn = turn @ rotation
    progress("fit")
    every = len(start.points) / len(start.sample)
    model = thicker(model, every)
    model, points, rotation = sharpened(points @ turn, model, tilt=tilt)
    turn = turn @ rotation
    model = merged(sample @ turn, thicker(model, 1 / every), together)
    model = thicker(model, every)
    model = thicker(without_gap(model, least_noise(model, len(points))), 1 / every)
    model = flush(sample @ turn, model, together)
    value = worth(sample @ turn, model, together, len(start.sample)) + strays.worth
    blurred = replace(model, sigma=max(model.sigma, AT_LEAST))
    left = misfit(sample @ turn, blurred, range(len(model.stack.runs)), together)
    model, turn = counted(thicker(model, every), len(start.points) - len(points)), start.settling @ turn
    return Found(start, model, start.points @ turn, turn, value, left)
