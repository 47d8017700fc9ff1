"""Search: from a first stack to the model that explains the points best, fitted to all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.evidence import improved, merged
from sketchloft.exact.changes.misfit import misfit
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.inward_gap import without_gap
from sketchloft.exact.fit.likelihood import beside_walls, rising
from sketchloft.exact.fit.sharpen import least_noise, sharpened
from sketchloft.exact.model.exact_model import ExactModel, thicker
from sketchloft.exact.model.joins import natural_joins
from sketchloft.exact.model.soundness import sound
from sketchloft.exact.search.absorbed import without_absorbed
from sketchloft.exact.search.as_capsule import as_capsule
from sketchloft.exact.search.coaxial import coaxial
from sketchloft.exact.search.flat_sides import flat_sides
from sketchloft.exact.search.flush import flush
from sketchloft.exact.search.kinked import kinked
from sketchloft.exact.search.resection import resectioned
from sketchloft.exact.search.squared import squared
from sketchloft.exact.search.stray_strokes import counted, stray_strokes
from sketchloft.exact.search.upended import upended
from sketchloft.exact.search.upright import upright
from sketchloft.exact.start.start import BESIDE, Start
from sketchloft.frame import Frame
from sketchloft.workers import ALONE, Workers

__all__ = ["Found", "search"]

AT_LEAST = 0.004
"""Noise that the evidence is judged with at least: sharper walls would trap the search."""
QUIETER = 0.75
"""Share of the noise that a model was found with, below which the evidence is judged anew with its own."""


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

    @property
    def frame(self) -> Frame:
        """Of the model, in the axes that the frame of the start is in."""
        return Frame(self.turn.T @ self.start.frame.axes)


def search(
    start: Start,
    *,
    tilt: bool,
    lofts: bool = True,
    progress: Callable[[str], None],
    workers: Workers = ALONE,
) -> Found:
    """Find the runs on a sample and fit them to all points.

    Parameters
    ----------
    start : Start
    tilt : bool
        Whether the direction moves, too.
    lofts : bool
        Whether free lofts are tried.
    progress : callable
        Called with "fit" when the runs are found.
    workers : Workers, optional
    """
    sample, together, model = rising(start.sample), start.together, start.settled
    sigma = max(model.sigma, AT_LEAST)
    natural = natural_joins(replace(natural_joins(model), sigma=sigma))
    model = natural if sound(natural) else replace(model, sigma=sigma)
    model, _, _ = climb(sample[beside_walls(sample, model, BESIDE * model.sigma)], model, 8)
    turn = np.eye(3)
    if tilt:
        model, turn = upright(sample, model, together)
    model = improved(sample @ turn, model, together, lofts=lofts, workers=workers)
    if tilt:
        model, rotation = upended(sample @ turn, start.merged, model, together, lofts=lofts, workers=workers)
        turn = turn @ rotation
        model, rotation = as_capsule(sample @ turn, model, together)
        turn = turn @ rotation
        model, rotation = upright(sample @ turn, model, together)
        turn = turn @ rotation
    again = resectioned(sample @ turn, model, start, (start.settling @ turn)[2, 2], workers)
    if again is not model:
        model = improved(sample @ turn, again, together, lofts=lofts, workers=workers)
    quiet = _quieter(sample @ turn, model)
    if quiet is not model:
        model = improved(sample @ turn, quiet, together, lofts=lofts, workers=workers)
    strays = without_absorbed(sample @ turn, model, together, workers)
    points, model = start.points @ start.settling, strays.model
    if not strays.kept.all():
        points, sample = points[strays.among(points, sample)], sample[strays.kept]
        model = improved(sample @ turn, model, together, lofts=lofts, workers=workers)
    model, _, rotation = coaxial(sample @ turn, model, together, tilt=tilt)
    turn = turn @ rotation
    progress("fit")
    every = len(start.points) / len(start.sample)
    model = thicker(model, every)
    model, points, rotation = sharpened(points @ turn, model, tilt=tilt)
    turn = turn @ rotation
    pulling = stray_strokes(sample @ turn, thicker(model, 1 / every), together, workers, sharp=True)
    if not pulling.kept.all():
        points, sample = points[pulling.among(points, sample @ turn)], sample[pulling.kept]
        model, points, rotation = sharpened(points, thicker(pulling.model, every), tilt=tilt)
        turn = turn @ rotation
    model = merged(sample @ turn, thicker(model, 1 / every), together, workers)
    model = kinked(points, squared(points, thicker(model, every), together), together)
    model = thicker(without_gap(model, least_noise(model, len(points))), 1 / every)
    model = flush(sample @ turn, model, together)
    value = worth(sample @ turn, model, together, len(start.sample)) + strays.worth + pulling.worth
    model = flat_sides(sample @ turn, model, together)  # what that costs does not count against it
    blurred = replace(model, sigma=max(model.sigma, AT_LEAST))
    left = misfit(sample @ turn, blurred, range(len(model.stack.runs)), together)
    model, turn = counted(thicker(model, every), len(start.points) - len(points)), start.settling @ turn
    return Found(start, model, start.points @ turn, turn, value, left)


def _quieter(points: Floats, model: ExactModel) -> ExactModel:
    """The model with the noise that suits it, where that is much less than what it was found with."""
    if QUIETER * model.sigma <= AT_LEAST:
        return model
    near = points[beside_walls(points, model, BESIDE * model.sigma)]
    found, _, _ = climb(near, model, 8, noise=True, least=AT_LEAST, most=model.sigma)
    return found if found.sigma < QUIETER * model.sigma else model
