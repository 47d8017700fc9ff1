"""Finished: from the runs that explain a sample to the model that is fitted to all points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from sketchloft.cloud import Floats
from sketchloft.exact.changes.cap_misfit import cap_misfit
from sketchloft.exact.changes.evidence import improved, merged
from sketchloft.exact.changes.misfit import misfit
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.inward_gap import without_gap
from sketchloft.exact.fit.likelihood import rising
from sketchloft.exact.fit.sharpen import least_noise, sharpened
from sketchloft.exact.model.exact_model import ExactModel, thicker
from sketchloft.exact.search.absorbed import without_absorbed
from sketchloft.exact.search.coaxial import coaxial
from sketchloft.exact.search.explained import AT_LEAST
from sketchloft.exact.search.flat_sides import flat_sides
from sketchloft.exact.search.flush import flush
from sketchloft.exact.search.found import Found
from sketchloft.exact.search.kinked import kinked
from sketchloft.exact.search.squared import squared
from sketchloft.exact.search.stray_strokes import counted, stray_strokes
from sketchloft.exact.start.start import Start
from sketchloft.workers import Workers

__all__ = ["finished"]


def finished(
    start: Start,
    model: ExactModel,
    turn: Floats,
    *,
    tilt: bool,
    lofts: bool,
    progress: Callable[[str], None],
    workers: Workers,
) -> Found:
    """Leave out strokes that belong to no wall, fit the runs to all points, and put walls where they agree.

    Parameters
    ----------
    start : Start
    model : ExactModel
        Of its sample, turned.
    turn : (3, 3) float array
        The rotation: the points of the model = the sample's @ turn.
    tilt, lofts : bool
        As for `explained`.
    progress : callable
        Called with "fit" when strokes are left out.
    workers : Workers
    """
    sample, together = rising(start.sample), start.together
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
    left += cap_misfit(sample @ turn, blurred, together)
    model, turn = counted(thicker(model, every), len(start.points) - len(points)), start.settling @ turn
    return Found(start, model, start.points @ turn, turn, value, left)
