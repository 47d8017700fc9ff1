"""Ruled: a wall of straight lines between two chains of lines and arcs, edge to edge."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.gauss import gauss
from sketchloft.outline.chain import outward
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.chain_places import chain_movement, edges_at
from sketchloft.wall.foot import WallBoundary, WallFoot, spread

__all__ = ["Ruled"]

Places = tuple[Floats, Floats, Floats]
"""Points (2, n), and their first and second derivatives."""

SAMPLES = np.linspace(-0.9, 0.9, 8)
"""Parameters of an edge from which the foot of a point is searched."""
NEAR = float(SAMPLES[-2:].mean())
"""Parameter beyond which a foot is next to a corner."""
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
        return np.concatenate((self.bottom.vector, self.top.vector))

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
        below, above = (np.moveaxis(_along(end, tau)[order], 0, -1) for end in self._ends())
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
        x, y, z = points.T
        xy, t = np.array([x, y]), self.share(z)
        edge, tau = self._nearest(points)
        tau = self._closest(xy, t, edge, tau)
        count = len(self.bottom.chain()[1])
        # Next to a corner the nearest sample may be on the edge that is not nearest.
        near = np.flatnonzero(np.abs(tau) > NEAR)
        beside = (edge[near] + np.where(tau[near] > 0, 1, -1)) % count
        there = self._closest(xy[:, near], t[near], beside, -np.sign(tau[near]) * SAMPLES[-1])
        _, (here, _, _) = self._places(t[near], edge[near], tau[near])
        _, (other, _, _) = self._places(t[near], beside, there)
        better = np.hypot(*(other - xy[:, near])) < np.hypot(*(here - xy[:, near]))
        edge[near[better]], tau[near[better]] = beside[better], there[better]
        (below, above), (at, d1, d2) = self._places(t, edge, tau)
        speed = np.maximum(np.hypot(*d1), TINY)
        across = np.array([d1[1], -d1[0]]) / speed
        gap = xy - at
        flat = np.hypot(*gap)
        side = gap[0] * across[0] + gap[1] * across[1]
        bend = (d1[0] * d2[1] - d1[1] * d2[0]) / speed**3
        # At a corner the edge that a point is farther to the side of tells on which side of the wall it is.
        corner = np.flatnonzero((np.abs(tau) == 1.0) & (flat > TINY))
        beside = (edge[corner] + np.where(tau[corner] > 0, 1, -1)) % count
        _, (_, along, _) = self._places(t[corner], beside, -tau[corner])
        beyond = (gap[0, corner] * along[1] - gap[1, corner] * along[0]) / np.maximum(np.hypot(*along), TINY)
        side[corner] = np.where(np.abs(beyond) > np.abs(side[corner]), beyond, side[corner])
        sign = np.where(side < 0, -1.0, 1.0)
        across[:, corner] = sign[corner] / flat[corner] * gap[:, corner]
        bend[corner] = 0.0
        rise = (above - below) / (self.high - self.low)
        slope = -(across[0] * rise[0] + across[1] * rise[1])
        c = 1 / np.hypot(1.0, slope)
        normal = np.array([*across, slope]) * c
        by_ends = (-normal[2] * np.array([1 - t, t])).T

        def slopes() -> Floats:
            by_end = [
                end.by_vector((-c * part)[:, None] * chain_movement(end.chain(), edge, tau, across.T))
                for end, part in ((self.bottom, 1 - t), (self.top, t))
            ]
            return np.concatenate(by_end, axis=1)

        return WallFoot(c * sign * flat, normal.T, slopes, c * bend, by_ends)

    def _ends(self) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
        return self.bottom.chain(), self.top.chain()

    def _places(self, t: Floats, edge: Ints, tau: Floats) -> tuple[tuple[Floats, Floats], Places]:
        """Points (2, n) on edges at parameters, below and above; and in between, with their derivatives."""
        below, above = (edges_at(end, edge).places(tau) for end in self._ends())
        return (below[0], above[0]), _blended(t, below, above)

    def _closest(self, xy: Floats, t: Floats, edge: Ints, tau: Floats) -> Floats:
        """Parameters (n,) of the feet of points (2, n) on given edges, from parameters near by."""
        bottom, top = (edges_at(end, edge) for end in self._ends())
        for _ in range(NEWTON):
            at, d1, d2 = _blended(t, bottom.places(tau), top.places(tau))
            gap = at - xy
            first, second = gap[0] * d1[0] + gap[1] * d1[1], d1[0] * d1[0] + d1[1] * d1[1]
            full = second + gap[0] * d2[0] + gap[1] * d2[1]
            step = first / np.maximum(np.where(full > 0.2 * second, full, second), TINY)
            tau = np.clip(tau - np.clip(step, -0.5, 0.5), -1.0, 1.0)
        return tau

    def _nearest(self, points: Floats) -> tuple[Ints, Floats]:
        """Edge (n,) and parameter of the sample nearest to each point in the section at its height."""
        below, above = (_along(end, SAMPLES)[0].reshape(2, -1) for end in self._ends())
        # Squares of distances, but for what all of a point have in common, as the product of two matrices.
        squares = np.array([(below * below).sum(0), 2 * (below * above).sum(0), (above * above).sum(0)])
        samples = np.concatenate((squares, -2 * below, -2 * above))
        best = np.empty(len(points), dtype=np.intp)
        for start in range(0, len(points), BLOCK):
            x, y, z = points[start : start + BLOCK].T
            t = self.share(z)
            s = 1 - t
            rows = np.array([s * s, s * t, t * t, s * x, s * y, t * x, t * y])
            best[start : start + BLOCK] = np.argmin(rows.T @ samples, axis=1)
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
        areas = weights[:, None] * speed * np.tile(share, edges) * np.hypot(1.0, slope)
        return spread(at, z, flat, slope, areas)


def _along(chain: tuple[Floats, Floats], tau: Floats) -> Places:
    """Points (2, m, k) of all edges at parameters (k,), and derivatives."""
    return edges_at(chain, np.arange(len(chain[1]))[:, None]).places(tau)


def _blended(t: Floats, below: Places, above: Places) -> Places:
    """Places and derivatives, each its own share of the way up."""
    at, d1, d2 = ((1 - t) * low + t * high for low, high in zip(below, above, strict=True))
    return at, d1, d2
