"""Nearest edges and vertices of a chain of lines and arcs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.outline.chain import chords, outward

__all__ = ["Edges", "Nearest", "edge_frames", "nearest"]

BLOCK = 32_768
"""Pairs of a point and an edge that are worked on at once; so few that they stay in the cache."""
SLACK = 1 + 1e-12
"""An edge reaches this much further than its end, so that smooth joints show no vertex."""


class Edges(NamedTuple):
    """Frames and arcs of the edges, each (m,) or (m, 2)."""

    start: Floats
    middle: Floats
    unit: Floats
    across: Floats
    length: Floats
    bulge: Floats
    curvature: Floats
    cosine: Floats  # of half the sweep
    reach: Floats  # length * (1 + bulge**2)
    exists: NDArray[np.bool_]  # whether it has a length

    @property
    def straight(self) -> bool:
        """Whether all are lines."""
        return not self.bulge.any()


class Nearest(NamedTuple):
    """Nearest edge and vertex of points, each (n,), and where they are in the frame of that edge."""

    edge: Ints
    vertex: Ints
    on_edge: NDArray[np.bool_]
    x: Floats
    y: Floats


def edge_frames(vertices: Floats, bulges: Floats) -> Edges:
    """Frames and arcs of the edges of a chain; an edge without a length has that of x."""
    along = chords(vertices)
    length = np.hypot(along[:, 0], along[:, 1])
    exists = length > 1e-12 * length.max()
    size = np.where(exists, length, 1.0)
    unit = np.where(exists[:, None], along / size[:, None], np.array([1.0, 0.0]))
    square = bulges * bulges
    return Edges(
        vertices,
        vertices + along / 2,
        unit,
        outward(unit),
        np.where(exists, length, 0.0),
        bulges,
        4 * bulges / (size * (1 + square)),
        (1 - square) / (1 + square),
        size * (1 + square),
        exists,
    )


def nearest(points: Floats, edges: Edges) -> Nearest:
    """Nearest edge, among those whose foot is not an end, and nearest vertex of points (n, 2)."""
    size = max(1, BLOCK // len(edges.bulge))
    blocks = [_nearest_block(points[i : i + size], edges) for i in range(0, len(points), size)]
    if len(blocks) == 1:
        return blocks[0]
    if not blocks:
        none = np.zeros(0, dtype=np.intp)
        return Nearest(none, none, none > 0, np.zeros(0), np.zeros(0))
    return Nearest(*(np.concatenate(parts) for parts in zip(*blocks, strict=True)))


def _nearest_block(points: Floats, edges: Edges) -> Nearest:
    # Edges by rows: the long axis last is what vectorised arithmetic likes.
    half = edges.length[:, None] / 2
    x = edges.unit @ points.T - np.einsum("ij,ij->i", edges.middle, edges.unit)[:, None]
    y = edges.across @ points.T - np.einsum("ij,ij->i", edges.middle, edges.across)[:, None]
    column = np.arange(len(points))
    if edges.straight:
        beyond = x - np.clip(x, -half, half)
        edge = (np.square(beyond) + y * y).argmin(axis=0)
        x, y = x[edge, column], y[edge, column]
        on_edge = edges.exists[edge] & (np.abs(x) <= half[edge, 0] * SLACK)
        return Nearest(edge, (edge + (x > 0)) % len(edges.bulge), on_edge, x, y)
    to_vertex = np.square(x + half) + y * y
    gap, within = _arcs(x, y, edges)
    within &= edges.exists[:, None]
    to_edge = np.where(within, gap * gap, np.inf)
    edge, vertex = to_edge.argmin(axis=0), to_vertex.argmin(axis=0)
    on_edge = to_edge[edge, column] <= to_vertex[vertex, column]
    return Nearest(edge, vertex, on_edge, x[edge, column], y[edge, column])


def _arcs(x: Floats, y: Floats, edges: Edges) -> tuple[Floats, NDArray[np.bool_]]:
    """Signed distance (m, n) of points in the chords' frames, and whether they are before the edge itself."""
    curvature, cosine, reach = edges.curvature[:, None], edges.cosine[:, None], edges.reach[:, None]
    f = curvature * (x * x + y * y - edges.length[:, None] ** 2 / 4) + 2 * cosine * y
    root = np.sqrt(np.maximum(1 + curvature * f, 0.0))
    facing = curvature * y + cosine
    far = np.abs(x) * 4
    # |tau| <= 1, in a form for either side of the centre in which nothing cancels.
    within = (facing >= 0) & (far <= reach * SLACK * (root + facing))
    if np.abs(edges.bulge).max() > 1:
        behind = reach * (root - facing) <= (edges.bulge**2)[:, None] * SLACK * far
        within |= (facing < 0) & behind
    return f / (1 + root), within
