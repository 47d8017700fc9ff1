"""Squared: ruled walls of four sides that go from one rectangle to another, as far as the points can tell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.kinks import sole_wall
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.search.if_it_pays import fitted_if_it_pays
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.stack import Run
from sketchloft.wall.ruled import Ruled

__all__ = ["squared"]


def squared(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Put ruled walls of four sides between rectangles that are turned alike, where the likelihood allows it.

    Parameters
    ----------
    points : (n, 3) float array
        All points.
    model : ExactModel
        Fitted to them.
    together : float
        How many of the points go together.

    Notes
    -----
    All four sides are planes then. One rectangle is above the middle of the other if that will do, too.
    """
    for j, run in enumerate(model.stack.runs):
        wall = sole_wall(run)
        if isinstance(wall, Ruled) and _has_four_sides(wall):
            model = fitted_if_it_pays(points, model, _between_rectangles(model, j, wall), together)
    return model


def _between_rectangles(model: ExactModel, j: int, wall: Ruled) -> Iterator[ExactModel]:
    low, high = _rectangle(wall.bottom), _rectangle(wall.top)
    angle = low.angle + float(np.angle(np.exp(1j * (high.angle - low.angle)))) / 2
    centre = (low.centre + high.centre) / 2
    low, high = replace(low, angle=angle), replace(high, angle=angle)
    for ends in ((replace(low, centre=centre), replace(high, centre=centre)), (low, high)):
        yield with_run(model, j, Run((replace(wall, bottom=ends[0], top=ends[1]),)))


def _has_four_sides(wall: Ruled) -> bool:
    chains = wall.bottom.chain(), wall.top.chain()
    return all(len(bulges) == 4 and not np.any(bulges) for _, bulges in chains)


def _rectangle(outline: ChainOutline) -> Rectangle:
    """Rectangle nearest to a quadrangle, its corners in the same order."""
    a, b, c, d = outline.chain()[0]
    along, across = (a - b + d - c) / 2, (a - d + b - c) / 2
    turned = np.array([across[1], -across[0]])  # a quarter turn back
    angle = np.angle((along / np.hypot(*along) + turned / np.hypot(*turned)) @ [1, 1j])
    return Rectangle((a + b + c + d) / 4, float(np.hypot(*along)), float(np.hypot(*across)), float(angle))
