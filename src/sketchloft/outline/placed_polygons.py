"""Polygons of a given form that have a centre, sizes and an angle: rectangles and regular polygons."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain_outline import ChainOutline

__all__ = ["Rectangle", "RegularPolygon", "RoundedRectangle", "moves_of", "placed"]

QUARTERS = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) / 2
"""Corners of a square of side 1, counter-clockwise."""
FILLETS = np.array([[[0, -1], [-1, 0]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[-1, 0], [0, 1]]], dtype=float)
"""Ends of each corner's fillet of radius 1, from the corner."""
QUARTER_ARC = float(np.tan(np.pi / 8))
"""Bulge of a quarter of a circle."""


@dataclass(frozen=True)
class Rectangle(ChainOutline):
    """A rectangle.

    Parameters
    ----------
    centre : (2,) float array
    width, height : float
        Full lengths of the sides, positive.
    angle : float
        Of the width from x, in radians.
    """

    kind: ClassVar[str] = "rectangle"

    centre: Floats
    width: float
    height: float
    angle: float

    @property
    def vector(self) -> Floats:
        """Centre, width, height, angle: (5,)."""
        return np.array([*self.centre, self.width, self.height, self.angle])

    def moved(self, vector: Floats) -> Self:
        """Return the rectangle with other parameters; of the sides the size counts."""
        width, height, angle = vector[2:].tolist()
        return replace(self, centre=vector[:2].copy(), width=abs(width), height=abs(height), angle=angle)

    def chain(self) -> tuple[Floats, Floats]:
        """Corners, and bulges of 0."""
        return placed(self.centre, self.angle, self._local), np.zeros(4)

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the corners."""
        return gradient[:, :8] @ moves_of(self.angle, self._local, QUARTERS * [1, 0], QUARTERS * [0, 1])

    @property
    def _local(self) -> Floats:
        return QUARTERS * [self.width, self.height]


@dataclass(frozen=True)
class RoundedRectangle(ChainOutline):
    """A rectangle with the same fillet at each corner; a stadium when they take up the short sides.

    Parameters
    ----------
    centre : (2,) float array
    width, height : float
        Full lengths of the sides, positive.
    angle : float
        Of the width from x, in radians.
    radius : float
        Of the fillets; taken down to half the short side where it is larger.
    """

    kind: ClassVar[str] = "rounded rectangle"

    centre: Floats
    width: float
    height: float
    angle: float
    radius: float

    @property
    def vector(self) -> Floats:
        """Centre, width, height, angle, radius: (6,)."""
        return np.array([*self.centre, self.width, self.height, self.angle, self.radius])

    def moved(self, vector: Floats) -> Self:
        """Return the rectangle with other parameters, the radius within what fits."""
        width, height, angle, radius = vector[2:].tolist()
        width, height = abs(width), abs(height)
        return replace(
            self,
            centre=vector[:2].copy(),
            width=width,
            height=height,
            angle=angle,
            radius=_fitting(width, height, radius),
        )

    def chain(self) -> tuple[Floats, Floats]:
        """Ends of the fillets, and their bulges between lines."""
        return placed(self.centre, self.angle, self._local), np.tile([QUARTER_ARC, 0.0], 4)

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the fillets' ends, at a fixed radius by the sides."""
        corners = np.repeat(QUARTERS, 2, axis=0)
        moves = moves_of(self.angle, self._local, corners * [1, 0], corners * [0, 1], FILLETS.reshape(-1, 2))
        return gradient[:, :16] @ moves[:, [0, 1, 2, 3, 5, 4]]

    @property
    def _local(self) -> Floats:
        corners = QUARTERS[:, None] * [self.width, self.height]
        return (corners + _fitting(self.width, self.height, self.radius) * FILLETS).reshape(-1, 2)


@dataclass(frozen=True)
class RegularPolygon(ChainOutline):
    """A polygon with equal sides and angles.

    Parameters
    ----------
    centre : (2,) float array
    radius : float
        From the centre to the vertices, positive.
    angle : float
        Of the first vertex from x, in radians.
    sides : int
        How many; fixed.
    """

    kind: ClassVar[str] = "regular polygon"

    centre: Floats
    radius: float
    angle: float
    sides: int

    @property
    def vector(self) -> Floats:
        """Centre, radius, angle: (4,)."""
        return np.array([*self.centre, self.radius, self.angle])

    def moved(self, vector: Floats) -> Self:
        """Return the polygon with other parameters; of the radius the size counts."""
        return replace(self, centre=vector[:2].copy(), radius=abs(float(vector[2])), angle=float(vector[3]))

    def chain(self) -> tuple[Floats, Floats]:
        """Vertices, and bulges of 0."""
        return placed(self.centre, self.angle, self.radius * self._spokes), np.zeros(self.sides)

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the vertices."""
        moves = moves_of(self.angle, self.radius * self._spokes, self._spokes)
        return gradient[:, : 2 * self.sides] @ moves

    @property
    def _spokes(self) -> Floats:
        turn = 2 * np.pi * np.arange(self.sides) / self.sides
        return np.column_stack([np.cos(turn), np.sin(turn)])


def _fitting(width: float, height: float, radius: float) -> float:
    return min(max(radius, 0.0), min(width, height) / 2)


def _rotation(angle: float) -> Floats:
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, -sin], [sin, cos]])


def placed(centre: Floats, angle: float, local: Floats) -> Floats:
    """Vertices (m, 2) about the origin, turned by an angle and moved to a centre."""
    return centre + local @ _rotation(angle).T


def moves_of(angle: float, local: Floats, *by_size: Floats) -> Floats:
    """(2m, p) derivative of placed vertices (m, 2) by centre, sizes and angle.

    Parameters
    ----------
    angle : float
    local : (m, 2) float array
        Vertices about the origin.
    *by_size : (m, 2) float arrays
        Their derivatives by each size.
    """
    turn = _rotation(angle).T
    quarter = np.column_stack([-local[:, 1], local[:, 0]])
    columns = [np.broadcast_to(axis, local.shape) for axis in np.eye(2)]
    columns += [by @ turn for by in (*by_size, quarter)]
    return np.stack(columns, axis=2).reshape(-1, len(columns))
