"""Free outlines: a spline for an outline of many edges, with as many poles as pay, where it needs them."""

from __future__ import annotations

from dataclasses import replace

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.free_trial import tried_free
from sketchloft.exact.fit.clear import clear
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_wall
from sketchloft.exact.section.rarity import LAST, may_be_free, rarity
from sketchloft.outline.fitted_loop import fitted_loop
from sketchloft.outline.outline import Outline
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.wall.swept import Swept

__all__ = ["with_poles_that_pay"]

RICH = 36
"""Poles of a spline that follows the points wherever they lead."""
POLES = (8, 10, 12, 16, 20, 24, 30)
"""Numbers of poles that are tried."""
CHEAP = 2.5
"""What each pole must gain: as those of a free loft, they are there to follow the points."""
PATIENCE = 3
"""Numbers of poles in turn that may not pay: a curve with waves needs as many as suit them."""
AROUND = 8 * RICH


def with_poles_that_pay(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Other poles for each outline that is a spline, and a spline for one of many edges, where they pay.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.

    Notes
    -----
    Where a spline has its knots is decided by its start, which the contour of a blurred density gives. A rich
    spline is nearer to the points, and those of fewer poles start from it.
    """
    for j, run in enumerate(model.stack.runs):
        for i, wall in enumerate(run.walls):
            if isinstance(wall, Swept) and _may_be_free(points, model, (j, i), wall.outline, together):
                model = _refined(points, model, (j, i), wall.outline, together)
    return model


def _may_be_free(
    points: Floats, model: ExactModel, place: tuple[int, int], outline: Outline, together: float
) -> bool:
    """Whether an outline may stand for a free curve: by its kind, or as strokes leave it blurred."""
    runs = range(place[0], place[0] + 1)
    return may_be_free(outline) or (together > 1 and not clear(points, model, runs))


def _refined(
    points: Floats, model: ExactModel, place: tuple[int, int], outline: Outline, together: float
) -> ExactModel:
    """The model with other poles than those of the outline at a place, or with some, where they pay."""
    runs, count = range(place[0], place[0] + 1), len(points)
    splined = isinstance(outline, SplineLoop)
    held = len(outline.vector) if splined else POLES[0]
    odds = 0.0 if splined else LAST - rarity(outline)
    least = odds - price(RICH - held, count, together)
    follows, _ = tried_free(points, model, Change(_redrawn(model, place, RICH), runs, least), together)
    if follows is None:
        if not splined:  # it does not gain what the stiffest spline would cost
            return model
        follows = model
    missed = 0
    for poles in (poles for poles in POLES if poles >= held):
        more = poles - held
        handicap = odds + CHEAP * more - price(more, count, together)
        change = Change(_redrawn(follows, place, poles), runs, handicap)
        better, _ = tried_free(points, model, change, together)
        if better is not None:
            model, held, splined, odds, missed = better, poles, True, 0.0, 0
            continue
        missed += splined
        if missed == PATIENCE:
            break
    return model


def _redrawn(model: ExactModel, place: tuple[int, int], poles: int) -> ExactModel:
    """The same outline, nearly, as a spline with so many poles."""
    j, i = place
    wall = model.stack.runs[j].walls[i]
    if not isinstance(wall, Swept):
        return model
    return with_wall(
        model, j, i, replace(wall, outline=fitted_loop(wall.outline.boundary(AROUND).points, poles))
    )
