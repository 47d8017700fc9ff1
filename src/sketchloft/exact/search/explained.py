"""Explained: from a first stack to the runs that explain a sample best, by evidence at a noise that blurs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.evidence import improved
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.likelihood import beside_walls, rising
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import natural_joins
from sketchloft.exact.model.soundness import sound
from sketchloft.exact.search.as_capsule import as_capsule
from sketchloft.exact.search.resection import resectioned
from sketchloft.exact.search.upended import upended
from sketchloft.exact.search.upright import upright
from sketchloft.exact.start.start import BESIDE, Start
from sketchloft.workers import Workers

__all__ = ["AT_LEAST", "explained"]

AT_LEAST = 0.004
"""Noise that the evidence is judged with at least: sharper walls would trap the search."""
QUIETER = 0.75
"""Share of the noise that a model was found with, below which the evidence is judged anew with its own."""


def explained(start: Start, *, tilt: bool, lofts: bool, workers: Workers) -> tuple[ExactModel, Floats]:
    """Change the first stack as long as it pays.

    Parameters
    ----------
    start : Start
    tilt : bool
        Whether the direction moves, too.
    lofts : bool
        Whether free lofts are tried.
    workers : Workers

    Returns
    -------
    ExactModel
        Of the sample.
    (3, 3) float array
        The rotation: its points = the sample's @ rotation.
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
    return model, turn


def _quieter(points: Floats, model: ExactModel) -> ExactModel:
    """The model with the noise that suits it, where that is much less than what it was found with."""
    if QUIETER * model.sigma <= AT_LEAST:
        return model
    near = points[beside_walls(points, model, BESIDE * model.sigma)]
    found, _, _ = climb(near, model, 8, noise=True, least=AT_LEAST, most=model.sigma)
    return found if found.sigma < QUIETER * model.sigma else model
