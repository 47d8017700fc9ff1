"""Ruled start: a wall between what the sections near both ends of a stretch are taken for."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.section.recognise_section import recognise_section
from sketchloft.outline.chain import chords, outward
from sketchloft.outline.chain_outline import ChainOutline
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import RoundedRectangle
from sketchloft.outline.polygons import chain_outline
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.wall.ruled import Ruled
from sketchloft.workers import ALONE, Workers

__all__ = ["ruled_start"]

SLABS = (0.12, 0.2, 0.3)
"""Shares of the stretch at either end whose points show the outline there: the first with enough of them."""
FEWEST = 150
"""Points that such a slab needs."""
MOST_POINTS = 1200
RING = 720
MOST_EDGES = 12
ROUND = (RoundedPolygon, RoundedRectangle)
"""Outlines with corners that are none."""


def ruled_start(
    points: Floats, ends: tuple[float, float], together: float, workers: Workers = ALONE
) -> Ruled | None:
    """Wall from one outline to another, where one at least has corners.

    Parameters
    ----------
    points : (n, 3) float array
    ends : (low, high)
        Heights.
    together : float
        How many of the points go together.
    workers : Workers, optional

    Returns
    -------
    Ruled
        None where a section is not one piece, or neither has corners, or both are too rich in them.
    """
    low, high = ends
    share = (points[:, 2] - low) / (high - low)
    inside = (share > 0) & (share < 1)
    found = [_slab(points[inside, :2], at[inside]) for at in (share, 1 - share)]
    slabs, (width, last_width) = zip(*found, strict=True)
    if min(map(len, slabs)) < FEWEST:
        return None
    outlines: list[Outline] = []
    for shape in workers.beside(recognise_section, [(slab, together) for slab in slabs]):
        if shape is None or shape.holes or len(shape.outlines) != 1:
            return None
        outlines.append(shape.outlines[0])
    chains = _matched(*outlines)
    if chains is None:
        return None
    # What was found is the section in the middle of each slab.
    (first, first_bulges), (last, last_bulges) = chains
    rise = (last - first) / (1 - (width + last_width) / 2)
    below = chain_outline(first - width / 2 * rise, first_bulges)
    return Ruled(below, chain_outline(last + last_width / 2 * rise, last_bulges), low, high)


def _slab(points: Floats, share: Floats) -> tuple[Floats, float]:
    """Points (n, 2) of the thinnest slab at an end that has enough of them, and its share of the stretch."""
    width = next((width for width in SLABS if np.count_nonzero(share < width) >= FEWEST), SLABS[-1])
    slab = points[share < width]
    return slab[:: len(slab) // MOST_POINTS + 1], width


def _matched(below: Outline, above: Outline) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]] | None:
    """Vertices and bulges of two outlines, edge to edge."""
    first, last = (
        outline.chain() if isinstance(outline, ChainOutline) and not isinstance(outline, ROUND) else None
        for outline in (below, above)
    )
    if first is not None and last is not None and len(first[1]) != len(last[1]):
        first, last = (first, None) if len(first[1]) < len(last[1]) else (None, last)
    if first is None:
        if last is None:
            return None
        first = _arcs(below, last[0])
    elif last is None:
        last = _arcs(above, first[0])
    else:
        last = _turned(first, last)
    if not 3 <= len(first[1]) <= MOST_EDGES:
        return None
    return first, last


def _arcs(outline: Outline, corners: Floats) -> tuple[Floats, Floats]:
    """An outline as one arc for each direction between corners (m, 2)."""
    ring = outline.boundary(RING).points
    centre = ring.mean(axis=0)
    around = np.unwrap(np.angle((ring - centre) @ [1, 1j]))
    angles = np.angle((corners - corners.mean(axis=0)) @ [1, 1j])
    found = [int(np.argmin(np.abs(np.angle(np.exp(1j * (around - angle)))))) for angle in angles]
    vertices = ring[found]
    closed = [*found, found[0]]
    middles = [ring[(a + (b - a) % len(ring) // 2) % len(ring)] for a, b in pairwise(closed)]
    chord = chords(vertices)
    square = np.maximum((chord**2).sum(axis=1), 1e-12)
    rise = np.einsum("ij,ij->i", np.array(middles) - vertices - chord / 2, outward(chord))
    return vertices, np.clip(2 * rise / square, -0.9, 0.9)


def _turned(first: tuple[Floats, Floats], last: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    """The last chain, begun where it lies closest to the first."""
    spokes = [chain[0] - chain[0].mean(axis=0) for chain in (first, last)]
    gaps = [float(np.linalg.norm(spokes[0] - np.roll(spokes[1], -k, axis=0))) for k in range(len(first[1]))]
    k = int(np.argmin(gaps))
    return np.roll(last[0], -k, axis=0), np.roll(last[1], -k)
