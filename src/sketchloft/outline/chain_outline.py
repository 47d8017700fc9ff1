"""ChainOutline: what the outlines of lines and arcs have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property
from typing import Self

from sketchloft.cloud import Floats
from sketchloft.outline.chain import chain_area, chain_boundary, chain_edges
from sketchloft.outline.chain_foot import chain_foot, seen_from_within
from sketchloft.outline.chain_nearest import Edges
from sketchloft.outline.outline import Boundary, Edge, Foot

__all__ = ["ChainOutline"]


class ChainOutline(ABC):
    """An outline whose parameters say where the vertices of a chain are, and how its edges bulge."""

    @property
    @abstractmethod
    def vector(self) -> Floats:
        """Parameters (p,)."""

    @abstractmethod
    def moved(self, vector: Floats) -> Self:
        """Return the outline of the same kind with other parameters (p,)."""

    @abstractmethod
    def chain(self) -> tuple[Floats, Floats]:
        """Return vertices (m, 2), counter-clockwise, and bulges (m,)."""

    @abstractmethod
    def by_vector(self, gradient: Floats) -> Floats:
        """Turn a derivative (n, 3m) by the chain into one (n, p) by the parameters: the chain rule."""

    @property
    def area(self) -> float:
        """Enclosed area."""
        return abs(chain_area(*self._chain))

    def foot(self, points: Floats) -> Foot:
        """Signed distance of points (n, 2), and its derivatives."""
        seen = chain_foot(points, *self._edges)
        return Foot(seen.distance, seen.normal, lambda: self.by_vector(seen.gradient), seen.curvature)

    def boundary(self, count: int) -> Boundary:
        """About `count` points along it, to integrate with, 2 or more on each edge."""
        return chain_boundary(*self._chain, count)

    def edges(self) -> tuple[Edge, ...]:
        """Its lines and arcs, counter-clockwise."""
        return chain_edges(*self._chain)

    @cached_property
    def _chain(self) -> tuple[Floats, Floats]:
        return self.chain()

    @cached_property
    def _edges(self) -> tuple[Floats, Edges]:
        return seen_from_within(*self._chain)
