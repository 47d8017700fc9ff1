"""As capsule: a bar with fillets on all edges that leave no flats is one, seen along its length."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.round_ends import capped
from sketchloft.exact.changes.worth import worth
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_split
from sketchloft.exact.search.box_along import box_along, box_sizes, evenly_filled
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
    sizes = box_sizes(outline, low, high)
    seen = box_along(outline, low, high, int(sizes.argmax()))
    if not isinstance(outline, RoundedRectangle) or max(seen.width, seen.height) > (2 + FLAT) * wall.radius:
        return None
    heights, walls = capped(seen.centre, (seen.width + seen.height) / 4, seen.ends, (-1, 1))
    middle = Stack(np.array(seen.ends), (Run((walls[1],)),))
    plain = evenly_filled(middle, model, count / float(sizes.prod()))
    return with_split(plain, 0, heights, walls), seen.turn
