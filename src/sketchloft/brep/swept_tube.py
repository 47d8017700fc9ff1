"""The faces of a swept wall: planes, cylinders, cones and extrusions where they are, else B-splines."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from OCP.Geom import (
    Geom_ConicalSurface,
    Geom_CylindricalSurface,
    Geom_SurfaceOfLinearExtrusion,
)
from OCP.gp import gp_Ax3

from sketchloft.brep.domed_sides import domed_sides
from sketchloft.brep.greville import greville
from sketchloft.brep.kernel import UP, bspline_curve, bspline_surface, direction, point
from sketchloft.brep.outline_curve import Conic, Nurbs, conic_of, nurbs_of
from sketchloft.brep.plane_side import line_part, plane_side
from sketchloft.brep.shell_parts import CurvePart
from sketchloft.brep.tube import Side, Tube, tube
from sketchloft.cloud import Floats
from sketchloft.outline.outline import Arc, Closed, Edge, Segment
from sketchloft.surface import SkinSurface, basis_matrix, even_knots
from sketchloft.wall.swept import Swept

__all__ = ["swept_tube"]

MEET = 1e-6
"""Heights nearer to a tip than this are the tip."""
EXACT = 1e-9
"""Below this, in a solid about 1 across, a movement is none."""
TWIST_ERROR = 1e-6
"""Largest distance between a twisted wall and its B-spline."""


@dataclass(frozen=True)
class Motion:
    """What carries the outline along: at row i the point q goes to `turns[i] @ q + shifts[i]`.

    Parameters
    ----------
    heights : (m,) float array
    turns : (m, 2, 2) float array
    shifts : (m, 2) float array
    """

    heights: Floats
    turns: Floats
    shifts: Floats

    def of(self, points: Floats) -> Floats:
        """Points (m, k, 3) of points (k, 2) of the outline."""
        flat = np.einsum("mij,kj->mki", self.turns, points) + self.shifts[:, None]
        heights = np.broadcast_to(self.heights[:, None, None], (*flat.shape[:2], 1))
        return np.concatenate([flat, heights], axis=2)


def swept_tube(wall: Swept, low: float, high: float) -> Tube:
    """Make the faces of a swept wall between two heights."""
    edges = wall.outline.edges()
    low, high, tips = _span(wall, low, high)
    if wall.bows:
        sides, posts = domed_sides(wall, low, high)
        return tube([_without_tips(side, tips) for side in sides], posts)
    if wall.twist:
        return _twisted(wall, edges, (low, high), tips)
    ends = _motion(wall, np.array([low, high]))
    corners = ends.of(np.array([_start(edge) for edge in edges]))
    posts = [line_part(foot, head) for foot, head in zip(*corners, strict=True)]
    return tube([_without_tips(_side(edge, ends), tips) for edge in edges], posts)


def _span(wall: Swept, low: float, high: float) -> tuple[float, float, tuple[bool, bool]]:
    """Where the wall starts and ends, and whether it does so in its tip."""
    below, above = wall.tips()
    is_tip = below > low - MEET, above < high + MEET
    return (below if is_tip[0] else low), (above if is_tip[1] else high), is_tip


def _without_tips(side: Side, tips: tuple[bool, bool]) -> Side:
    """The side without those rims that are a point."""
    return replace(side, bottom=None if tips[0] else side.bottom, top=None if tips[1] else side.top)


def _motion(wall: Swept, heights: Floats) -> Motion:
    dz = heights - wall.height
    scale, angle = 1 + wall.taper * dz, wall.twist * dz
    cos, sin = scale * np.cos(angle), scale * np.sin(angle)
    turns = np.moveaxis(np.array([[cos, -sin], [sin, cos]]), 2, 0)
    return Motion(heights, turns, wall.pivot + dz[:, None] * wall.drift - turns @ wall.pivot)


def _start(edge: Edge) -> Floats:
    if not isinstance(edge, Closed):
        return edge.start
    return nurbs_of(edge).poles[0] if edge.kind == "spline" else conic_of(edge).start


def _side(edge: Edge, ends: Motion) -> Side:
    """The face of an edge that does not turn."""
    if isinstance(edge, Segment):
        return plane_side(*ends.of(np.array([edge.start, edge.end])))
    if isinstance(edge, Arc) or edge.kind != "spline":
        conics = [
            _carried(conic_of(edge), turn, shift) for turn, shift in zip(ends.turns, ends.shifts, strict=True)
        ]
        shift = conics[1].centre - conics[0].centre
        straight = bool(np.abs(shift).max() < EXACT)
        even = abs(conics[1].major - conics[0].major) < EXACT
        if even or (straight and conics[0].major == conics[0].minor):
            return _conic_side(conics[0], conics[1], ends.heights, straight=straight, even=even)
    if np.abs(ends.turns[1] - ends.turns[0]).max() < EXACT:
        return _extruded(nurbs_of(edge), ends)
    return _ruled(nurbs_of(edge), ends, np.repeat(ends.heights, 2), 1)


def _extruded(curve: Nurbs, ends: Motion) -> Side:
    """The extrusion of a curve; kernels draw it more evenly than a B-spline that is the same."""
    poles = ends.of(curve.poles)
    rims = [bspline_curve(row, curve.weights, curve.knots, curve.degree) for row in poles]
    along = poles[1, 0] - poles[0, 0]
    surface = Geom_SurfaceOfLinearExtrusion(rims[0], direction(along))
    u, v = _ends(curve.knots), (0.0, float(np.linalg.norm(along)))
    return Side(surface, u, v, CurvePart(rims[0], *u), CurvePart(rims[1], *u))


def _carried(conic: Conic, turn: Floats, shift: Floats) -> Conic:
    scale = float(turn[0, 0])
    return Conic(
        turn @ conic.centre + shift,
        scale * conic.major,
        scale * conic.minor,
        conic.x,
        conic.sweep,
        conic.ahead,
    )


def _conic_side(below: Conic, above: Conic, heights: Floats, *, straight: bool, even: bool) -> Side:
    """A cylinder, a right cone, or the extrusion of a circle or an ellipse."""
    low, high = heights.tolist()
    rise = high - low
    bottom, top = below.at(low), above.at(high)
    axes = gp_Ax3(point((*below.centre, low)), UP, direction((*below.x, 0.0)))
    surface: Geom_CylindricalSurface | Geom_ConicalSurface | Geom_SurfaceOfLinearExtrusion
    length = rise
    if not even:
        grown = above.major - below.major
        surface = Geom_ConicalSurface(axes, float(np.arctan2(grown, rise)), below.major)
        length = float(np.hypot(grown, rise))
    elif straight and below.major == below.minor:
        surface = Geom_CylindricalSurface(axes, below.major)
    else:
        along = np.array([*(above.centre - below.centre), rise])
        surface = Geom_SurfaceOfLinearExtrusion(bottom, direction(along))
        length = float(np.linalg.norm(along))
    u = (0.0, below.sweep)
    return Side(surface, u, (0.0, length), CurvePart(bottom, *u), CurvePart(top, *u), below.ahead)


def _ruled(curve: Nurbs, motion: Motion, knots: Floats, degree: int) -> Side:
    """A B-spline face; its rows of poles are those of the outline, carried along."""
    poles = motion.of(curve.poles)
    weights = None if curve.weights is None else np.broadcast_to(curve.weights, poles.shape[:2])
    skin = SkinSurface(poles, curve.knots, knots, curve.degree, degree, weights)
    u, v = (_ends(skin.u_knots), _ends(skin.v_knots))
    rims = [bspline_curve(poles[i], curve.weights, curve.knots, curve.degree) for i in (0, -1)]
    return Side(bspline_surface(skin), u, v, CurvePart(rims[0], *u), CurvePart(rims[1], *u))


def _twisted(
    wall: Swept, edges: tuple[Edge, ...], heights: tuple[float, float], tips: tuple[bool, bool]
) -> Tube:
    reach = float(np.linalg.norm(wall.outline.boundary(64).points - wall.pivot, axis=1).max())
    motion, knots = _twist(wall, *heights, reach)
    curves = [nurbs_of(edge) for edge in edges]
    corners = motion.of(np.array([curve.poles[0] for curve in curves]))
    posts = [CurvePart(bspline_curve(corners[:, i], None, knots, 3), *heights) for i in range(len(edges))]
    return tube([_without_tips(_ruled(curve, motion, knots, 3), tips) for curve in curves], posts)


def _twist(wall: Swept, low: float, high: float, reach: float) -> tuple[Motion, Floats]:
    """Cubic splines of the movement along z, with as few spans as `TWIST_ERROR` allows."""
    fine = np.linspace(low, high, 257)
    exact = _motion(wall, fine)
    for spans in range(1, 200):
        knots = even_knots(low, high, spans)
        sites = greville(knots, 3)
        at = _motion(wall, sites)
        inverse = np.linalg.inv(basis_matrix(knots, 3, sites))
        turns = np.einsum("mn,nij->mij", inverse, at.turns)
        error = np.einsum("mn,nij->mij", basis_matrix(knots, 3, fine), turns) - exact.turns
        if np.abs(error).max() * reach * 2 <= TWIST_ERROR:
            break
    return Motion(sites, turns, inverse @ at.shifts), knots


def _ends(knots: Floats) -> tuple[float, float]:
    return float(knots[0]), float(knots[-1])
