"""Patches: a skin cut along its sharp edges, so that every face is smooth around."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface

__all__ = ["patches", "sharp_columns"]

SHARP = 0.01
"""Turn of the tangent, in radians, from which on a full knot counts as an edge."""


def sharp_columns(surface: SkinSurface) -> list[int]:
    """Columns of poles along which the skin has a sharp edge; 0 stands for the seam.

    Notes
    -----
    At a knot of full multiplicity the surface runs through the poles and is tangent to both legs of
    the control polygon there, so the angle between the legs is the turn. It is an edge where any row turns.
    """
    poles, degree = surface.poles, surface.u_degree
    counts = np.unique(surface.u_knots, return_counts=True)[1]
    # The column of the pole on a full knot: all knots up to it, less degree + 1 for the clamped start.
    columns = np.cumsum(counts)[:-1] - degree - 1
    full = columns[1:][counts[1:-1] >= degree]
    legs = np.diff(poles, axis=1)
    seam = [0] if _turns(legs[:, 0], legs[:, -1]) else []
    return seam + [column for column in full.tolist() if _turns(legs[:, column], legs[:, column - 1])]


def patches(surface: SkinSurface) -> list[SkinSurface]:
    """Cut the skin along its sharp edges.

    Returns
    -------
    list of SkinSurface
        In order around; the last column of each is the first of the next. A skin without edges comes
        back whole; its first and last columns are then its seam.
    """
    edges = sharp_columns(surface)
    if not edges:
        return [surface]
    turned = surface if edges[0] == 0 else _start_at(surface, edges[0])
    starts = [column - edges[0] for column in edges]
    ends = [*starts[1:], turned.poles.shape[1] - 1]
    return [_columns(turned, a, b) for a, b in zip(starts, ends, strict=True)]


def _turns(leaving: Floats, arriving: Floats) -> bool:
    sine = np.linalg.norm(np.cross(arriving, leaving), axis=1)
    cosine = np.einsum("ij,ij->i", arriving, leaving)
    return bool((np.arctan2(sine, cosine) > SHARP).any())


def _columns(surface: SkinSurface, start: int, end: int) -> SkinSurface:
    """Columns start..end of the poles, both of which lie on full knots (or at the ends)."""
    degree = surface.u_degree
    inner = surface.u_knots[start + degree + 1 : end + 1]
    first, last = surface.u_knots[start + degree], surface.u_knots[end + 1]
    knots = np.concatenate([np.full(degree + 1, first), inner[inner > first], np.full(degree + 1, last)])
    weights = None if surface.weights is None else surface.weights[:, start : end + 1]
    return replace(surface, poles=surface.poles[:, start : end + 1], u_knots=knots, weights=weights)


def _start_at(surface: SkinSurface, column: int) -> SkinSurface:
    """Let the skin start and end at another column, which lies on a full knot; the old seam becomes one."""
    degree = surface.u_degree
    first, second = _columns(surface, 0, column), _columns(surface, column, surface.poles.shape[1] - 1)
    period = surface.u_knots[-1] - surface.u_knots[0]
    knots = np.concatenate([second.u_knots[:-1], first.u_knots[degree + 1 :] + period])
    poles = np.concatenate([second.poles, first.poles[:, 1:]], axis=1)
    weights = None
    if first.weights is not None and second.weights is not None:
        weights = np.concatenate([second.weights, first.weights[:, 1:]], axis=1)
    return replace(surface, poles=poles, u_knots=knots, weights=weights)
