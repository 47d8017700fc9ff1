"""Square to round: walls from a rectangle to a circle, in the place of walls that were fitted."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.outline.candidates import circle_of, rectangle_of
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.ring import ring_area
from sketchloft.stack import section_boundary
from sketchloft.wall.ruled import Ruled

__all__ = ["square_to_round"]

RING = 96
FILLED = 0.7
"""Share of the rectangle around it that such a section fills; a circle fills 0.785."""
INSIDE = 0.02
"""Share of the height of an end's run by which the section is taken inside it."""
TINY = 1e-12
"""Area of a section, in squares of the cloud's size, that is none."""


def square_to_round(model: ExactModel, runs: range) -> tuple[Ruled, ...]:
    """Walls between the sections at both ends of some runs of one wall, either taken for the round one.

    None where one of them is neither round nor square, or has shrunk to a point.

    Parameters
    ----------
    model : ExactModel
        Fitted, so that the sections show how the rectangle is turned.
    runs : range
    """
    ends: list[tuple[Rectangle, DividedCircle]] = []
    for j, k in ((runs.start, runs.start), (runs.stop - 1, runs.stop)):
        low, high = model.stack.breaks[j : j + 2].tolist()
        height = float(
            np.clip(model.stack.breaks[k], low + INSIDE * (high - low), high - INSIDE * (high - low))
        )
        wall = model.stack.runs[j].walls[0]
        end = _square_and_round(section_boundary(wall, height, RING).points[:, :2])
        if end is None:
            return ()
        ends.append(end)
    if any(circle.area < FILLED * rectangle.area for rectangle, circle in ends):
        return ()
    (low_square, low_round), (high_square, high_round) = ends
    low, high = float(model.stack.breaks[runs.start]), float(model.stack.breaks[runs.stop])
    return (
        Ruled(low_square, _turned(high_round, low_square), low, high),
        Ruled(_turned(low_round, high_square), high_square, low, high),
    )


def _square_and_round(points: Floats) -> tuple[Rectangle, DividedCircle] | None:
    spokes = points - points.mean(axis=0)
    ring = points[np.argsort(np.arctan2(spokes[:, 1], spokes[:, 0]))]
    if ring_area(ring) < TINY:
        return None
    circle = circle_of(ring)
    return rectangle_of(ring), DividedCircle(circle.centre, circle.radius, 0.0, 0.0)


def _turned(circle: DividedCircle, square: Rectangle) -> DividedCircle:
    """The circle with its cuts where the corners of a rectangle point, the first to the first."""
    lead = float(np.arctan2(square.height, square.width))
    vector = circle.vector
    vector[3:] = square.angle + np.pi / 4, lead - np.pi / 4
    return circle.moved(vector)
