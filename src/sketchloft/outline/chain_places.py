"""Places on the edges of a chain of lines and arcs, and how they move with it."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.outline.chain import chords, edge_place, outward

__all__ = ["chain_movement", "chain_place"]


def chain_place(chain: tuple[Floats, Floats], edge: Ints, tau: Floats, order: int) -> Floats:
    """Points (..., 2) on edges at parameters, or their first or second derivatives by the parameter."""
    vertices, bulges = chain
    chord, bulge = chords(vertices)[edge], bulges[edge]
    square = bulge * bulge
    rate = 1 + square * tau * tau
    if order == 0:
        xi, eta = edge_place(tau, bulge)
    elif order == 1:
        scale = (1 + square) / rate**2
        xi, eta = scale * (1 - square * tau * tau) / 2, -scale * bulge * tau
    else:
        scale = (1 + square) / rate**3
        xi = scale * square * tau * (square * tau * tau - 3)
        eta = -scale * bulge * (1 - 3 * square * tau * tau)
    moved = xi[..., None] * chord + eta[..., None] * outward(chord)
    return moved if order else vertices[edge] + chord / 2 + moved


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
