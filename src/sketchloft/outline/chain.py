"""Chain: a closed chain of lines and arcs, the geometry that outlines with corners share.

A chain is vertices (m, 2), counter-clockwise, and bulges (m,). Edge k goes from vertex k to vertex k + 1; its
bulge is the tangent of a quarter of its sweep: 0 is a line, 1 a half circle outwards, -1 one inwards. A point
of it is the middle of the chord + xi * chord + eta * (chord turned outwards), with xi and eta rational in a
parameter tau from -1 to 1, so that lines need no case of their own.
"""

from __future__ import annotations

import functools

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.gauss import gauss
from sketchloft.outline.outline import Arc, Boundary, Edge, Segment
from sketchloft.ring import following, ring_area

__all__ = ["chain_area", "chain_boundary", "chain_edges", "chords", "edge_normal", "edge_place", "outward"]

STRAIGHT = 1e-9
"""Edges of a smaller bulge are lines to a CAD kernel."""
VANISHED = 1e-9
"""Edges shorter than this, relative to the perimeter, are left out."""
TURN = np.pi / 4
"""Sweep of an arc for which there is one more of them than on a line, at least. The number changes, by which
what is integrated makes a step, far from right angles, which are common."""
PANEL = 8
"""Gauss points of a panel; edges with more get several panels."""


def chords(vertices: Floats) -> Floats:
    """(m, 2) vectors from each vertex to the next."""
    return following(vertices) - vertices


def outward(vectors: Floats) -> Floats:
    """Vectors (..., 2) along a counter-clockwise curve turned by a quarter, outwards."""
    turned = np.empty_like(vectors)
    turned[..., 0], turned[..., 1] = vectors[..., 1], -vectors[..., 0]
    return turned


def edge_place(tau: Floats, bulge: Floats) -> tuple[Floats, Floats]:
    """xi and eta of the points at parameters tau."""
    square = np.square(bulge)
    rate = 2 * (1 + square * tau * tau)
    return (1 + square) * tau / rate, bulge * (1 - tau * tau) / rate


def edge_normal(tau: Floats, bulge: Floats) -> tuple[Floats, Floats]:
    """Outward unit normal at parameters tau, along the chord and across it."""
    t = bulge * tau
    rate = 1 + t * t
    return 2 * t / rate, (1 - t * t) / rate


def chain_area(vertices: Floats, bulges: Floats) -> float:
    """Signed area within a chain, positive when counter-clockwise."""
    if not bulges.any():
        return ring_area(vertices)
    squares = np.square(chords(vertices)).sum(axis=1)
    return ring_area(vertices) + float((squares * _segment_area(bulges)).sum())


def _segment_area(bulges: Floats) -> Floats:
    """Area between an arc and its chord of length 1."""
    square = np.square(bulges)
    series = bulges * (8 / 3 - square * (24 / 5 - square * (48 / 7 - square * 80 / 9))) / 8
    round_ = np.where(np.abs(bulges) < 0.03, 1.0, bulges)  # where the series is as exact as the closed form
    full = np.square(round_)
    closed = (4 * np.arctan(round_) - 4 * round_ * (1 - full) / (1 + full) ** 2) / (32 * full)
    return (1 + square) ** 2 * np.where(np.abs(bulges) < 0.03, series, closed)


def chain_boundary(vertices: Floats, bulges: Floats, count: int) -> Boundary:
    """About `count` Gauss points along a chain, in proportion to the edges' lengths.

    There are 2 or more on each edge, and on an arc as many more as it turns, as what is integrated does.
    """
    along = chords(vertices)
    lengths = _lengths(along, bulges)
    least = 2 + np.rint(4 * np.abs(np.arctan(bulges)) / TURN).astype(np.intp)
    shares = np.maximum(least, np.rint(count * lengths / lengths.sum()).astype(np.intp))
    shares[lengths <= VANISHED * lengths.sum()] = 0
    edge, fraction, weights = _rules(tuple(shares.tolist()))
    bulge, chord = bulges[edge], along[edge]
    curve = np.where(bulge == 0, 1.0, bulge)
    tau = np.where(bulge == 0, fraction, np.tan(fraction * np.arctan(curve)) / curve)
    xi, eta = edge_place(tau, bulge)
    points = vertices[edge] + (0.5 + xi)[:, None] * chord + eta[:, None] * outward(chord)
    with_chord, across = edge_normal(tau, bulge)
    unit = chord / np.linalg.norm(chord, axis=1, keepdims=True)
    normals = with_chord[:, None] * unit + across[:, None] * outward(unit)
    return Boundary(points, normals, weights * lengths[edge])


def _lengths(along: Floats, bulges: Floats) -> Floats:
    curve = np.where(bulges == 0, 1.0, bulges)
    ratio = np.where(bulges == 0, 1.0, (1 + curve * curve) * np.arctan(curve) / curve)
    return np.linalg.norm(along, axis=1) * ratio


@functools.lru_cache(maxsize=256)
def _rules(shares: tuple[int, ...]) -> tuple[Ints, Floats, Floats]:
    """Edge, fraction and weight of all points of edges with about so many each."""
    rules = [_gauss(share) for share in shares]
    edge = np.repeat(np.arange(len(shares)), [len(nodes) for nodes, _ in rules])
    return edge, np.concatenate([nodes for nodes, _ in rules]), np.concatenate([w for _, w in rules])


@functools.lru_cache(maxsize=256)
def _gauss(count: int) -> tuple[Floats, Floats]:
    """Nodes in -1 to 1 and weights that add up to 1 of a rule with about `count` points."""
    if count == 0:
        return np.zeros(0), np.zeros(0)
    panels = -(-count // PANEL)
    nodes, weights = gauss(-(-count // panels))
    middles = (2 * np.arange(panels) + 1) / panels - 1
    return (middles[:, None] + nodes / panels).ravel(), np.tile(weights / 2 / panels, panels)


def chain_edges(vertices: Floats, bulges: Floats) -> tuple[Edge, ...]:
    """Edges of a chain, each starting where the last one ended, without those that have no length."""
    lengths = _lengths(chords(vertices), bulges)
    kept = lengths > VANISHED * lengths.sum()
    starts, bulges = vertices[kept], bulges[kept]
    ends = np.roll(starts, -1, axis=0)
    middles = (starts + ends) / 2 + bulges[:, None] / 2 * outward(ends - starts)
    return tuple(
        Segment(start, end) if abs(bulge) < STRAIGHT else Arc(start, middle, end)
        for start, middle, end, bulge in zip(starts, middles, ends, bulges, strict=True)
    )
