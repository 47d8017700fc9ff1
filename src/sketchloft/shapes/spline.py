"""Closed spline: the shape of a section that is no known curve (paper, section 4.7)."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.periodic_cubic import basis_at, locate
from sketchloft.ring import ring_depth

__all__ = ["ClosedSpline", "fit_spline", "periodic_basis", "resampled"]


@dataclass(frozen=True)
class ClosedSpline:
    """A periodic cubic B-spline with evenly spaced knots.

    Parameters
    ----------
    poles : (k, 2) float array
        Control points, counter-clockwise, none repeated.
    """

    kind: ClassVar[str] = "spline"
    corners: ClassVar[int] = 0

    poles: Floats

    @property
    def parameters(self) -> int:
        """Number of free parameters: a point of a curve is free only across it."""
        return len(self.poles)

    def evaluate(self, t: Floats) -> Floats:
        """Points (m, 2) at parameters t, once around counter-clockwise for t from 0 to 1."""
        return periodic_basis(t, len(self.poles)) @ self.poles

    def distance(self, points: Floats) -> Floats:
        """Signed distance (m,) of points (m, 2) from a fine polyline of it, positive outside."""
        ring = self.evaluate(np.arange(8 * len(self.poles)) / (8 * len(self.poles)))
        return -ring_depth(points, ring)

    def grown(self, offset: float) -> ClosedSpline:
        """The spline moved outwards along its normals by an offset."""
        k = len(self.poles)
        t = np.arange(4 * k) / (4 * k)
        at = self.evaluate(t)
        along = np.roll(at, -1, axis=0) - np.roll(at, 1, axis=0)
        across = np.stack([along[:, 1], -along[:, 0]], axis=1)
        normal = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
        return _least_squares(at + offset * normal, k)


def fit_spline(points: Floats, count: int) -> ClosedSpline:
    """Closed spline with the least mean squared distance from the ring through the points.

    Parameters
    ----------
    points : (m, 2) float array
        Ordered around, counter-clockwise.
    count : int
        Number of control points.

    Returns
    -------
    ClosedSpline
        Parametrised by arc length from the first point.
    """
    samples = max(8 * count, 128)
    return _least_squares(resampled(points, samples), count)


def resampled(ring: Floats, count: int) -> Floats:
    """Points (count, 2), evenly spaced along a closed ring of points (m, 2), from its first point on."""
    closed = np.r_[ring, ring[:1]]
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))]
    at = np.arange(count) / count * length[-1]
    return np.stack([np.interp(at, length, closed[:, i]) for i in range(2)], axis=1)


def _least_squares(points: Floats, count: int) -> ClosedSpline:
    """Spline nearest to points that are evenly spaced in the parameter."""
    return ClosedSpline(_projection(len(points), count) @ points)


@functools.lru_cache(maxsize=64)
def _projection(samples: int, count: int) -> Floats:
    """(count, samples) matrix that takes evenly spaced samples to the poles nearest to them."""
    basis = periodic_basis(np.arange(samples) / samples, count)
    return np.asarray(np.linalg.solve(basis.T @ basis, basis.T), dtype=np.float64)


def periodic_basis(t: Floats, count: int) -> Floats:
    """(m, count) values of the periodic basis functions; function 0 is the one that starts at t = 0."""
    columns, values = basis_at(*locate(t, count), count)
    basis = np.zeros((len(t), count))
    np.put_along_axis(basis, columns, values, axis=1)
    return basis
