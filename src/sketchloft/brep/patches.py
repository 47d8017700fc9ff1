"""Patches: where a skin is cut so that every face of the solid is smooth."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface

__all__ = ["PatchGrid", "cut", "part", "sharp_columns", "sharp_rows"]

SHARP = 0.01
"""Turn of the tangent, in radians, from which on a full knot counts as an edge."""


@dataclass(frozen=True)
class PatchGrid:
    """A skin and the lines along which it is cut.

    Parameters
    ----------
    skin : SkinSurface
        Starts around at its first sharp edge, if it has any.
    rows : list of int
        Rows of poles that bound the bands, from the first section to the last.
    columns : list of list of int
        For each band the columns of poles that bound its patches, from the first to the last. In a
        band without edges these two alone, which are its seam.
    """

    skin: SkinSurface
    rows: list[int]
    columns: list[list[int]]


def cut(surface: SkinSurface) -> PatchGrid:
    """Cut a skin along its sharp edges, across and along.

    Notes
    -----
    Straight lofting leaves a kink at every section where the wall changes its slope. Other CAD systems do
    not take faces with kinks, and this one takes minutes to triangulate them: 900 s for 100 rough
    sections as one face against 2 s in bands. Sections along a straight wall stay in one face.
    """
    edges = sharp_columns(surface)
    skin = _start_at(surface, edges[0]) if edges and edges[0] else surface
    n_along, n_around = skin.poles.shape[:2]
    rows = [0, *sharp_rows(skin), n_along - 1]
    bands = [part(skin, (a, b), (0, n_around - 1)) for a, b in pairwise(rows)]
    return PatchGrid(skin, rows, [sorted({0, *sharp_columns(band), n_around - 1}) for band in bands])


def sharp_columns(surface: SkinSurface) -> list[int]:
    """Columns of poles along which a closed skin has a sharp edge; 0 stands for its seam.

    Notes
    -----
    At a knot of full multiplicity the surface runs through the poles and is tangent to both legs of
    the control polygon there, so the angle between the legs is the turn. It is an edge where any row turns.
    """
    legs = np.diff(surface.poles, axis=1)
    seam = [0] if _turns(legs[:, 0], legs[:, -1]) else []
    full = _full_knots(surface.u_knots, surface.u_degree)
    return seam + [column for column in full if _turns(legs[:, column], legs[:, column - 1])]


def sharp_rows(surface: SkinSurface) -> list[int]:
    """Rows of poles along which a skin has a sharp edge around, its two ends left out."""
    legs = np.diff(surface.poles, axis=0)
    full = _full_knots(surface.v_knots, surface.v_degree)
    return [row for row in full if _turns(legs[row], legs[row - 1])]


def part(surface: SkinSurface, rows: tuple[int, int], columns: tuple[int, int]) -> SkinSurface:
    """Part of a skin from row to row and from column to column of its poles, all on full knots or ends."""
    block = (slice(rows[0], rows[1] + 1), slice(columns[0], columns[1] + 1))
    return replace(
        surface,
        poles=surface.poles[block],
        weights=None if surface.weights is None else surface.weights[block],
        u_knots=_knots_between(surface.u_knots, surface.u_degree, *columns),
        v_knots=_knots_between(surface.v_knots, surface.v_degree, *rows),
    )


def _full_knots(knots: Floats, degree: int) -> list[int]:
    """Indices of the poles on inner knots of full multiplicity."""
    counts = np.unique(knots, return_counts=True)[1]
    on = np.cumsum(counts)[:-1] - degree - 1
    return [int(index) for index in on[1:][counts[1:-1] >= degree]]


def _turns(leaving: Floats, arriving: Floats) -> bool:
    sine = np.linalg.norm(np.cross(arriving, leaving), axis=1)
    cosine = np.einsum("ij,ij->i", arriving, leaving)
    return bool((np.arctan2(sine, cosine) > SHARP).any())


def _knots_between(knots: Floats, degree: int, start: int, end: int) -> Floats:
    """Clamped knots of poles start..end."""
    first, last = knots[start + degree], knots[end + 1]
    inner = knots[start + degree + 1 : end + 1]
    inner = inner[(inner > first) & (inner < last)]
    return np.concatenate([np.full(degree + 1, first), inner, np.full(degree + 1, last)])


def _start_at(surface: SkinSurface, column: int) -> SkinSurface:
    """Let the skin start and end at another column, which lies on a full knot; the old seam becomes one."""
    degree, rows = surface.u_degree, (0, len(surface.poles) - 1)
    first = part(surface, rows, (0, column))
    second = part(surface, rows, (column, surface.poles.shape[1] - 1))
    period = surface.u_knots[-1] - surface.u_knots[0]
    knots = np.concatenate([second.u_knots[:-1], first.u_knots[degree + 1 :] + period])
    poles = np.concatenate([second.poles, first.poles[:, 1:]], axis=1)
    weights = None
    if first.weights is not None and second.weights is not None:
        weights = np.concatenate([second.weights, first.weights[:, 1:]], axis=1)
    return replace(surface, poles=poles, u_knots=knots, weights=weights)
