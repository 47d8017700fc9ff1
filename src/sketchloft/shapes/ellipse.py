"""Ellipse: least-squares fit to edge points (paper, section 4.7)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.shapes.circle import fit_circle

__all__ = ["Ellipse", "fit_ellipse"]


@dataclass(frozen=True)
class Ellipse:
    """An ellipse in a slice plane.

    Parameters
    ----------
    centre : (2,) float array
    semi_axes : (2,) float array
        The longer one first.
    angle : float
        Of the longer axis against x, in radians, in [0, pi).
    """

    kind: ClassVar[str] = "ellipse"
    parameters: ClassVar[int] = 5
    corners: ClassVar[int] = 0

    centre: Floats
    semi_axes: Floats
    angle: float

    @property
    def axes(self) -> Floats:
        """(2, 2) unit vectors of the longer and the shorter axis, in rows."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        return np.array([[c, s], [-s, c]])

    def evaluate(self, t: Floats) -> Floats:
        """Points (m, 2) at parameters t, once around counter-clockwise for t from 0 to 1."""
        angle = 2 * np.pi * t
        return self.centre + (self.semi_axes * np.stack([np.cos(angle), np.sin(angle)], axis=-1)) @ self.axes

    def distance(self, points: Floats) -> Floats:
        """Signed distance (m,) of points (m, 2), positive outside."""
        local = (points - self.centre) @ self.axes.T
        foot, normal = _feet(local, self.semi_axes)
        return np.einsum("ij,ij->i", local - foot, normal)

    def grown(self, offset: float) -> Ellipse:
        """The ellipse with both semi-axes longer by an offset."""
        return replace(self, semi_axes=self.semi_axes + offset)


def fit_ellipse(points: Floats) -> Ellipse:
    """Ellipse with the least sum of squared distances to the points.

    Parameters
    ----------
    points : (m, 2) float array

    Returns
    -------
    Ellipse

    Notes
    -----
    Gauss-Newton steps on the orthogonal distance, from the circle stretched to the points' second
    moments.

    References
    ----------
    S. J. Ahn, W. Rauh, H.-J. Warnecke, Least-squares orthogonal distances fitting of circle, sphere,
    ellipse, hyperbola, and parabola, Pattern Recognition 34, 2001.
    """
    circle = fit_circle(points)
    local = points - points.mean(axis=0)
    values, vectors = np.linalg.eigh(local.T @ local)
    stretch = np.sqrt(np.maximum(values[::-1], 1e-12 * values.max()) / values.mean())
    semi, centre = circle.radius * stretch, points.mean(axis=0)
    angle = float(np.arctan2(vectors[1, 1], vectors[0, 1]))
    for _ in range(15):
        found = Ellipse(centre, semi, angle)
        rotated = (points - centre) @ found.axes.T
        foot, normal = _feet(rotated, semi)
        residual = np.einsum("ij,ij->i", rotated - foot, normal)
        # How far the foot moves along its normal: with the centre, with each axis, with the angle.
        turning = foot[:, 0] * normal[:, 1] - foot[:, 1] * normal[:, 0]
        design = np.c_[normal, normal * foot / semi, turning]
        step = np.linalg.lstsq(design, residual, rcond=1e-10)[0]
        centre = centre + step[:2] @ found.axes
        semi = np.maximum(semi + step[2:4], 0.2 * semi)
        angle += float(np.clip(step[4], -0.3, 0.3))
        if np.abs(step[:4]).max() < 1e-9 * semi.max():
            break
    if semi[1] > semi[0]:
        semi, angle = semi[::-1], angle + np.pi / 2
    return Ellipse(centre, semi, angle % np.pi)


def _feet(local: Floats, semi: Floats) -> tuple[Floats, Floats]:
    """Nearest points (m, 2) of the ellipse and outward normals there, by Newton's method on the angle."""
    a, b = semi
    x, y = np.abs(local).T
    t = np.arctan2(a * y, b * x)
    for _ in range(8):
        c, s = np.cos(t), np.sin(t)
        slope = (a * a - b * b) * c * s - a * x * s + b * y * c
        curve = (a * a - b * b) * (c * c - s * s) - a * x * c - b * y * s
        t = np.clip(t - slope / np.where(np.abs(curve) > 1e-300, curve, 1.0), 0.0, np.pi / 2)
    sign = np.where(local < 0, -1.0, 1.0)
    foot = sign * np.stack([a * np.cos(t), b * np.sin(t)], axis=-1)
    normal = foot / np.square(semi)
    return foot, normal / np.linalg.norm(normal, axis=1, keepdims=True)
