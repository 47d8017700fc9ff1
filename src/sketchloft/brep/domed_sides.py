"""The faces of a wall that closes like a dome: rational B-splines, exactly."""

from __future__ import annotations

import numpy as np

from sketchloft.brep.kernel import bspline_curve, bspline_surface
from sketchloft.brep.outline_curve import Nurbs, nurbs_of
from sketchloft.brep.shell_parts import CurvePart
from sketchloft.brep.tube import Side
from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface
from sketchloft.wall.swept import Swept

__all__ = ["domed_sides"]

QUARTER = np.pi / 2


def domed_sides(wall: Swept, low: float, high: float) -> tuple[list[Side], list[CurvePart]]:
    """Make the faces of a dome between two heights, and the curves between them.

    Notes
    -----
    The scale of the sections is an ellipse over the height, so that both are rational quadratics of one
    parameter; a face is the tensor product of these and of the outline's rational curve.
    """
    meridian = _meridian(wall, low, high)
    along = _weights(meridian)
    sides, posts = [], []
    for edge in wall.outline.edges():
        curve = nurbs_of(edge)
        around = _weights(curve)
        poles = _carried(wall, curve.poles, meridian.poles)
        weights = np.outer(along, around)
        skin = SkinSurface(poles, curve.knots, meridian.knots, curve.degree, meridian.degree, weights)
        u, v = ((float(knots[0]), float(knots[-1])) for knots in (curve.knots, meridian.knots))
        rims = [bspline_curve(poles[i], around, curve.knots, curve.degree) for i in (0, -1)]
        sides.append(Side(bspline_surface(skin), u, v, CurvePart(rims[0], *u), CurvePart(rims[1], *u)))
        post = bspline_curve(poles[:, 0], along, meridian.knots, meridian.degree)
        posts.append(CurvePart(post, *v))
    return sides, posts


def _weights(curve: Nurbs) -> Floats:
    return np.ones(len(curve.poles)) if curve.weights is None else curve.weights


def _meridian(wall: Swept, low: float, high: float) -> Nurbs:
    """Height and scale (k, 2) along the dome, as pieces of its ellipse of a quarter turn at most."""
    below, above = wall.tips()
    middle, radius = (below + above) / 2, (above - below) / 2
    half = float(wall.scale(np.array([middle]))[0])
    first, last = np.arcsin(np.clip((np.array([low, high]) - middle) / radius, -1, 1))
    pieces = int(np.ceil((last - first) / QUARTER - 1e-9))
    lean = (last - first) / (2 * pieces)
    angles = first + lean * np.arange(2 * pieces + 1)
    weights = np.where(np.arange(2 * pieces + 1) % 2, np.cos(lean), 1.0)
    poles = np.column_stack([middle + radius * np.sin(angles) / weights, half * np.cos(angles) / weights])
    # Poles between the pieces are where the tangents at their ends meet; the ends are exact.
    poles[[0, -1], 0] = low, high
    poles[[0, -1], 1] = wall.scale(np.array([low, high]))
    inner = np.repeat(np.arange(1.0, pieces), 2)
    knots = np.concatenate([np.zeros(3), inner, np.full(3, float(pieces))])
    return Nurbs(poles, weights, knots, 2)


def _carried(wall: Swept, outline: Floats, meridian: Floats) -> Floats:
    """Poles (m, k, 3) of the poles (k, 2) of the outline at heights and scales (m, 2)."""
    heights, scales = meridian.T
    arm = outline - wall.pivot
    shift = wall.pivot + (heights - wall.height)[:, None] * wall.drift
    flat = shift[:, None] + scales[:, None, None] * arm
    return np.concatenate([flat, np.broadcast_to(heights[:, None, None], (*flat.shape[:2], 1))], axis=2)
