"""Ruled: a wall of straight lines between two chains of lines and arcs, edge to edge."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.gauss import gauss
from sketchloft.outline.chain import outward
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.chain_places import chain_movement, chain_place
from sketchloft.wall.foot import WallBoundary, WallFoot

__all__ = ["Ruled"]

SAMPLES = np.linspace(-0.9, 0.9, 8)
"""Parameters of an edge from which the foot of a point is searched."""
NEWTON = 4
BLOCK = 4096
LEVELS = gauss(4)
"""Heights of an integration over the wall; the area of a section is a parabola."""
FEWEST = 6
"""Points along an edge to integrate with."""
TINY = 1e-12


@dataclass(frozen=True)
class Ruled:
    """A wall whose section goes evenly from one outline to another, as from a square to a circle.

    Parameters
    ----------
    bottom, top : ChainOutline
        With as many edges. Points with the same parameter on edges of the same number are joined by a line.
    low, high : float
        Their heights, those of the breaks of the run; no parameters of the wall.
    """

    kind: ClassVar[str] = "ruled"

    bottom: ChainOutline
    top: ChainOutline
    low: float = 0.0
    high: float = 1.0

    @property
    def vector(self) -> Floats:
        """Parameters of both outlines."""
        return np.r_[self.bottom.vector, self.top.vector]

    def moved(self, vector: Floats) -> Self:
        """Return the wall with other parameters."""
        at = len(self.bottom.vector)
        return replace(self, bottom=self.bottom.moved(vector[:at]), top=self.top.moved(vector[at:]))

    def between(self, low: float, high: float) -> Self:
        """Return the wall with its outlines at other heights."""
        return replace(self, low=low, high=high)

    def share(self, heights: Floats) -> Floats:
        """How far heights are on the way from the bottom to the top."""
        return (heights - self.low) / (self.high - self.low)

    def ring(self, heights: Floats, tau: Floats, order: int = 0) -> Floats:
        """Points (h, m, k, 2) of all m edges at heights (h,) and parameters (k,), or derivatives by these."""
        edge = np.arange(len(self.bottom.chain()[1]))[:, None]
        below, above = (chain_place(end, edge, tau, order) for end in self._ends())
        t = self.share(heights)[:, None, None, None]
        return (1 - t) * below + t * above

    def tips(self) -> tuple[float, float]:
        """Heights between which it has a section, as far as it is used."""
        return self.low, self.high

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,)."""
        # Of two outlines and of the section half-way the areas give the parabola.
        middle = (self.low + self.high) / 2
        nodes, weights = gauss(16)
        at, along = (self.ring(np.array([middle]), nodes, order) for order in (0, 1))
        half = float(((at[..., 0] * along[..., 1] - at[..., 1] * along[..., 0]) @ weights).sum()) / 2
        t = self.share(heights)
        return (
            (1 - t) * (1 - 2 * t) * self.bottom.area
            + t * (2 * t - 1) * self.top.area
            + 4 * t * (1 - t) * half
        )

    def foot(self, points: Floats) -> WallFoot:
        """Signed distance of points (n, 3), and its derivatives."""
        t = self.share(points[:, 2])
        edge, tau = self._nearest(points)
        tau = self._closest(points, edge, tau)
        count = len(self.bottom.chain()[1])
        corner = np.flatnonzero(np.abs(tau) == 1.0)
        step = np.where(tau[corner] > 0, 1, -1)
        beside = (edge[corner] + step) % count
        there = self._closest(points[corner], beside, -tau[corner] * SAMPLES[-1])
        better = np.abs(there) < 1.0
        edge[corner[better]], tau[corner[better]] = beside[better], there[better]
        at, d1, d2 = (self._place(t, edge, tau, order) for order in range(3))
        speed = np.maximum(np.hypot(d1[:, 0], d1[:, 1]), TINY)
        across = outward(d1) / speed[:, None]
        gap = points[:, :2] - at
        flat = np.hypot(gap[:, 0], gap[:, 1])
        side = np.einsum("ij,ij->i", gap, across)
        bend = (d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]) / speed**3
        # At a corner the edge that a point is farther to the side of tells on which side of the wall it is.
        corner = np.flatnonzero((np.abs(tau) == 1.0) & (flat > TINY))
        step = np.where(tau[corner] > 0, 1, -1)
        other = outward(self._place(t[corner], (edge[corner] + step) % count, -tau[corner], 1))
        beyond = np.einsum("ij,ij->i", gap[corner], other) / np.maximum(np.hypot(*other.T), TINY)
        side[corner] = np.where(np.abs(beyond) > np.abs(side[corner]), beyond, side[corner])
        sign = np.where(side < 0, -1.0, 1.0)
        across[corner] = (sign[corner] / flat[corner])[:, None] * gap[corner]
        bend[corner] = 0.0
        below, above = self._ends()
        rise = (chain_place(above, edge, tau, 0) - chain_place(below, edge, tau, 0)) / (self.high - self.low)
        slope = -np.einsum("ij,ij->i", across, rise)
        c = 1 / np.hypot(1.0, slope)
        normal = np.column_stack([across, slope]) * c[:, None]
        by_ends = -normal[:, 2:] * np.column_stack([1 - t, t])

        def slopes() -> Floats:
            by_end = [
                end.by_vector((-c * part)[:, None] * chain_movement(end.chain(), edge, tau, across))
                for end, part in ((self.bottom, 1 - t), (self.top, t))
            ]
            return np.concatenate(by_end, axis=1)

        return WallFoot(c * sign * flat, normal, slopes, c * bend, by_ends)

    def _ends(self) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
        return self.bottom.chain(), self.top.chain()

    def _place(self, t: Floats, edge: Ints, tau: Floats, order: int) -> Floats:
        """Points (n, 2) on edges at parameters, each its own share of the way up, or derivatives by these."""
        below, above = (chain_place(end, edge, tau, order) for end in self._ends())
        return (1 - t)[:, None] * below + t[:, None] * above

    def _closest(self, points: Floats, edge: Ints, tau: Floats) -> Floats:
        """Parameters (n,) of the feet of points on given edges, from parameters near by."""
        t = self.share(points[:, 2])
        for _ in range(NEWTON):
            at, d1, d2 = (self._place(t, edge, tau, order) for order in range(3))
            gap = at - points[:, :2]
            first, second = np.einsum("ij,ij->i", gap, d1), np.einsum("ij,ij->i", d1, d1)
            full = second + np.einsum("ij,ij->i", gap, d2)
            step = first / np.maximum(np.where(full > 0.2 * second, full, second), TINY)
            tau = np.clip(tau - np.clip(step, -0.5, 0.5), -1.0, 1.0)
        return tau

    def _nearest(self, points: Floats) -> tuple[Ints, Floats]:
        """Edge (n,) and parameter of the sample nearest to each point in the section at its height."""
        below, above = (chain_place(end, np.arange(len(end[1]))[:, None], SAMPLES, 0) for end in self._ends())
        below, above = below.reshape(-1, 2), above.reshape(-1, 2)
        best = np.empty(len(points), dtype=np.intp)
        for start in range(0, len(points), BLOCK):
            part = points[start : start + BLOCK]
            t = self.share(part[:, 2])[:, None]
            x, y = ((1 - t) * below[:, axis] + t * above[:, axis] - part[:, axis, None] for axis in range(2))
            best[start : start + BLOCK] = np.argmin(x * x + y * y, axis=1)
        return best // len(SAMPLES), SAMPLES[best % len(SAMPLES)]

    def boundary(self, low: float, high: float, count: int) -> WallBoundary:
        """About `count` points on the wall between two heights."""
        x, w = LEVELS
        z, weights = (low + high) / 2 + (high - low) / 2 * x, w * (high - low) / 2
        edges = len(self.bottom.chain()[1])
        tau, share = gauss(max(FEWEST, count // (edges * len(z))))
        at, d1 = (self.ring(z, tau, order).reshape(len(z), -1, 2) for order in (0, 1))
        rise = (self.ring(np.array([self.high]), tau) - self.ring(np.array([self.low]), tau)).reshape(-1, 2)
        speed = np.maximum(np.hypot(d1[..., 0], d1[..., 1]), TINY)
        flat = outward(d1) / speed[..., None]
        slope = -np.einsum("mkd,kd->mk", flat, rise / (self.high - self.low))
        steep = np.hypot(1.0, slope)
        points = np.concatenate([at, np.broadcast_to(z[:, None, None], (*at.shape[:2], 1))], axis=2)
        normals = np.concatenate([flat, slope[..., None]], axis=2) / steep[..., None]
        areas = weights[:, None] * speed * np.tile(share, edges) * steep
        return WallBoundary(points.reshape(-1, 3), normals.reshape(-1, 3), areas.ravel())
