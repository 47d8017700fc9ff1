"""Circle: least-squares fit to edge points (paper, section 4.7)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["Circle", "algebraic_centre", "fit_circle"]


@dataclass(frozen=True)
class Circle:
    """A circle in a slice plane.

    Parameters
    ----------
    centre : (2,) float array
    radius : float
    """

    kind: ClassVar[str] = "circle"
    parameters: ClassVar[int] = 3
    corners: ClassVar[int] = 0

    centre: Floats
    radius: float

    def evaluate(self, t: Floats) -> Floats:
        """Points (m, 2) at parameters t, once around counter-clockwise for t from 0 to 1."""
        angle = 2 * np.pi * t
        return self.centre + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    def distance(self, points: Floats) -> Floats:
        """Signed distance (m,) of points (m, 2), positive outside."""
        return np.linalg.norm(points - self.centre, axis=1) - self.radius

    def grown(self, offset: float) -> Circle:
        """The circle moved outwards by an offset."""
        return replace(self, radius=self.radius + offset)


def fit_circle(points: Floats) -> Circle:
    """Circle with the least sum of squared distances to the points.

    Parameters
    ----------
    points : (m, 2) float array

    Returns
    -------
    Circle

    Notes
    -----
    Starts from Kåsa's algebraic fit and takes Gauss-Newton steps on the geometric distance.

    References
    ----------
    W. Gander, G. H. Golub, R. Strebel, Least-squares fitting of circles and ellipses, BIT 34, 1994.
    """
    middle = points.mean(axis=0)
    local = points - middle
    centre, radius = _algebraic(local)
    for _ in range(20):
        outwards = local - centre
        reach = np.linalg.norm(outwards, axis=1)
        normal = outwards / np.maximum(reach, 1e-300)[:, None]
        step = np.linalg.lstsq(np.c_[normal, np.ones(len(local))], reach - radius, rcond=None)[0]
        centre, radius = centre + step[:2], radius + float(step[2])
        if np.abs(step).max() < 1e-12 * radius:
            break
    return Circle(middle + centre, radius)


def algebraic_centre(points: Floats) -> Floats:
    """Centre (2,) of the circle with the least algebraic error (Kåsa 1976) for points (m, 2)."""
    middle = points.mean(axis=0)
    return middle + _algebraic(points - middle)[0]


def _algebraic(local: Floats) -> tuple[Floats, float]:
    """Kåsa's centre and radius for points about their mean."""
    design = np.c_[2 * local, np.ones(len(local))]
    x, y, c = np.linalg.lstsq(design, np.einsum("ij,ij->i", local, local), rcond=None)[0]
    return np.array([x, y]), float(np.sqrt(max(c + x * x + y * y, 0.0)))
