"""Search: from a first stack to the model that explains the points best, fitted to all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.evidence import improved, merged
from sketchloft.exact.changes.trial import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.inward_gap import without_gap
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.fit.sharpen import least_noise, sharpened
from sketchloft.exact.model.exact_model import ExactModel, thicker
from sketchloft.exact.model.joins import natural_joins
from sketchloft.exact.search.coaxial import coaxial
from sketchloft.exact.search.flush import flush
from sketchloft.exact.search.resection import resectioned
from sketchloft.exact.search.upended import upended
from sketchloft.exact.search.upright import upright
from sketchloft.exact.start.start import BESIDE, Start

__all__ = ["Found", "searched"]

AT_LEAST = 0.004
"""Noise that the evidence is judged with at least: sharper walls would trap the search."""
BLURRED = 0.006
"""Noise, as a share of the size, above which the walls of a cloud of strokes may be the wrong ones."""


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
    """

    start: Start
    model: ExactModel
    points: Floats
    turn: Floats
    value: float


def searched(starts: tuple[Start, ...], *, tilt: bool, lofts: bool, progress: Callable[[str], None]) -> Found:
    """Search from the best start, and where its walls stay blurred from the next one and the sharpest.

    Parameters
    ----------
    starts : tuple of Start
        The best first.
    tilt : bool
        Whether the direction moves, too.
    lofts : bool
        Whether free walls are tried.
    progress : callable
        Called with "fit" when the runs are found.
    """
    found = _found(starts[0], tilt=tilt, lofts=lofts, progress=progress)
    others = starts[1:]
    if found.start.together == 1 or found.model.sigma < BLURRED or not others:
        return found
    sharpest = min(others, key=lambda start: start.merged.sigma)
    next_best = [others[0]] if others[0] is sharpest else [others[0], sharpest]
    again = [_found(start, tilt=tilt, lofts=lofts, progress=progress) for start in next_best]
    return max([found, *again], key=lambda one: one.value)


def _found(start: Start, *, tilt: bool, lofts: bool, progress: Callable[[str], None]) -> Found:
    """Find the runs on a sample and fit them to all points."""
    sample, together, model = start.sample, start.together, start.settled
    model = natural_joins(replace(natural_joins(model), sigma=max(model.sigma, AT_LEAST)))
    model, _, _ = climb(sample[beside_walls(sample, model, BESIDE * model.sigma)], model, 8)
    turn = np.eye(3)
    if tilt:
        model, turn = upright(sample, model, together)
    model = improved(sample @ turn, model, together, lofts=lofts)
    if tilt:
        model, rotation = upended(sample @ turn, model, together, lofts=lofts)
        turn = turn @ rotation
        model, rotation = upright(sample @ turn, model, together)
        turn = turn @ rotation
    again = resectioned(sample @ turn, model, together, start.cuts, (start.settling @ turn)[2, 2])
    if again is not model:
        model = improved(sample @ turn, again, together, lofts=lofts)
    model, _, rotation = coaxial(sample @ turn, model, together, tilt=tilt)
    turn = turn @ rotation
    progress("fit")
    every = len(start.points) / len(sample)
    model = thicker(model, every)
    model, points, rotation = sharpened(start.points @ start.settling @ turn, model, tilt=tilt)
    turn = turn @ rotation
    model = merged(sample @ turn, thicker(model, 1 / every), together)
    model = thicker(model, every)
    model = thicker(without_gap(model, least_noise(model, len(points))), 1 / every)
    model = flush(sample @ turn, model, together)
    value = worth(sample @ turn, model, together, len(sample))
    return Found(start, thicker(model, every), points, start.settling @ turn, value)
