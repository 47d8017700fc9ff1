"""Polygons: outlines of which every vertex is free, with straight edges or arcs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.outline.chain import chords
from sketchloft.outline.chain_outline import ChainOutline

__all__ = ["LineArc", "Polygon", "chain_outline", "corner_areas", "flattest", "odd_corners", "thin_cuts"]

PLAIN = np.radians([0.0, 90.0, -90.0])
"""Turns at the end of an arc that a designer draws."""
NARROWEST = 0.2
"""Angle in radians between the sides of a cut inwards that is as thin as none is drawn."""
ASKEW = np.radians(15.0)
"""How far from these a turn may be."""


@dataclass(frozen=True)
class Polygon(ChainOutline):
    """A simple polygon.

    Parameters
    ----------
    vertices : (m, 2) float array
        Counter-clockwise.
    """

    kind: ClassVar[str] = "polygon"

    vertices: Floats

    @property
    def vector(self) -> Floats:
        """Vertices: (2m,)."""
        return self.vertices.ravel().copy()

    def moved(self, vector: Floats) -> Self:
        """Return the polygon with other vertices."""
        return replace(self, vertices=vector.reshape(-1, 2).copy())

    def chain(self) -> tuple[Floats, Floats]:
        """Vertices, and bulges of 0."""
        return self.vertices, np.zeros(len(self.vertices))

    def by_vector(self, gradient: Floats) -> Floats:
        """Leave out the bulges."""
        return gradient[:, : 2 * len(self.vertices)]


def corner_areas(vertices: Floats) -> Floats:
    """Twice the area (m,) of the triangle that each vertex (m, 2) makes with its two neighbours."""
    before, after = np.roll(vertices, 1, axis=0) - vertices, np.roll(vertices, -1, axis=0) - vertices
    return np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])


def flattest(vertices: Floats) -> list[int]:
    """The corners whose triangles with their neighbours are smallest, three at most."""
    return [int(k) for k in np.argsort(corner_areas(vertices))[:3]]


@dataclass(frozen=True)
class LineArc(ChainOutline):
    """A closed chain of lines and arcs.

    Parameters
    ----------
    vertices : (m, 2) float array
        Counter-clockwise, m at least 2.
    bulges : (m,) float array
        Tangent of a quarter of the sweep of the edge from vertex k to k + 1, positive outwards, 0 for a line.
    curved : (m,) bool array
        Edges whose bulge is a parameter.
    """

    kind: ClassVar[str] = "line-arc"

    vertices: Floats
    bulges: Floats
    curved: NDArray[np.bool_]

    @property
    def vector(self) -> Floats:
        """Vertices, then the bulges of the curved edges."""
        return np.r_[self.vertices.ravel(), self.bulges[self.curved]]

    def moved(self, vector: Floats) -> Self:
        """Return the chain with other vertices and bulges."""
        at = self.vertices.size
        bulges = self.bulges.copy()
        bulges[self.curved] = vector[at:]
        return replace(self, vertices=vector[:at].reshape(-1, 2).copy(), bulges=bulges)

    def chain(self) -> tuple[Floats, Floats]:
        """Vertices and bulges."""
        return self.vertices, self.bulges

    def by_vector(self, gradient: Floats) -> Floats:
        """Leave out the bulges that are fixed."""
        by_vertices, by_bulges = np.split(gradient, [self.vertices.size], axis=1)
        return np.concatenate([by_vertices, by_bulges[:, self.curved]], axis=1)


def chain_outline(vertices: Floats, bulges: Floats) -> Polygon | LineArc:
    """Outline of a chain whose lines stay lines."""
    return LineArc(vertices, bulges, bulges != 0) if bulges.any() else Polygon(vertices)


def _turns(vertices: Floats, bulges: Floats) -> Floats:
    """Angle (m,) by which a chain turns at each vertex, positive to the left."""
    along = chords(vertices)
    angle, sweep = np.arctan2(along[:, 1], along[:, 0]), 4 * np.arctan(bulges)
    turn = angle - sweep / 2 - np.roll(angle + sweep / 2, 1)
    return np.asarray(np.angle(np.exp(1j * turn)))


def odd_corners(outline: LineArc) -> int:
    """How many ends of arcs neither run on into the next edge nor stand at right angles to it, about."""
    turn = _turns(outline.vertices, outline.bulges)
    away = np.abs(np.angle(np.exp(1j * (turn[:, None] - PLAIN)))).min(axis=1)
    beside_arc = outline.curved | np.roll(outline.curved, 1)
    return int((beside_arc & (away > ASKEW)).sum())


def thin_cuts(vertices: Floats, bulges: Floats) -> float:
    """How often a chain cuts inwards as thinly as nobody draws, where by chance there are no points.

    A cut as narrow as `NARROWEST` counts once, one of no width twice, one of twice the width not at all.
    """
    widths = np.pi + _turns(vertices, bulges)
    return float(np.maximum(2 - widths / NARROWEST, 0.0).sum())
