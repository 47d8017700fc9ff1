"""RectilinearPolygon: all corners are right ones, as those of an L, a cross or a flight of stairs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain import chords
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.placed_polygons import moves_of, placed

__all__ = ["RectilinearPolygon", "rectilinear_of", "with_a_step_less"]

FEWEST = 6
"""Corners of one that is not a rectangle."""
ALIGNED = 0.5
"""How much of its length, squared, a polygon has in two directions, at least, to be meant for one: a regular
polygon of more than four sides has none."""
FORWARD = 0.8
"""Share of an edge's length that may not turn back."""


@dataclass(frozen=True)
class RectilinearPolygon(ChainOutline):
    """A polygon whose edges run in two directions in turn, at right angles to each other.

    Parameters
    ----------
    offsets : (m,) float array
        Of the edges from the origin, m even: those of the first, the third, ... across the first direction,
        those of the others along it.
    angle : float
        Of the first edge's direction from x, in radians.
    """

    kind: ClassVar[str] = "rectilinear polygon"

    offsets: Floats
    angle: float

    @property
    def vector(self) -> Floats:
        """Offsets, angle: (m + 1,)."""
        return np.r_[self.offsets, self.angle]

    def moved(self, vector: Floats) -> Self:
        """Return the polygon with other parameters."""
        return replace(self, offsets=vector[:-1].copy(), angle=float(vector[-1]))

    def chain(self) -> tuple[Floats, Floats]:
        """Corners, and bulges of 0."""
        return placed(np.zeros(2), self.angle, self._local), np.zeros(len(self.offsets))

    def by_vector(self, gradient: Floats) -> Floats:
        """Apply the derivative of the corners."""
        count = len(self.offsets)
        edge = np.arange(count)
        by_offset = np.zeros((count, count, 2))
        for corner in (edge, (edge + 1) % count):
            by_offset[edge, corner, 1 - edge % 2] = 1.0
        return gradient[:, : 2 * count] @ moves_of(self.angle, self._local, *by_offset)[:, 2:]

    @property
    def _local(self) -> Floats:
        """Corners (m, 2) where each edge meets the one before, along and across the first direction."""
        pairs = np.column_stack([np.roll(self.offsets, 1), self.offsets])
        pairs[1::2] = pairs[1::2, ::-1]
        return pairs


def rectilinear_of(vertices: Floats) -> RectilinearPolygon | None:
    """Rectilinear polygon that a polygon (m, 2), counter-clockwise, is about; None if it is far from one.

    Notes
    -----
    The directions are those that the edges have mostly, by their fourfold angle; edges that run one after the
    other in the same one, about, become one at their mean offset.
    """
    along = chords(vertices) @ [1, 1j]
    fourfold = (along**4 / np.maximum(np.abs(along), 1e-15) ** 2).sum()
    if np.abs(fourfold) < ALIGNED * (np.abs(along) ** 2).sum():
        return None
    angle = float(np.angle(fourfold)) / 4
    along = along * np.exp(-1j * angle)
    middles = ((vertices + np.roll(vertices, -1, axis=0)) / 2) @ [1, 1j] * np.exp(-1j * angle)
    level = np.abs(along.real) > np.abs(along.imag)
    first = np.flatnonzero(level & ~np.roll(level, 1))
    if not len(first):
        return None
    along, middles, level = (np.roll(each, -int(first[0])) for each in (along, middles, level))
    group = np.cumsum(np.r_[0, level[1:] != level[:-1]])
    run = np.where(level, along.real, along.imag)
    offset = np.where(level, middles.imag, middles.real)
    lengths = np.bincount(group, np.abs(run))
    if len(lengths) < FEWEST or (np.abs(np.bincount(group, run)) < FORWARD * lengths).any():
        return None
    return RectilinearPolygon(np.bincount(group, np.abs(run) * offset) / lengths, angle)


def with_a_step_less(polygon: RectilinearPolygon) -> RectilinearPolygon | None:
    """The polygon whose smallest step is left out, joining the edges beside it; None where none can be."""
    count = len(polygon.offsets)
    edges = chords(polygon.chain()[0])
    lengths = np.hypot(*edges.T)
    before, after = np.roll(lengths, 1), np.roll(lengths, -1)
    onward = (np.roll(edges, 1, axis=0) * np.roll(edges, -1, axis=0)).sum(axis=1) > 0
    if count <= FEWEST or not onward.any():
        return None
    k = int(np.argmin(np.where(onward, lengths * np.minimum(before, after), np.inf)))
    offsets = np.roll(polygon.offsets, 1 - k)  # the edge before it first, then itself, then the one after
    joined = (before[k] * offsets[0] + after[k] * offsets[2]) / (before[k] + after[k])
    left = np.r_[joined, offsets[3:]]
    return replace(polygon, offsets=np.roll(left, (k - 1) % 2))
