"""Circle: the outline of round things."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.outline import Boundary, Closed, Edge, Foot

__all__ = ["Circle"]


@dataclass(frozen=True)
class Circle:
    """A circle.

    Parameters
    ----------
    centre : (2,) float array
    radius : float
        Positive.
    """

    kind: ClassVar[str] = "circle"

    centre: Floats
    radius: float

    @property
    def vector(self) -> Floats:
        """Centre, radius: (3,)."""
        return np.array([*self.centre, self.radius])

    def moved(self, vector: Floats) -> Self:
        """Return the circle with other parameters; of the radius the size counts."""
        return type(self)(vector[:2].copy(), abs(float(vector[2])))

    @property
    def area(self) -> float:
        """Enclosed area."""
        return float(np.pi * self.radius**2)

    def foot(self, points: Floats) -> Foot:
        """Signed distance of points (n, 2), and its derivatives."""
        x, y = (points - self.centre).T
        far = np.hypot(x, y)
        at_centre = far == 0
        scale = np.where(at_centre, 1.0, far)
        normal = np.array([np.where(at_centre, 1.0, x / scale), y / scale]).T

        def slopes() -> Floats:
            return np.vstack([-normal.T, np.full(len(far), -1.0)]).T

        return Foot(far - self.radius, normal, slopes, np.full(len(far), 1 / self.radius))

    def boundary(self, count: int) -> Boundary:
        """`count` points along it, evenly spaced."""
        angle = 2 * np.pi * (np.arange(count) + 0.5) / count
        normals = np.column_stack([np.cos(angle), np.sin(angle)])
        lengths = np.full(count, 2 * np.pi * self.radius / count)
        return Boundary(self.centre + self.radius * normals, normals, lengths)

    def edges(self) -> tuple[Edge, ...]:
        """Return the circle as one closed edge."""
        return (Closed("circle", np.array([self.centre, [self.radius, self.radius]])),)
