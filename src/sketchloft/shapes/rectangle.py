"""Rectangle, at any turn in the plane: least-squares fit to edge points (paper, section 4.7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["Rectangle", "fit_rectangle"]

TURNS = 15
"""First guesses of the angle within a quarter turn; the best few of them are refined."""


@dataclass(frozen=True)
class Rectangle:
    """A rectangle in a slice plane.

    Parameters
    ----------
    centre : (2,) float array
    half_sides : (2,) float array
        The longer one first.
    angle : float
        Of the longer side against x, in radians, in [0, pi).
    """

    kind: ClassVar[str] = "rectangle"
    parameters: ClassVar[int] = 5
    corners: ClassVar[int] = 4

    centre: Floats
    half_sides: Floats
    angle: float

    @property
    def axes(self) -> Floats:
        """(2, 2) unit vectors along the longer and the shorter side, in rows."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        return np.array([[c, s], [-s, c]])

    def evaluate(self, t: Floats) -> Floats:
        """Points (m, 2), once around counter-clockwise for t from 0 to 1, a corner at every quarter."""
        corners = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
        place = np.mod(t, 1.0) * 4
        side = np.minimum(place.astype(np.intp), 3)
        along = (place - side)[:, None]
        local = (1 - along) * corners[side] + along * corners[side + 1]
        return self.centre + (self.half_sides * local) @ self.axes

    def distance(self, points: Floats) -> Floats:
        """Signed distance (m,) of points (m, 2), positive outside."""
        beyond = np.abs((points - self.centre) @ self.axes.T) - self.half_sides
        outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
        return np.where(outside > 0, outside, beyond.max(axis=1))

    def grown(self, offset: float) -> Rectangle:
        """The rectangle with all sides moved outwards by an offset."""
        return replace(self, half_sides=self.half_sides + offset)


def fit_rectangle(points: Floats) -> Rectangle:
    """Rectangle with the least sum of squared distances of the points from its sides.

    Parameters
    ----------
    points : (m, 2) float array

    Returns
    -------
    Rectangle

    Notes
    -----
    From the bounding rectangle at several angles, every point is given to the side nearest to it and
    the four sides are fitted together, until no point changes its side; the best result is kept.
    """
    guesses = sorted((_bounding(points, np.pi / 2 * k / TURNS) for k in range(TURNS)), key=_error(points))
    best = min((_refined(points, guess) for guess in guesses[:3]), key=_error(points))
    half, angle = best.half_sides, best.angle
    if half[1] > half[0]:
        half, angle = half[::-1], angle + np.pi / 2
    return Rectangle(best.centre, half, angle % np.pi)


def _error(points: Floats) -> Callable[[Rectangle], float]:
    return lambda rectangle: float(np.square(rectangle.distance(points)).sum())


def _bounding(points: Floats, angle: float) -> Rectangle:
    axes = Rectangle(np.zeros(2), np.zeros(2), angle).axes
    local = points @ axes.T
    low, high = local.min(axis=0), local.max(axis=0)
    return Rectangle((low + high) / 2 @ axes, (high - low) / 2, angle)


def _refined(points: Floats, found: Rectangle) -> Rectangle:
    for _ in range(12):
        local = (points - found.centre) @ found.axes.T
        beyond = np.abs(local) - found.half_sides
        rows, side = np.arange(len(points)), np.argmax(beyond, axis=1)
        sign = np.where(local[rows, side] < 0, -1.0, 1.0)
        # Columns: the centre along both axes, both half sides, the angle.
        design = np.zeros((len(points), 5))
        design[rows, side] = sign
        design[rows, 2 + side] = 1.0
        design[:, 4] = sign * np.where(side == 0, -local[:, 1], local[:, 0])
        step = np.linalg.lstsq(design, beyond[rows, side], rcond=1e-10)[0]
        half = np.maximum(found.half_sides + step[2:4], 0.2 * found.half_sides)
        turn = float(np.clip(step[4], -0.1, 0.1))
        found = Rectangle(found.centre + step[:2] @ found.axes, half, found.angle + turn)
        if np.abs(step).max() < 1e-12 * half.max():
            break
    return found
