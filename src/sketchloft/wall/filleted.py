"""Filleted: a prism whose edges at the bottom, at the top or at both are rounded off."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, Self, get_args

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.gauss import gauss
from sketchloft.outline.inset import Insettable, inset
from sketchloft.outline.placed_polygons import RoundedRectangle
from sketchloft.wall.foot import WallBoundary, WallFoot

__all__ = ["ENDS", "Ends", "Filleted"]

Ends = Literal["both", "bottom", "top"]
ENDS: tuple[Ends, ...] = get_args(Ends)
GAUSS = gauss(6)
TINY = 1e-12


@dataclass(frozen=True)
class Filleted:
    """A prism with the same fillet along the edges of its ends.

    Parameters
    ----------
    outline : Rectangle or RoundedRectangle
        Between the fillets.
    fillet : float or None
        Radius at the ends of a rectangle with sharp corners; None for a rounded one, whose corners have it.
    ends : {"both", "bottom", "top"}
        Which are rounded.
    low, high : float
        Heights of the ends, those of the breaks of the run; no parameters of the wall.
    """

    kind: ClassVar[str] = "filleted prism"

    outline: Insettable
    fillet: float | None
    ends: Ends = "both"
    low: float = 0.0
    high: float = 1.0

    @property
    def radius(self) -> float:
        """Of the fillets at the ends."""
        if self.fillet is None:
            return self.outline.radius if isinstance(self.outline, RoundedRectangle) else 0.0
        return self.fillet

    @property
    def vector(self) -> Floats:
        """Parameters of the outline, and the fillet unless it is the outline's own."""
        return self.outline.vector if self.fillet is None else np.r_[self.outline.vector, self.fillet]

    def moved(self, vector: Floats) -> Self:
        """Return the wall with other parameters."""
        at = len(self.outline.vector)
        fillet = None if self.fillet is None else abs(float(vector[at]))
        return replace(self, outline=self.outline.moved(vector[:at]), fillet=fillet)

    def between(self, low: float, high: float) -> Self:
        """Return the wall with its ends at other heights."""
        return replace(self, low=low, high=high)

    def tips(self) -> tuple[float, float]:
        """Heights between which it has a section."""
        return self.low, self.high

    def area(self, heights: Floats) -> Floats:
        """Area of the sections at heights (m,)."""
        return np.array([inset(self.outline, depth).area for depth in self._depth(heights).tolist()])

    def section(self, height: float) -> Insettable:
        """Outline at a height."""
        return inset(self.outline, float(self._depth(np.array([height]))[0]))

    def _rise(self, heights: Floats) -> tuple[Floats, Floats]:
        """How far into a fillet heights are, its radius at the end; and 1 at the top, -1 at the bottom."""
        above = (
            self.radius - (self.high - heights) if self.ends != "bottom" else np.full(len(heights), -np.inf)
        )
        below = self.radius - (heights - self.low) if self.ends != "top" else np.full(len(heights), -np.inf)
        return np.maximum(above, below), np.where(above > below, 1.0, -1.0)

    def _depth(self, heights: Floats) -> Floats:
        rise = np.clip(self._rise(heights)[0], 0.0, self.radius)
        return self.radius - np.sqrt(np.maximum(self.radius**2 - rise**2, 0.0))

    def foot(self, points: Floats) -> WallFoot:
        """Signed distance of points (n, 3), and its derivatives; the flat ends are breaks, not the wall's.

        Notes
        -----
        Beside a fillet it is the distance from the circle that the section of the fillet is; where the flat
        end is nearer, one that falls inwards faster than that from the end.
        """
        seen = self.outline.foot(points[:, :2])
        rise, way = self._rise(points[:, 2])
        across = seen.distance + self.radius
        far = np.maximum(np.hypot(across, rise), TINY)
        beside, over = (rise > 0) & (across > 0), (rise > 0) & (across <= 0)
        by_across = np.where(beside, across / far, 1.0)
        by_rise = np.where(beside, rise / far, np.where(over, 1.0, 0.0))
        distance = np.where(beside, far - self.radius, np.where(over, seen.distance + rise, seen.distance))
        by_radius = np.where(beside, by_across + by_rise - 1, np.where(over, 1.0, 0.0))

        def slopes() -> Floats:
            gradient = by_across[:, None] * seen.gradient
            if self.fillet is not None:
                return np.column_stack([gradient, by_radius])
            gradient[:, -1] += by_radius
            return gradient

        up = way * by_rise
        bend = by_across * seen.curvature + np.where(beside, 1 / far, 0.0)
        normal = np.column_stack([by_across[:, None] * seen.normal, up])
        by_ends = np.column_stack([np.where(way < 0, -up, 0.0), np.where(way > 0, -up, 0.0)])
        return WallFoot(distance, normal, slopes, bend, by_ends)

    def boundary(self, low: float, high: float, count: int) -> WallBoundary:
        """About `count` points on the wall between two heights."""
        x, w = GAUSS
        parts = []
        around = max(24, count // (3 * len(x)))
        for start, end, way in self._zones(low, high):
            half = (end - start) / 2
            for at, weight in zip(((start + end) / 2 + half * x).tolist(), (half * w).tolist(), strict=True):
                turn, length = (at, weight * self.radius) if way else (0.0, weight)
                ring = inset(self.outline, self.radius * (1 - np.cos(turn))).boundary(around)
                z = float(self._fillet_height(way, np.array(turn))) if way else at
                level = np.ones(len(ring.points))
                normals = np.column_stack([np.cos(turn) * ring.normals, way * np.sin(turn) * level])
                parts.append((np.column_stack([ring.points, z * level]), normals, length * ring.lengths))
        points, normals, areas = (np.concatenate(column) for column in zip(*parts, strict=True))
        return WallBoundary(points, normals, areas)

    def spans(self, low: float, high: float) -> Iterator[tuple[Floats, Floats]]:
        """Heights and weights to integrate sections with between two heights, in pieces that are smooth."""
        x, w = gauss(16)
        for start, end, way in self._zones(low, high):
            at, weight = (start + end) / 2 + (end - start) / 2 * x, (end - start) / 2 * w
            if not way:
                yield at, weight
                continue
            yield self._fillet_height(way, at), weight * self.radius * np.cos(at)

    def _fillet_height(self, way: int, turn: Floats) -> Floats:
        """Height at an angle from the prism along the fillet at the bottom or the top."""
        centre = self.high - self.radius if way > 0 else self.low + self.radius
        return centre + way * self.radius * np.sin(turn)

    def _zones(self, low: float, high: float) -> Iterator[tuple[float, float, int]]:
        """Pieces between two heights: of the prism by height, of fillets by the angle from the prism."""
        bottom = self.low + (self.radius if self.ends != "top" else 0.0)
        top = self.high - (self.radius if self.ends != "bottom" else 0.0)
        if self.ends != "top" and low < bottom:
            angles = np.arcsin(np.clip((bottom - np.array([min(high, bottom), low])) / self.radius, 0, 1))
            yield float(angles[0]), float(angles[1]), -1
        if max(low, bottom) < min(high, top):
            yield max(low, bottom), min(high, top), 0
        if self.ends != "bottom" and high > top:
            angles = np.arcsin(np.clip((np.array([max(low, top), high]) - top) / self.radius, 0, 1))
            yield float(angles[0]), float(angles[1]), 1
