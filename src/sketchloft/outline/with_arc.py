"""With an arc: outlines in which one arc stands for some edges of a polygon that turn the same way."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.chain import chords
from sketchloft.outline.polygons import LineArc

__all__ = ["with_an_arc"]

WINDOWS = ((2, 2.0), (3, 1.5), (3, 1.0))
"""How many edges an arc stands for, and its sweep, in what these turn: as chords of it, or around it."""
LEAST, MOST = 0.6, 4.0
"""Sweep of such an arc, in radians."""


def with_an_arc(vertices: Floats) -> Iterator[LineArc]:
    """Line-arc outlines of a polygon (m, 2) with two or three of its edges replaced by an arc.

    Notes
    -----
    Equal chords of an arc turn at the corners between them by all of its sweep but the part of one chord;
    edges around one, which touch it, by all of it.
    """
    count = len(vertices)
    along = chords(vertices)
    before = np.roll(along, 1, axis=0)
    turns = np.arctan2(
        before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0], np.einsum("ij,ij->i", before, along)
    )
    for edges, share in WINDOWS:
        for k in range(count if count > edges + 1 else 0):
            inner = (k + np.arange(1, edges)) % count
            sweep = share * float(turns[inner].sum())
            if abs(sweep) > LEAST and (np.sign(turns[inner]) == np.sign(sweep)).all():
                bulges = np.zeros(count)
                bulges[k] = np.tan(np.clip(sweep, -MOST, MOST) / 4)
                left = np.delete(bulges, inner)
                yield LineArc(np.delete(vertices, inner, axis=0), left, left != 0)
