"""From a plan to its model, and what can be wrong with it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.errors import InputError
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of, tied
from sketchloft.exact.model.joins import joined
from sketchloft.exact.model.kinks import with_kink
from sketchloft.plan.from_model import followed
from sketchloft.plan.plan import PlannedBody, PlannedWall, Shared
from sketchloft.plan.ties import tied_pairs
from sketchloft.plan.walls import FORMS
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

__all__ = ["model_from_plan"]

EMPTY = Density(np.zeros(1))
SLACK = 1e-8
"""Share of a run's height by which its walls may end before it does."""
MEANING = {
    "cross": "the walls of the runs beside it do not cross there",
    "tangent": "neither of the walls beside it is an arc alone in its run",
    "pole": "the wall beside it is no arc alone in its run, nor half of a whole torus",
}


def model_from_plan(
    body: PlannedBody, scale: float, density: Density = EMPTY, stray: float = 1.0, space: float = 1.0
) -> ExactModel:
    """Make the model that a plan describes.

    Parameters
    ----------
    body : PlannedBody
    scale : float
        Length of the model's unit, in that of the plan.
    density : Density
    stray, space : float
        As in `ExactModel`.

    Raises
    ------
    InputError
        If values do not go together; the message begins with their place.
    """
    walls = [
        [_wall(wall, body, scale, f"run {j}, wall {i}") for i, wall in enumerate(run, start=1)]
        for j, run in enumerate(body.runs, start=1)
    ]
    runs = tuple(
        Run(tuple(made), sum(wall.hole for wall in run)) for made, run in zip(walls, body.runs, strict=True)
    )
    heights = np.array([at.height for at in body.breaks]) / scale
    _check_rising(heights * scale, "expected one above it")
    for j, made in enumerate(walls):
        for i, wall in enumerate(made):
            _check_reach(wall, heights[j : j + 2], scale, f"run {j + 1}, wall {i + 1}")
    for k in range(1, len(runs)):
        if body.breaks[k].join == "cross":
            runs = (*runs[: k - 1], *with_kink(*runs[k - 1 : k + 1]), *runs[k + 1 :])
    model = model_of(Stack(heights, runs), body.noise / scale, density, stray, space)
    model = tied(model, tied_pairs(body, walls))
    model = joined(replace(model, joins=tuple(at.join for at in body.breaks)))
    _check_joins(model)
    _check_rising(model.stack.breaks * scale, "where the walls meet now; make one of them a step")
    return model


def _wall(wall: PlannedWall, body: PlannedBody, scale: float, place: str) -> Wall:
    form = FORMS[wall.kind]
    values: dict[str, Any] = {}
    for field in form.fields:
        value = wall.values.get(field.name)
        if value is not None:
            written = body.shared[value.name] if isinstance(value, Shared) else value
            values[field.name] = field.modelled(written, scale)
    try:
        made: Wall = form.make(values)
    except ValueError as error:
        raise InputError(f"{place}: {error}") from None
    return made


def _check_reach(wall: Wall, ends: Floats, scale: float, place: str) -> None:
    """Find out whether a wall has a section at both ends of its run."""
    low, high = ends * scale
    slack = SLACK * (ends[1] - ends[0])
    knots = wall.knots if isinstance(wall, Lofted) else None
    if isinstance(wall, Revolved) and isinstance(wall.profile, SplineProfile):
        knots = wall.profile.knots
    if knots is not None and (knots[0] > ends[0] + slack or knots[-1] < ends[1] - slack):
        raise InputError(
            f"{place}: found knots from {knots[0] * scale:.6g} to {knots[-1] * scale:.6g}, expected them to "
            f"reach from {low:.6g} to {high:.6g} as the run does"
        )
    for tip in wall.tips() if isinstance(wall, Swept) else ():
        if ends[0] + slack < tip < ends[1] - slack:
            raise InputError(
                f"{place}: found a wall that comes to a point at {tip * scale:.6g}, "
                f"expected none within the run, from {low:.6g} to {high:.6g}"
            )


def _check_rising(heights: Floats, expected: str) -> None:
    for k in np.flatnonzero(np.diff(heights) <= 0):
        raise InputError(
            f"break {k + 2}: found the height {heights[k + 1]:.6g} after {heights[k]:.6g}, {expected}"
        )


def _check_joins(model: ExactModel) -> None:
    follows = followed(model)
    for k, join in enumerate(model.joins):
        if join != "step" and not follows[k]:
            raise InputError(
                f'break {k + 1}: found join = "{join}", but {MEANING[join]}; make it a step with a height, '
                "or change the walls"
            )
