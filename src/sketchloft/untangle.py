"""Untangle: a loft whose skin does not cross itself between two sections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.edge_points import EdgePoints
from sketchloft.loft import LoftParams, Section, loft
from sketchloft.ring import ring_is_simple
from sketchloft.shapes.recognise import simpler
from sketchloft.surface import SkinSurface, evaluate

__all__ = ["untangled"]

AROUND = 768
"""Points around a section that show whether it is simple, as many as the check of the solid looks at."""
WITHIN = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
"""Where, from one section to the next, the skin is looked at."""


def untangled(
    sections: Sequence[Section], edges: Sequence[EdgePoints], params: LoftParams
) -> tuple[tuple[Section, ...], SkinSurface]:
    """Loft the sections, with plainer ones where rough ones tangle.

    Neighbouring splines that follow ragged contours closely can cross on the way from one to the other,
    though each of them is simple. Such a pair gets fewer control points, again and again; where that does
    not help, one of the two borrows the shape of the other.

    Parameters
    ----------
    sections : sequence of Section
    edges : sequence of EdgePoints
        What the sections were fitted to.
    params : LoftParams

    Returns
    -------
    tuple of Section
    SkinSurface
        Still tangled only where no section can be made any plainer.
    """
    kept = list(sections)
    heights = np.array([section.height for section in sections])
    while True:
        surface = loft(kept, params)
        gaps = _tangled(surface, heights)
        plainer = {
            i: shape
            for gap in gaps
            for i in (gap, gap + 1)
            if (shape := simpler(kept[i].shape, edges[i])) is not None
        }
        for i, shape in plainer.items():
            kept[i] = replace(kept[i], shape=shape)
        if not plainer and not _borrow(kept, gaps):
            return tuple(kept), surface


def _borrow(sections: list[Section], gaps: list[int]) -> bool:
    """Let one section at the first of these gaps take its neighbour's shape; each may do so once."""
    for gap in gaps:
        for i, other in ((gap + 1, gap), (gap, gap + 1)):
            if not sections[i].borrowed and sections[i].shape is not sections[other].shape:
                sections[i] = replace(sections[i], shape=sections[other].shape, borrowed=True)
                return True
    return False


def _tangled(surface: SkinSurface, heights: Floats) -> list[int]:
    """Gaps between sections in which a section crosses itself."""
    u = np.arange(AROUND) / AROUND
    ends = (heights - heights[0]) / (heights[-1] - heights[0])
    between = (ends[:-1, None] + np.diff(ends)[:, None] * WITHIN).ravel()
    simple = [ring_is_simple(ring[:, :2]) for ring in evaluate(surface, u, between)]
    return np.flatnonzero(~np.array(simple).reshape(-1, len(WITHIN)).all(axis=1)).tolist()
