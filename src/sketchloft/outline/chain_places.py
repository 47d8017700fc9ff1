"""Places on the edges of a chain of lines and arcs, and how they move with it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.outline.chain import chords, edge_place, outward

__all__ = ["EdgesAt", "chain_movement", "edges_at"]


@dataclass(frozen=True)
class EdgesAt:
    """An edge for each of some points; coordinates by rows, as vectorised arithmetic likes it.

    Parameters
    ----------
    middle, chord, across : (2, ...) float array
        Middle of the chord, the chord, and the chord turned outwards.
    bulge : (...) float array or None
        None where all are lines.
    """

    middle: Floats
    chord: Floats
    across: Floats
    bulge: Floats | None

    def places(self, tau: Floats) -> tuple[Floats, Floats, Floats]:
        """Points (2, ...) at parameters (...), and their first and second derivatives by these."""
        if self.bulge is None:
            at = self.middle + tau / 2 * self.chord
            return at, np.broadcast_to(self.chord / 2, at.shape), np.zeros(at.shape)
        square, turned = self.bulge * self.bulge, self.bulge * tau
        flat = turned * turned
        rate, more = 1 + flat, 1 + square
        xi, eta = edge_place(tau, self.bulge)
        once, twice = more / (rate * rate), more / (rate * rate * rate)
        slope = once * (1 - flat) / 2, -once * turned
        bend = twice * square * tau * (flat - 3), -twice * self.bulge * (1 - 3 * flat)
        first, second = (x * self.chord + y * self.across for x, y in (slope, bend))
        return self.middle + xi * self.chord + eta * self.across, first, second


def edges_at(chain: tuple[Floats, Floats], edge: Ints) -> EdgesAt:
    """The edges (...) of a chain."""
    vertices, bulges = chain
    along = chords(vertices)
    middle, chord, across = (rows.T[:, edge] for rows in (vertices + along / 2, along, outward(along)))
    return EdgesAt(middle, chord, across, bulges[edge] if bulges.any() else None)


def chain_movement(chain: tuple[Floats, Floats], edge: Ints, tau: Floats, normals: Floats) -> Floats:
    """Movement (n, 3m) along normals of places on edges by the vertices and the bulges of a chain."""
    vertices, bulges = chain
    count = len(bulges)
    chord, bulge = chords(vertices)[edge], bulges[edge]
    square = bulge * bulge
    rate = 1 + square * tau * tau
    xi, eta = edge_place(tau, bulge)
    quarter = np.column_stack([-normals[:, 1], normals[:, 0]])
    by_end = (0.5 + xi)[:, None] * normals + eta[:, None] * quarter
    by_start = normals - by_end
    by_bulge = tau * bulge * (1 - tau * tau) / rate**2 * np.einsum("ij,ij->i", normals, chord) + (
        1 - tau * tau
    ) * (1 - square * tau * tau) / (2 * rate**2) * np.einsum("ij,ij->i", normals, outward(chord))
    found = np.zeros((len(edge), 3 * count))
    row, after = np.arange(len(edge)), (edge + 1) % count
    for axis in range(2):
        found[row, 2 * edge + axis] = by_start[:, axis]
        found[row, 2 * after + axis] += by_end[:, axis]
    found[row, 2 * count + edge] = by_bulge
    return found
