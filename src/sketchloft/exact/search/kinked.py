"""Kinked: neighbouring runs whose sections are the same at their break, as far as the points can tell."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.kinks import sole_wall
from sketchloft.exact.model.set_upon import set_upon_each_other, with_bend
from sketchloft.exact.search.if_it_pays import fitted_if_it_pays
from sketchloft.stack import section_boundary
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["kinked"]

NEAR, NOISES = 0.01, 4.0
"""Sections may be one that are apart by so much of the size, and so many noise deviations, at most."""
NODES = 64


def kinked(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """Give swept and ruled walls that meet at a break one outline there, where the likelihood allows it.

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
    A roof stands upon its house: without this a thin ledge would be left all around.
    """
    for k in range(1, len(model.stack.runs)):
        model = fitted_if_it_pays(points, model, _bent(model, k), together)
    return model


def _bent(model: ExactModel, k: int) -> Iterator[ExactModel]:
    """The model with one outline for the runs below and above a break, if their sections are near."""
    below, above = (sole_wall(run) for run in model.stack.runs[k - 1 : k + 1])
    if below is None or above is None:
        return
    height = float(model.stack.breaks[k])
    if max(_apart(below, above, height), _apart(above, below, height)) > NEAR + NOISES * model.sigma:
        return
    for j, wall in set_upon_each_other(model, k):
        bent = with_bend(model, k, j, wall)
        if bent is not None:
            yield bent


def _apart(wall: Swept | Ruled, other: Swept | Ruled, height: float) -> float:
    """How far the section of a wall is from another wall at most."""
    return float(np.abs(other.foot(section_boundary(wall, height, NODES).points).distance).max())
