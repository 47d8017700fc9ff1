"""The skin of a lofted wall between two heights. Plain numpy."""

from __future__ import annotations

import numpy as np

from sketchloft.brep.greville import greville
from sketchloft.surface import SkinSurface, basis_matrix, even_knots
from sketchloft.wall.lofted import Lofted

__all__ = ["lofted_skin"]

EXACT = 1e-9
"""A knot nearer to an end than this, in a solid about 1 across, is that end."""


def lofted_skin(wall: Lofted, low: float, high: float) -> SkinSurface:
    """Cut a wall to two heights, and open it at its seam.

    Parameters
    ----------
    wall : Lofted
    low, high : float
        Within its knots.

    Returns
    -------
    SkinSurface
        The same surface, u as in `wall` and v the height.

    Notes
    -----
    The part of a spline between two heights is one on the knots between them, clamped at both, and a
    closed one opened at its seam is one on clamped knots: as many values as poles give it back exactly.
    Poles are at their Greville heights, so that z is linear in v.
    """
    p = wall.degree
    inner = wall.knots[(wall.knots > low + EXACT) & (wall.knots < high - EXACT)]
    v_knots = np.concatenate([np.full(p + 1, low), inner, np.full(p + 1, high)])
    u_knots = even_knots(0.0, 1.0, wall.poles.shape[1])
    heights, around = greville(v_knots, p), greville(u_knots, p)
    along_inverse = np.linalg.inv(basis_matrix(v_knots, p, heights))
    around_inverse = np.linalg.inv(basis_matrix(u_knots, p, around))
    flat = np.einsum("mi,nj,ijd->mnd", along_inverse, around_inverse, wall.ring(heights, around))
    level = np.broadcast_to(heights[:, None, None], (*flat.shape[:2], 1))
    poles = np.concatenate([flat, level], axis=2)
    poles[:, -1] = poles[:, 0]
    return SkinSurface(poles, u_knots, v_knots, p, p)
