"""Simpler chains: outlines of lines and arcs without one of their corners, or with a line for an arc."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.outline.polygons import LineArc, flattest

__all__ = ["simpler_chains"]

SLIGHT = 0.15
"""Bulge of an arc below which it may be a line."""
WIDEST = 1.4
"""Quarter of the sweep of an arc at most that two are joined to, in radians."""


def simpler_chains(outline: LineArc) -> Iterator[LineArc]:
    """Outlines with two arcs that turn the same way joined to one, without a flat corner, or a flat arc."""
    slight = outline.curved & (np.abs(outline.bulges) < SLIGHT)
    for k in np.flatnonzero(slight).tolist():
        line = np.arange(len(slight)) == k
        if (outline.curved & ~line).any():
            yield LineArc(outline.vertices, np.where(line, 0.0, outline.bulges), outline.curved & ~line)
    if len(outline.vertices) < 3:
        return
    quarters = np.arctan(outline.bulges)
    before = np.roll(quarters, 1)
    within = np.flatnonzero(quarters * before > 0)
    both = np.tan(np.clip(quarters + before, -WIDEST, WIDEST))
    for k in dict.fromkeys([*within.tolist(), *flattest(outline.vertices)]):
        bulges, curved = outline.bulges.copy(), np.delete(outline.curved, k)
        if k in within:
            bulges[k - 1] = both[k]
        if curved.any():
            yield LineArc(np.delete(outline.vertices, k, axis=0), np.delete(bulges, k), curved)
