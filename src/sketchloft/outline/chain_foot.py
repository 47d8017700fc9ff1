"""Foot of points on a chain of lines and arcs: distance, normal, curvature and gradient."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.outline.chain import edge_normal, edge_place
from sketchloft.outline.chain_nearest import Edges, Nearest, edge_frames, nearest
from sketchloft.outline.outline import Foot

__all__ = ["chain_foot", "seen_from_within"]


def seen_from_within(vertices: Floats, bulges: Floats) -> tuple[Floats, Edges]:
    """The middle (2,) of a chain, about which differences lose nothing, and its edges about that."""
    origin = vertices.mean(axis=0)
    return origin, edge_frames(vertices - origin, bulges)


def chain_foot(points: Floats, origin: Floats, edges: Edges) -> Foot:
    """What points see of a chain.

    Parameters
    ----------
    points : (n, 2) float array
    origin : (2,) float array
        Of the edges.
    edges : Edges
        Of the chain, counter-clockwise, 2 at least.

    Returns
    -------
    Foot
        The gradient (n, 3m) by [vertices ravelled, bulges].

    Notes
    -----
    In the frame of its chord, an edge of curvature c is where
    f = c (x**2 + y**2 - L**2 / 4) + 2 y cos(sweep / 2) vanishes, and the signed distance from it is
    f / (1 + sqrt(1 + c f)), which is y for a line.
    """
    local = points - origin
    near = nearest(local, edges)
    distance, normal, curvature, tau = _edge_foot(edges, near)
    rows = np.flatnonzero(~near.on_edge)
    if len(rows):
        distance[rows], normal[rows] = _vertex_foot(local[rows], edges, near.vertex[rows])
        curvature[rows] = 0.0
    return Foot(distance, normal, lambda: _gradient(edges, near, normal, tau), curvature)


def _gradient(edges: Edges, near: Nearest, normal: Floats, tau: Floats) -> Floats:
    """Derivative (n, 3m) of the distance by the vertices and the bulges."""
    m = len(edges.bulge)
    gradient = np.zeros((3 * m, len(tau)))
    rows = np.flatnonzero(near.on_edge)
    edge = near.edge[rows]
    by_start, by_end, by_bulge = _edge_gradient(edges, edge, normal[rows], tau[rows])
    _put(gradient, rows, edge, by_start)
    _put(gradient, rows, (edge + 1) % m, by_end)
    gradient[2 * m + edge, rows] = by_bulge
    rows = np.flatnonzero(~near.on_edge)
    _put(gradient, rows, near.vertex[rows], -normal[rows])
    return gradient.T


def _put(gradient: Floats, rows: Ints, vertex: Ints, values: Floats) -> None:
    """Set the derivative (3m, n) of some points by their vertices (n,)."""
    gradient[2 * vertex, rows], gradient[2 * vertex + 1, rows] = values.T


def _edge_foot(edges: Edges, near: Nearest) -> tuple[Floats, Floats, Floats, Floats]:
    """Distance, normal, curvature and parameter tau of points on the edges that they are nearest to."""
    edge, x, y = near.edge, near.x, near.y
    across = edges.across.T[:, edge]
    if edges.straight:
        return y, across.T, np.zeros(len(y)), np.clip(2 * x / edges.reach[edge], -1.0, 1.0)
    curvature, cosine, length = edges.curvature[edge], edges.cosine[edge], edges.length[edge]
    f = curvature * (x * x + y * y - length**2 / 4) + 2 * y * cosine
    root = np.sqrt(np.maximum(1 + curvature * f, 0.0))
    tau = 4 * x / (edges.reach[edge] * np.maximum(root + curvature * y + cosine, 1e-300))
    tau = np.clip(tau, -1.0, 1.0)
    with_chord, aside = edge_normal(tau, edges.bulge[edge])
    normal = with_chord * edges.unit.T[:, edge] + aside * across
    return f / (1 + root), normal.T, curvature, tau


def _edge_gradient(edges: Edges, edge: Ints, normal: Floats, tau: Floats) -> tuple[Floats, Floats, Floats]:
    """Minus the normal times the movement of points at tau: by start, end (n, 2) and bulge (n,)."""
    if edges.straight:
        share = (tau[:, None] + 1) / 2
        return (share - 1) * normal, -share * normal, (tau * tau - 1) * edges.length[edge] / 2
    bulge = edges.bulge[edge]
    xi, eta = edge_place(tau, bulge)
    turned = eta[:, None] * np.column_stack([-normal[:, 1], normal[:, 0]])
    by_start = turned - (0.5 - xi)[:, None] * normal
    by_end = -turned - (0.5 + xi)[:, None] * normal
    square = np.square(bulge * tau)
    rate = (1 - tau * tau) / (1 + square) ** 2
    lengthwise = np.einsum("ij,ij->i", normal, edges.unit[edge])
    sideways = np.einsum("ij,ij->i", normal, edges.across[edge])
    by_bulge = tau * bulge * lengthwise + (1 - square) / 2 * sideways
    return by_start, by_end, -rate * edges.length[edge] * by_bulge


def _vertex_foot(points: Floats, edges: Edges, vertex: Ints) -> tuple[Floats, Floats]:
    """Signed distance and normal of points nearest to vertices (n,): outside on the normals' side."""
    lean, aside = edge_normal(np.ones(len(edges.bulge)), edges.bulge)
    at_start = aside[:, None] * edges.across - lean[:, None] * edges.unit
    at_end = aside[:, None] * edges.across + lean[:, None] * edges.unit
    before, after = _neighbours(edges.exists)
    side = at_end[before[vertex]] + at_start[after[vertex]]
    side /= np.maximum(np.hypot(side[:, 0], side[:, 1]), 1e-300)[:, None]
    gap = points - edges.start[vertex]
    far = np.hypot(gap[:, 0], gap[:, 1])
    # Beyond a cusp, where the normals cancel, is outside.
    sign = np.where(np.einsum("ij,ij->i", gap, side) < -1e-12 * far, -1.0, 1.0)
    normal = np.where(far[:, None] > 0, gap * (sign / np.maximum(far, 1e-300))[:, None], side)
    return sign * far, normal


def _neighbours(exists: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Last edge before each vertex, and first one after it, that have a length."""
    m = len(exists)
    if exists.all():
        after = np.arange(m)
        return after - 1, after
    at = np.arange(2 * m)
    twice = np.tile(exists, 2)
    last = np.maximum.accumulate(np.where(twice, at, -1))
    first = np.minimum.accumulate(np.where(twice, at, 2 * m)[::-1])[::-1]
    return last[m - 1 : 2 * m - 1] % m, first[:m] % m
