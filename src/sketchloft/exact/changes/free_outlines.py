"""Free outlines: as many poles for an outline that is a spline as the points pay for, where it needs them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.trial import Change, tried_free
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_wall
from sketchloft.outline.fitted_loop import fitted_loop
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.wall.swept import Swept

__all__ = ["with_poles_that_pay"]

RICH = 36
"""Poles of a spline that follows the points wherever they lead."""
POLES = (8, 12, 16, 20, 24, 30)
"""Numbers of poles that are tried."""
CHEAP = 2.5
"""What each pole must gain: as those of a free loft, they are there to follow the points."""
PATIENCE = 2
"""Numbers of poles in turn that may not pay: a curve with waves needs as many as suit them."""
AROUND = 8 * RICH


def with_poles_that_pay(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Other poles for each outline that is a spline, as long as they pay.

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
            if isinstance(wall, Swept) and isinstance(wall.outline, SplineLoop):
                model = _refined(points, model, (j, i), len(wall.outline.poles), together)
    return model


def _refined(
    points: Floats, model: ExactModel, place: tuple[int, int], held: int, together: float
) -> ExactModel:
    """The model with other poles than those held at a place, where they pay."""
    runs = range(place[0], place[0] + 1)
    follows, _ = tried_free(points, model, Change(_redrawn(model, place, RICH), runs, -np.inf), together)
    if follows is None:
        return model
    missed = 0
    for count in (count for count in POLES if count >= held):
        more = count - held
        handicap = CHEAP * more - price(more, len(points), together)
        change = Change(_redrawn(follows, place, count), runs, handicap)
        better, _ = tried_free(points, model, change, together)
        if better is not None:
            model, held, missed = better, count, 0
            continue
        missed += 1
        if missed == PATIENCE:
            break
    return model


def _redrawn(model: ExactModel, place: tuple[int, int], count: int) -> ExactModel:
    """The same outline, nearly, with so many poles."""
    j, i = place
    wall = model.stack.runs[j].walls[i]
    if not isinstance(wall, Swept):
        return model
    return with_wall(
        model, j, i, replace(wall, outline=fitted_loop(wall.outline.boundary(AROUND).points, count))
    )
