"""Ellipse: the outline of oval things."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.outline import Boundary, Closed, Edge, Foot

__all__ = ["Ellipse"]

MAX_STEPS = 40
CONVERGED = 1e-13
"""Relative change of the Lagrange multiplier below which Newton's method has ended."""


@dataclass(frozen=True)
class Ellipse:
    """An ellipse.

    Parameters
    ----------
    centre : (2,) float array
    major, minor : float
        Semi-axes, positive; during a fit the major one may become the shorter.
    angle : float
        Of the major axis from x, in radians.
    """

    kind: ClassVar[str] = "ellipse"

    centre: Floats
    major: float
    minor: float
    angle: float

    @property
    def vector(self) -> Floats:
        """Centre, semi-axes, angle: (5,)."""
        return np.array([*self.centre, self.major, self.minor, self.angle])

    def moved(self, vector: Floats) -> Self:
        """Return the ellipse with other parameters; of the semi-axes the size counts."""
        return type(self)(vector[:2].copy(), abs(float(vector[2])), abs(float(vector[3])), float(vector[4]))

    @property
    def area(self) -> float:
        """Enclosed area."""
        return float(np.pi * self.major * self.minor)

    def foot(self, points: Floats) -> Foot:
        """Signed distance of points (n, 2), and its derivatives."""
        a, b = self.major, self.minor
        turn = self._turn
        x, y = ((points - self.centre) @ turn).T
        cos, sin = _foot_direction(np.abs(x), np.abs(y), a, b)
        cos, sin = np.copysign(cos, x), np.copysign(sin, y)
        steep = np.hypot(b * cos, a * sin)
        nx, ny = b * cos / steep, a * sin / steep
        at_x, at_y = a * cos, b * sin
        normal = (turn @ np.array([nx, ny])).T

        def slopes() -> Floats:
            return np.vstack([-normal.T, -nx * cos, -ny * sin, nx * at_y - ny * at_x]).T

        return Foot((x - at_x) * nx + (y - at_y) * ny, normal, slopes, a * b / steep**3)

    def boundary(self, count: int) -> Boundary:
        """`count` points along it, evenly spaced in the eccentric angle."""
        a, b = self.major, self.minor
        angle = 2 * np.pi * (np.arange(count) + 0.5) / count
        cos, sin = np.cos(angle), np.sin(angle)
        speed = np.hypot(a * sin, b * cos)
        points = self.centre + np.column_stack([a * cos, b * sin]) @ self._turn.T
        normals = np.column_stack([b * cos, a * sin]) / speed[:, None] @ self._turn.T
        return Boundary(points, normals, speed * 2 * np.pi / count)

    def edges(self) -> tuple[Edge, ...]:
        """Return the ellipse as one closed edge."""
        long, short = max(self.major, self.minor), min(self.major, self.minor)
        direction = self._turn[:, 0 if self.major >= self.minor else 1]
        return (Closed("ellipse", np.array([self.centre, [long, short], direction])),)

    @property
    def _turn(self) -> Floats:
        """Rotation (2, 2) from the frame of the axes."""
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return np.array([[cos, -sin], [sin, cos]])


def _foot_direction(x: Floats, y: Floats, a: float, b: float) -> tuple[Floats, Floats]:
    """Cosine and sine of the eccentric angle at the foot of points of the first quadrant.

    Notes
    -----
    The foot of (x, y) is (a**2 x / (t + a**2), b**2 y / (t + b**2)) for the greatest root t of the secular
    equation that puts it on the ellipse. In the form 1 / norm = 1 the equation is concave, so that Newton's
    method rises to the root from below.

    References
    ----------
    D. Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid", 2013.
    J. J. Moré, D. C. Sorensen, "Computing a trust region step", SIAM J. Sci. Stat. Comput. 4, 1983.
    """
    if a < b:
        sin, cos = _foot_direction(y, x, b, a)
        return cos, sin
    # With d = t + b**2, nothing cancels near the major axis; a point on it is taken for one just above.
    u, v = a * x, b * np.maximum(y, 1e-15 * a)
    squares = (a - b) * (a + b)
    d = np.maximum(v, u - squares)
    for _ in range(MAX_STEPS):
        p, q = u / (d + squares), v / d
        square = p * p + q * q
        norm = np.sqrt(square)
        step = (norm - 1) * square / (p * p / (d + squares) + q * q / d)
        d = d + step
        if np.all(np.abs(step) <= CONVERGED * d):
            break
    p, q = u / (d + squares), v / d
    norm = np.hypot(p, q)
    return p / norm, q / norm
