"""Box along: a box seen along another of its edges, from where its points are a stack of their own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.stack import Stack

__all__ = ["BoxAlong", "box_along", "box_sizes", "evenly_filled"]


@dataclass(frozen=True)
class BoxAlong:
    """A box with one of its edges along z.

    Parameters
    ----------
    turn : (3, 3) float array
        The rotation that brought the edge there: new points = old points @ rotation.
    centre : (2,) float array
    width, height : float
        Its other edges, along x and y.
    ends : (low, high)
        Heights.
    """

    turn: Floats
    centre: Floats
    width: float
    height: float
    ends: tuple[float, float]


def box_sizes(section: Rectangle | RoundedRectangle, low: float, high: float) -> Floats:
    """Edges (3,) of a box between two heights: the width and height of its section, and its length."""
    return np.array([section.width, section.height, high - low])


def box_along(section: Rectangle | RoundedRectangle, low: float, high: float, edge: int) -> BoxAlong:
    """Turn a box between two heights so that one of its edges, in the order of `box_sizes`, is along z."""
    cos, sin = np.cos(section.angle), np.sin(section.angle)
    axes = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
    turn = np.ascontiguousarray(np.roll(axes, 2 - edge, axis=0).T)
    x, y, z = (np.array([*section.centre, (low + high) / 2]) @ turn).tolist()
    width, height, length = np.roll(box_sizes(section, low, high), 2 - edge).tolist()
    return BoxAlong(turn, np.array([x, y]), width, height, (z - length / 2, z + length / 2))


def evenly_filled(stack: Stack, model: ExactModel, density: float) -> ExactModel:
    """Make a model of an evenly filled stack, of so many points per volume, with the noise of another."""
    coefficients = np.zeros(len(model.density.coefficients))
    coefficients[0] = np.log(density)
    return model_of(stack, model.sigma, Density(coefficients), model.stray, model.space)
