"""The face of a lofted wall: one B-spline."""

from __future__ import annotations

import numpy as np

from sketchloft.brep.kernel import bspline_curve, bspline_surface
from sketchloft.brep.outline_curve import greville
from sketchloft.brep.shell_parts import CurvePart
from sketchloft.brep.tube import Side, Tube, tube
from sketchloft.surface import SkinSurface, basis_matrix
from sketchloft.wall.lofted import Lofted

__all__ = ["lofted_tube"]


def lofted_tube(wall: Lofted, low: float, high: float) -> Tube:
    """Make the face of a lofted wall between two heights.

    Notes
    -----
    The part of a spline between two heights is one on the knots between them, clamped at both, and a
    closed one opened at its seam is one on clamped knots: as many values as poles give it back exactly.
    Poles are at their Greville heights, so that z is linear in v.
    """
    p, count = wall.degree, wall.poles.shape[1]
    inner = wall.knots[(wall.knots > low + 1e-9) & (wall.knots < high - 1e-9)]
    v_knots = np.concatenate([np.full(p + 1, low), inner, np.full(p + 1, high)])
    u_knots = np.concatenate([np.zeros(p), np.arange(count + 1) / count, np.ones(p)])
    heights, around = greville(v_knots, p), greville(u_knots, p)
    along_inverse = np.linalg.inv(basis_matrix(v_knots, p, heights))
    around_inverse = np.linalg.inv(basis_matrix(u_knots, p, around))
    flat = np.einsum("mi,nj,ijd->mnd", along_inverse, around_inverse, wall.ring(heights, around))
    level = np.broadcast_to(heights[:, None, None], (*flat.shape[:2], 1))
    poles = np.concatenate([flat, level], axis=2)
    poles[:, -1] = poles[:, 0]
    surface = bspline_surface(SkinSurface(poles, u_knots, v_knots, p, p))
    bottom, top = (CurvePart(bspline_curve(row, None, u_knots, p), 0.0, 1.0) for row in (poles[0], poles[-1]))
    post = CurvePart(bspline_curve(poles[:, 0], None, v_knots, p), low, high)
    return tube([Side(surface, (0.0, 1.0), (low, high), bottom, top)], [post])
