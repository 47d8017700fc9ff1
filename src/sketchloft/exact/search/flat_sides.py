"""Flat sides: those of a ruled wall whose edges run alike at both ends, as far as the points can tell."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.surgery import with_wall
from sketchloft.exact.search.as_many_as_pay import as_many_as_pay, telling
from sketchloft.exact.search.flush import polygon_between
from sketchloft.outline.chain import chords, outward
from sketchloft.wall.ruled import Ruled

__all__ = ["flat_sides"]

TURNED = 0.1
"""Sine of the angle between two edges, above which the side between them is meant to be warped."""
PARALLEL = 1e-12
"""The same, below which they are parallel."""


def flat_sides(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Make sides of ruled walls planes where the likelihood allows it.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.

    Notes
    -----
    A side between two lines is a plane if these are parallel. Both are turned to their mean direction, each
    about its middle; that takes a parameter away, so that it may cost what one is worth by Schwarz's
    criterion.
    """
    places = [
        (j, i, wall, sides)
        for j, run in enumerate(model.stack.runs)
        for i, wall in enumerate(run.walls)
        if isinstance(wall, Ruled) and (sides := _nearly_flat(wall))
    ]
    near = telling(points, model) if places else points[:0]
    worth = together * price(1, len(points), together)
    for j, i, wall, sides in places:
        model = as_many_as_pay(near, model, sides, worth, partial(_with_flat, model, (j, i), wall))
    return model


def _with_flat(model: ExactModel, place: tuple[int, int], wall: Ruled, flat: list[int]) -> ExactModel | None:
    flatter = _flattened(wall, flat)
    return None if flatter is None else with_wall(model, *place, flatter)


def _nearly_flat(wall: Ruled) -> list[int]:
    """Which sides go from a line to one of nearly the same direction, and are no planes yet."""
    (below, bulges), (above, more) = wall.bottom.chain(), wall.top.chain()
    first, last = _directions(below), _directions(above)
    turned = first[:, 0] * last[:, 1] - first[:, 1] * last[:, 0]
    facing = np.einsum("ij,ij->i", first, last) > 0
    straight = ~(np.any(bulges) | np.any(more))
    nearly = facing & straight & (np.abs(turned) < TURNED) & (np.abs(turned) > PARALLEL)
    return [int(k) for k in np.flatnonzero(nearly)]


def _flattened(wall: Ruled, flat: list[int]) -> Ruled | None:
    """The wall with the edges of some sides turned to their mean direction; None where they do not meet."""
    chains = [end.chain()[0] for end in (wall.bottom, wall.top)]
    # An edge says where its direction is with the cube of its length.
    along = sum(np.linalg.norm(chords(chain), axis=1)[:, None] ** 3 * _directions(chain) for chain in chains)
    common = outward(along / np.linalg.norm(along, axis=1, keepdims=True))
    ends = []
    for chain in chains:
        middles, normals = chain + chords(chain) / 2, outward(_directions(chain))
        normals[flat] = common[flat]
        offsets = np.einsum("ij,ij->i", normals, middles)
        ends.append(polygon_between(list(zip(normals, offsets.tolist(), strict=True))))
    bottom, top = ends
    return None if bottom is None or top is None else replace(wall, bottom=bottom, top=top)


def _directions(vertices: Floats) -> Floats:
    """Unit vectors (m, 2) along the edges of a polygon."""
    along = chords(vertices)
    unit: Floats = along / np.linalg.norm(along, axis=1, keepdims=True)
    return unit
