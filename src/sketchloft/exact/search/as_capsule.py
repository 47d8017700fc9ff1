"""As capsule: a bar with fillets on all edges that leave no flats is one, seen along its length."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.round_ends import capped
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb, fit_density
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.surgery import with_split
from sketchloft.outline.placed_polygons import RoundedRectangle
from sketchloft.stack import Run, Stack
from sketchloft.wall.filleted import Filleted

__all__ = ["as_capsule"]

FLAT = 0.3
"""Largest width of a flat between two fillets that may be none, in their radius."""
ROUNDS, STEPS = 2, 8


def as_capsule(points: Floats, model: ExactModel, together: float) -> tuple[ExactModel, Floats]:
    """Take a bar that is rounded all around for a capsule where that explains more.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    together : float
        How many of the points go together.

    Returns
    -------
    ExactModel
    (3, 3) float array
        The rotation: new points = old points @ rotation.
    """
    found = _capsule(model, len(points))
    if found is None:
        return model, np.eye(3)
    capsule, turn = found
    bar, end = _fitted(points, model), _fitted(points @ turn, capsule)
    gain = worth(points @ turn, end, together, len(points)) - worth(points, bar, together, len(points))
    return (end, turn) if gain > 0 else (model, np.eye(3))


def _fitted(points: Floats, model: ExactModel) -> ExactModel:
    for _ in range(ROUNDS):
        model, _, _ = climb(points, fit_density(points, model, 2), STEPS)
    return fit_density(points, model, 1)


def _capsule(model: ExactModel, count: int) -> tuple[ExactModel, Floats] | None:
    """The capsule, of so many points, that a bar may be, and the rotation that brings its length along z."""
    wall, (low, *_, high) = model.stack.walls[0], model.stack.breaks.tolist()
    if len(model.stack.walls) > 1 or not isinstance(wall, Filleted) or wall.ends != "both":
        return None
    outline = wall.outline
    sizes = np.array([outline.width, outline.height, high - low])
    long = int(sizes.argmax())
    across = np.delete(sizes, long)
    if not isinstance(outline, RoundedRectangle) or across.max() > (2 + FLAT) * wall.radius:
        return None
    cos, sin = np.cos(outline.angle), np.sin(outline.angle)
    turn = np.roll([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]], 2 - long, axis=0).T
    x, y, z = (np.array([*outline.centre, (low + high) / 2]) @ turn).tolist()
    ends = z - sizes[long] / 2, z + sizes[long] / 2
    heights, walls = capped(np.array([x, y]), float(across.mean()) / 2, ends, (-1, 1))
    density = np.zeros(len(model.density.coefficients))
    density[0] = np.log(count / float(sizes.prod()))
    middle = Stack(np.array(ends), (Run((walls[1],)),))
    plain = model_of(middle, model.sigma, Density(density), model.stray, model.space)
    return with_split(plain, 0, heights, walls), turn
