"""Turning: the section that drifts, grows and turns from one end of a ruled wall to the other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.candidates import rectangle_of
from sketchloft.outline.outline import Outline
from sketchloft.outline.polygons import Polygon
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["turning"]

ALIKE = 0.1
"""How much two polygons differ at most, as a share of their size, that are taken for the same one."""


def turning(wall: Ruled) -> Iterator[Swept]:
    """Yield walls with one polygon all along, if those at both ends of a ruled wall are alike.

    Notes
    -----
    With vertices as complex numbers about their mean, the similarity from one polygon to the other is the
    factor that brings them together best.
    """
    (below, bulges), (above, more) = wall.bottom.chain(), wall.top.chain()
    if np.any(bulges) or np.any(more):
        return
    ends = below.mean(axis=0), above.mean(axis=0)
    first, last = ((chain - end) @ [1, 1j] for chain, end in zip((below, above), ends, strict=True))
    size = float(np.vdot(first, first).real)
    factor = complex(np.vdot(first, last) / size)
    growth = abs(factor)
    if np.linalg.norm(last - factor * first) > ALIKE * np.linalg.norm(last) or not growth:
        return
    rise, pivot = wall.high - wall.low, (ends[0] + ends[1]) / 2
    start = 2 / (1 + growth)  # so that the section half-way up is that of the wall
    middle = first / start * np.sqrt(factor / growth)
    vertices = pivot + np.column_stack([middle.real, middle.imag])
    for outline in _outlines(vertices):
        yield Swept(
            outline,
            (wall.low + wall.high) / 2,
            pivot,
            (ends[1] - ends[0]) / rise,
            (growth - 1) * start / rise,
            float(np.angle(factor)) / rise,
            ("drift", "taper", "twist"),
        )


def _outlines(vertices: Floats) -> Iterator[Outline]:
    if len(vertices) == 4:
        yield rectangle_of(vertices)
    yield Polygon(vertices)
