"""Stadium: a slot, two half circles joined by lines."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle, moves_of, placed

__all__ = ["Stadium", "stadium_like"]

ENDS = np.array([[-1, 0], [1, 0], [1, 0], [-1, 0]]) / 2
"""Of the lines, along them, in the distance of the arcs' centres."""
SIDES = np.array([[0, -1], [0, -1], [0, 1], [0, 1]], dtype=float)
"""The same across, in the radius."""
LEAST = 0.05
"""Distance of the arcs' centres at least, in the width."""
BULGES = np.array([0.0, 1.0, 0.0, 1.0])


@dataclass(frozen=True)
class Stadium(ChainOutline):
    """What is within a radius of a straight line.

    Parameters
    ----------
    centre : (2,) float array
    length : float
        Of the line, from the centre of one arc to that of the other, positive.
    radius : float
        Of the arcs, half the width, positive.
    angle : float
        Of the line from x, in radians.
    """

    kind: ClassVar[str] = "stadium"

    centre: Floats
    length: float
    radius: float
    angle: float

    @property
    def vector(self) -> Floats:
        """Centre, length, radius, angle: (5,)."""
        return np.array([*self.centre, self.length, self.radius, self.angle])

    def moved(self, vector: Floats) -> Self:
        """Return the stadium with other parameters; of length and radius the sizes count."""
        length, radius, angle = vector[2:].tolist()
        return replace(self, centre=vector[:2].copy(), length=abs(length), radius=abs(radius), angle=angle)

    @property
    def rounded(self) -> RoundedRectangle:
        """The rounded rectangle that it is."""
        width = 2 * self.radius
        return RoundedRectangle(self.centre, self.length + width, width, self.angle, self.radius)

    def chain(self) -> tuple[Floats, Floats]:
        """Ends of the lines, and the bulges of half circles between them."""
        return placed(self.centre, self.angle, self.length * ENDS + self.radius * SIDES), BULGES

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the lines' ends."""
        local = self.length * ENDS + self.radius * SIDES
        return gradient[:, :8] @ moves_of(self.angle, local, ENDS, SIDES)


def stadium_like(outline: Rectangle | RoundedRectangle) -> Stadium:
    """Stadium as long and as wide as a rectangle, or hardly longer than wide in the place of a square."""
    long, short = max(outline.width, outline.height), min(outline.width, outline.height)
    upright = outline.height > outline.width
    return Stadium(
        outline.centre, max(long - short, LEAST * short), short / 2, outline.angle + upright * np.pi / 2
    )
