"""Upright: walls that slant all alike stand straight on a direction that leans with them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.simpler_walls import as_revolved
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.likelihood import beside_walls
from sketchloft.exact.fit.tilt import onto_z
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.joins import natural_joins
from sketchloft.outline.circle import Circle
from sketchloft.stack import Wall
from sketchloft.wall.swept import Swept

__all__ = ["upright"]

BESIDE = 12.0
"""Noise deviations from the walls within which points decide."""
STEEPEST = 0.15
"""Largest slant that is taken for a direction that was found askew."""


def upright(points: Floats, model: ExactModel, together: float) -> tuple[ExactModel, Floats]:
    """Turn the direction so that no wall slants, if it pays.

    Returns
    -------
    ExactModel
    (3, 3) float array
        The rotation: new points = old points @ rotation.
    """
    slants = [
        (slant, high - low)
        for run, low, high in model.stack.slabs()
        for wall in run.walls
        if (slant := _slant(wall)) is not None
    ]
    if not slants:
        return model, np.eye(3)
    mean = np.average([drift for drift, _ in slants], axis=0, weights=[height for _, height in slants])
    if np.hypot(*mean) > STEEPEST:
        return model, np.eye(3)
    turn = onto_z(mean)
    turned = points @ turn
    stack = model.stack.with_walls(_straight)
    straight = model_of(stack, model.sigma, model.density, model.stray, model.space)
    near = turned[beside_walls(turned, straight, BESIDE * model.sigma)]
    straight, _, rotation = climb(near, natural_joins(straight), 12, tilt=True)
    straight = natural_joins(straight)
    count = len(points)
    pays = worth(turned @ rotation, straight, together, count) > worth(points, model, together, count)
    return (straight, turn @ rotation) if pays else (model, np.eye(3))


def _slant(wall: Wall) -> Floats | None:
    """Movement of a wall's middle per height, where it is free; also of a cone with its tip beside it."""
    if not isinstance(wall, Swept):
        return None
    if "drift" in wall.free:
        return wall.drift
    if isinstance(wall.outline, Circle) and "taper" in wall.free and not wall.bows:
        return wall.taper * (wall.outline.centre - wall.pivot)
    return None


def _straight(wall: Wall) -> Wall:
    """The wall without its slant."""
    if not isinstance(wall, Swept) or _slant(wall) is None:
        return wall
    free = tuple(name for name in wall.free if name != "drift")
    return as_revolved(replace(wall, drift=np.zeros(2), free=free).about_centre())
