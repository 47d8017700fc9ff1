"""From a model to its plan: what was found, in the cloud's coordinates and unit."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined
from sketchloft.frame import Frame
from sketchloft.plan.plan import Numbers, PlannedBody, PlannedBreak, PlannedWall, Shared, Value
from sketchloft.plan.ties import Place, shared_names
from sketchloft.plan.walls import FORMS, kind_of
from sketchloft.stack import Stack, Wall

__all__ = ["followed", "planned_from_model"]

SAME = 1e-9
"""Heights that differ by less, as a share of the height of all, are one."""
PUSH = 1e-3


def planned_from_model(
    name: str, model: ExactModel, frame: Frame, centre: Floats, scale: float
) -> PlannedBody:
    """Write down a model.

    Parameters
    ----------
    name : str
    model : ExactModel
    frame : Frame
        From the axes of the cloud to those of the model.
    centre : (3,) float array
        Where the origin of that frame is, in the cloud's coordinates.
    scale : float
        Length of its unit, in that of the cloud.
    """
    names = shared_names(model)
    shared: dict[str, Numbers] = {}
    runs = [
        tuple(
            _wall(wall, scale, (j, i), names, shared, hole=run.sign(i) < 0)
            for i, wall in enumerate(run.walls)
        )
        for j, run in enumerate(model.stack.runs)
    ]
    heights = model.stack.breaks
    follows = followed(model) & (np.abs(joined(model).stack.breaks - heights) <= SAME * np.ptp(heights))
    breaks = [
        PlannedBreak(join if follows[k] else "step", float(scale * heights[k]))
        for k, join in enumerate(model.joins)
    ]
    return PlannedBody(
        name,
        frame.axes[2],
        frame.axes[0],
        centre,
        float(scale * model.sigma),
        tuple(breaks),
        tuple(runs),
        shared,
    )


def _wall(
    wall: Wall,
    scale: float,
    place: tuple[int, int],
    names: dict[Place, str],
    shared: dict[str, Any],
    *,
    hole: bool,
) -> PlannedWall:
    kind = kind_of(wall)
    found = FORMS[kind].read(wall)
    values: dict[str, Value] = {}
    for field in FORMS[kind].fields:
        if found.get(field.name) is None:
            continue
        value = field.stored(found[field.name], scale)
        name = names.get((*place, field.name))
        values[field.name] = value if name is None else Shared(name)
        if name is not None:
            shared.setdefault(name, value)
    return PlannedWall(kind, values, hole)


def followed(model: ExactModel) -> NDArray[np.bool_]:
    """(k + 1,) whether each break's height follows from the walls: it comes back when it is pushed."""
    breaks = joined(model).stack.breaks
    push = PUSH * float(np.diff(breaks).min())
    pushed = joined(replace(model, stack=Stack(breaks + push, model.stack.runs))).stack.breaks
    return np.asarray(np.abs(pushed - breaks) < push / 2)
