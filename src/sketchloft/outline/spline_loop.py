"""SplineLoop: a free outline, a closed cubic spline."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.gauss import gauss
from sketchloft.outline.chain import outward
from sketchloft.outline.outline import Boundary, Closed, Edge, Foot
from sketchloft.periodic_cubic import basis_at, curve_at, locate, pieces

__all__ = ["SplineLoop", "spline_loop"]

PER_POLE = 10
"""Samples per pole, from which the foot of a point is searched."""
NEWTON = 3
BLOCK = 65_536
"""Pairs of a point and a sample that are worked on at once; so few that they stay in the cache."""


@dataclass(frozen=True)
class SplineLoop:
    """A periodic cubic B-spline with evenly spaced knots, as `sketchloft.shapes.spline.ClosedSpline`.

    Parameters
    ----------
    poles : (k, 2) float array
        Control points, counter-clockwise, none repeated, k at least 4.
    base, normals : (k, 2) float array
        Each pole moves from its base along its unit normal, so that none slides along the curve.
    """

    kind: ClassVar[str] = "spline"

    poles: Floats
    base: Floats = field(repr=False)
    normals: Floats = field(repr=False)

    @property
    def vector(self) -> Floats:
        """Displacement (k,) of each pole from its base."""
        return np.einsum("ij,ij->i", self.poles - self.base, self.normals)

    def moved(self, vector: Floats) -> Self:
        """Return the spline with other displacements."""
        return replace(self, poles=self.base + vector[:, None] * self.normals)

    @property
    def area(self) -> float:
        """Enclosed area."""
        points, along, weights = self._quadrature(3)  # exact for the integrand's degree of 5
        cross = points[:, 0] * along[:, 1] - points[:, 1] * along[:, 0]
        return abs(float(cross @ weights)) / 2

    def foot(self, points: Floats) -> Foot:
        """Signed distance of points (n, 2), and its derivatives; by Newton's method from a near sample."""
        count = len(self.poles)
        coefficients = pieces(self.poles)
        target = np.ascontiguousarray(points.T)
        span, t = locate(_improved(coefficients, target, self._nearest(points)), count)
        at, d1, d2 = curve_at(coefficients, span, t)
        speed = np.maximum(np.hypot(*d1), 1e-300)
        across = np.stack([d1[1], -d1[0]]) / speed
        # At the foot the gap is along the normal; elsewhere, next to the medial axis, nearly.
        gap = target - at
        distance = np.copysign(np.hypot(*gap), gap[0] * across[0] + gap[1] * across[1])
        curvature = (d1[0] * d2[1] - d1[1] * d2[0]) / speed**3

        def slopes() -> Floats:
            columns, values = basis_at(span, t, count)
            gradient = np.zeros((len(points), count))
            np.put_along_axis(gradient, columns, -values, axis=1)
            gradient *= (self.normals @ across).T
            return gradient

        return Foot(distance, np.ascontiguousarray(across.T), slopes, curvature)

    def _nearest(self, points: Floats) -> Floats:
        """Parameter (n,) of the sample nearest to each point."""
        count = PER_POLE * len(self.poles)
        u = np.arange(count) / count
        samples, _, _ = curve_at(pieces(self.poles), *locate(u, len(self.poles)))
        origin = samples.mean(axis=1)
        # Single precision tells samples apart, in half the time.
        local = (samples - origin[:, None]).astype(np.float32)
        seen = (points - origin).astype(np.float32)
        squares = np.square(local).sum(axis=0) / 2
        rows = max(1, BLOCK // count)
        starts = range(0, len(points), rows)
        best = [np.argmin(squares - seen[i : i + rows] @ local, axis=1) for i in starts]
        return u[np.concatenate(best)] if best else np.zeros(0)

    def boundary(self, count: int) -> Boundary:
        """About `count` Gauss points along it, 2 or more on each span."""
        points, along, weights = self._quadrature(max(2, round(count / len(self.poles))))
        speed = np.hypot(along[:, 0], along[:, 1])
        return Boundary(points, outward(along) / speed[:, None], weights * speed)

    def edges(self) -> tuple[Edge, ...]:
        """Return the spline as one closed edge."""
        return (Closed("spline", self.poles),)

    def _quadrature(self, per_span: int) -> tuple[Floats, Floats, Floats]:
        """Points, derivatives by the place within the span, and weights, of Gauss' rule on each span."""
        count = len(self.poles)
        nodes, weights = gauss(per_span)
        span = np.repeat(np.arange(count), per_span)
        at, along, _ = curve_at(pieces(self.poles), span, np.tile((nodes + 1) / 2, count))
        return at.T, along.T, np.tile(weights / 2, count)


def spline_loop(poles: Floats) -> SplineLoop:
    """Make a spline of poles (k, 2), counter-clockwise, that move across their control polygon."""
    across = outward(np.roll(poles, -1, axis=0) - np.roll(poles, 1, axis=0))
    size = np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    return SplineLoop(poles, poles, across / size)


def _improved(coefficients: Floats, target: Floats, u: Floats) -> Floats:
    """Parameters (n,) moved towards the feet of points (2, n) by some steps of Newton's method."""
    count = coefficients.shape[2]
    for _ in range(NEWTON):
        at, d1, d2 = curve_at(coefficients, *locate(u, count))
        gap = at - target
        slope = gap[0] * d1[0] + gap[1] * d1[1]
        speed2 = d1[0] * d1[0] + d1[1] * d1[1]
        bend = speed2 + gap[0] * d2[0] + gap[1] * d2[1]
        # Near the centre of curvature the full second derivative is no guide.
        step = slope / np.maximum(np.where(bend > 0.2 * speed2, bend, speed2), 1e-300)
        u = u - np.clip(step, -1 / PER_POLE, 1 / PER_POLE) / count
    return u
