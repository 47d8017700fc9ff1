"""Lofted: a free wall, a tensor spline whose closed sections change along the axis."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.gauss import gauss
from sketchloft.periodic_cubic import basis_at, locate, pieces
from sketchloft.surface import basis_matrix, even_knots, local_bases
from sketchloft.wall.foot import WallBoundary, WallFoot, spread

__all__ = ["Lofted", "lofted"]

PER_POLE = 6
"""Samples of a section per pole, from which the foot of a point is searched."""
NEWTON = 3
BLOCK = 4096


@dataclass(frozen=True)
class Lofted:
    """A wall x, y = f(u, z), periodic cubic in u, clamped cubic in z.

    Parameters
    ----------
    poles : (nv, nu, 2) float array
    knots : (nv + 4,) float array
        Clamped knots, in heights, from break to break of the run.
    base, normals : (nv, nu, 2) float array
        Each pole moves from its base along its unit normal, so that none slides along the wall.
    """

    kind: ClassVar[str] = "loft"
    degree: ClassVar[int] = 3

    poles: Floats
    knots: Floats
    base: Floats = field(repr=False)
    normals: Floats = field(repr=False)

    @property
    def vector(self) -> Floats:
        """Displacement of each pole, row by row."""
        return np.einsum("ijk,ijk->ij", self.poles - self.base, self.normals).ravel()

    def moved(self, vector: Floats) -> Self:
        """Return the wall with other displacements."""
        shift = vector.reshape(self.base.shape[:2])
        return replace(self, poles=self.base + shift[..., None] * self.normals)

    def between(self, low: float, high: float) -> Self:
        """Return the wall stretched to other heights."""
        first, last = self.knots[0], self.knots[-1]
        if (first, last) == (low, high):
            return self
        knots = np.where(
            self.knots < last, low + (self.knots - first) * ((high - low) / (last - first)), high
        )
        return replace(self, knots=knots)

    def refined(self, around: int, spans: int) -> Lofted:
        """Return the wall with other numbers of poles around and of spans along, as near to it as can be."""
        knots = even_knots(float(self.knots[0]), float(self.knots[-1]), spans)
        heights = np.linspace(knots[0], knots[-1], 4 * (len(knots) - self.degree))
        u = np.arange(8 * around) / (8 * around)
        rings = self.ring(heights, u)
        along = np.linalg.pinv(basis_matrix(knots, self.degree, heights))
        across = np.linalg.pinv(_around(u, around, 0))
        return lofted(np.einsum("im,jk,mkd->ijd", along, across, rings), knots)

    def ring(self, heights: Floats, u: Floats, u_derivative: int = 0, z_derivative: int = 0) -> Floats:
        """Points (m, k, 2) at heights (m,) and parameters u (k,), or their derivatives."""
        along = basis_matrix(self.knots, self.degree, heights, z_derivative)
        around = _around(u, self.poles.shape[1], u_derivative)
        rows = (along @ self.poles.reshape(len(self.poles), -1)).reshape(len(along), *self.poles.shape[1:])
        return np.asarray(around @ rows)

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,)."""
        k = 8 * self.poles.shape[1]
        u = np.arange(k) / k
        at, along = self.ring(heights, u), self.ring(heights, u, 1)
        return (at[..., 0] * along[..., 1] - at[..., 1] * along[..., 0]).mean(axis=1) / 2

    def foot(self, points: Floats) -> WallFoot:
        """Signed distance of points (n, 3), and its derivatives."""
        z = np.clip(points[:, 2], self.knots[0], self.knots[-1])
        count = self.poles.shape[1]
        cells = np.stack([pieces(row) for row in self.poles]).transpose(0, 3, 1, 2).reshape(-1, count, 8)
        first, along, upwards = local_bases(self.knots, self.degree, z)
        rows = first[:, None] + np.arange(self.degree + 1)
        u = self._nearest(points[:, :2], z)
        for _ in range(NEWTON):
            at, d1, d2 = _curve(cells, rows, along, u)
            gap = at - points[:, :2]
            slide = np.einsum("ij,ij->i", gap, d1)
            second = np.einsum("ij,ij->i", d1, d1)
            full = second + np.einsum("ij,ij->i", gap, d2)
            u = u - np.clip(slide / np.where(full > 0.2 * second, full, second), -0.5 / count, 0.5 / count)
        at, d1, d2 = _curve(cells, rows, along, u)
        speed = np.maximum(np.hypot(d1[:, 0], d1[:, 1]), 1e-12)
        across = np.column_stack([d1[:, 1], -d1[:, 0]]) / speed[:, None]
        gap = points[:, :2] - at
        flat = np.hypot(gap[:, 0], gap[:, 1])
        side = np.sign(np.einsum("ij,ij->i", gap, across))
        steep = _curve(cells, rows, upwards, u)[0]
        slope = -np.einsum("ij,ij->i", across, steep)
        c = 1 / np.hypot(1.0, slope)
        bend = (d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]) / speed**3
        normal = np.column_stack([across, slope]) * c[:, None]
        share = (z - self.knots[0]) / (self.knots[-1] - self.knots[0])
        by_ends = -normal[:, 2:] * np.column_stack([1 - share, share])

        def slopes() -> Floats:
            return self._gradient(rows, along, u, across) * -c[:, None]

        return WallFoot(c * side * flat, normal, slopes, c * bend, by_ends)

    def _gradient(self, i: Ints, along: Floats, u: Floats, across: Floats) -> Floats:
        """Movement (n, p) of the wall across itself by each pole's displacement; 16 poles matter."""
        rows, count = self.poles.shape[:2]
        j, around = basis_at(*locate(u, count), count)
        lean = np.einsum("nijd,nd->nij", self.normals[i[:, :, None], j[:, None, :]], across)
        place = (i[:, :, None] * count + j[:, None, :]).reshape(len(u), -1)
        gradient = np.zeros((len(u), rows * count))
        values = (along[:, :, None] * around[:, None, :] * lean).reshape(len(u), -1)
        np.put_along_axis(gradient, place, values, axis=1)
        return gradient

    def _nearest(self, xy: Floats, z: Floats) -> Floats:
        """Parameter (n,) of the sample nearest to each point, on the section of a height close by."""
        count = PER_POLE * self.poles.shape[1]
        levels = 4 * (len(self.poles) - 3) + 1
        heights = np.linspace(self.knots[0], self.knots[-1], levels)
        level = np.rint((z - heights[0]) / (heights[-1] - heights[0]) * (levels - 1)).astype(np.intp)
        rings = self.ring(heights, np.arange(count) / count)
        best = np.empty(len(z), dtype=np.intp)
        for start in range(0, len(z), BLOCK):
            part = slice(start, start + BLOCK)
            x, y = (rings[level[part], :, axis] - xy[part, axis, None] for axis in range(2))
            best[part] = np.argmin(x * x + y * y, axis=1)
        return best / count

    def boundary(self, low: float, high: float, count: int) -> WallBoundary:
        """About `count` points on the wall between two heights."""
        inner = np.unique(np.clip(self.knots, low, high))
        x, w = gauss(4)
        z = ((inner[:-1, None] + inner[1:, None]) / 2 + np.diff(inner)[:, None] / 2 * x).ravel()
        weights = (np.diff(inner)[:, None] / 2 * w).ravel()
        around = max(4 * self.poles.shape[1], count // len(z))
        u = (np.arange(around) + 0.5) / around
        at, d1, dz = self.ring(z, u), self.ring(z, u, 1), self.ring(z, u, 0, 1)
        speed = np.maximum(np.linalg.norm(d1, axis=2), 1e-12)
        flat = np.stack([d1[..., 1], -d1[..., 0]], axis=2) / speed[..., None]
        slope = -np.einsum("mkd,mkd->mk", flat, dz)
        areas = weights[:, None] * speed / around * np.hypot(1.0, slope)
        return spread(at, z, flat, slope, areas)


def lofted(poles: Floats, knots: Floats) -> Lofted:
    """Make a wall of poles (nv, nu, 2), counter-clockwise around, and clamped knots along."""
    along = np.roll(poles, -1, axis=1) - np.roll(poles, 1, axis=1)
    across = np.stack([along[..., 1], -along[..., 0]], axis=2)
    normals = across / np.maximum(np.linalg.norm(across, axis=2, keepdims=True), 1e-12)
    return Lofted(poles, knots, poles, normals)


def _around(u: Floats, count: int, derivative: int) -> Floats:
    """Values (k, count) of all basis functions around at parameters u (k,), or their derivatives."""
    columns, values = basis_at(*locate(u, count), count, derivative)
    matrix = np.zeros((len(u), count))
    np.add.at(matrix, (np.arange(len(u))[:, None], columns), values)
    return matrix


def _curve(cells: Floats, rows: Ints, along: Floats, u: Floats) -> tuple[Floats, Floats, Floats]:
    """Points (n, 2), each on the ring at its own height, and their first and second derivatives by u."""
    count = cells.shape[1]
    span, t = locate(u, count)
    picked = (along[..., None] * cells[rows, span[:, None]]).sum(axis=1).reshape(-1, 4, 2)
    c0, c1, c2, c3 = picked.transpose(1, 0, 2)
    t = t[:, None]
    return (
        c0 + t * (c1 + t * (c2 + t * c3)),
        count * (c1 + t * (2 * c2 + 3 * t * c3)),
        count**2 * (2 * c2 + 6 * t * c3),
    )
