"""The faces of coaxial revolved walls: one closed profile turned about its axis."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol, BRepPrimAPI_MakeTorus
from OCP.Convert import Convert_ParameterisationType
from OCP.Geom import Geom_Circle, Geom_Line, Geom_Plane, Geom_TrimmedCurve
from OCP.GeomConvert import GeomConvert
from OCP.gp import gp_Ax1, gp_Ax2, gp_Ax3, gp_Dir
from OCP.TopoDS import TopoDS_Edge, TopoDS_Face, TopoDS_Vertex

from sketchloft.brep.block import Block
from sketchloft.brep.explore import faces_of
from sketchloft.brep.greville import greville
from sketchloft.brep.kernel import CONFUSION, bspline_curve, direction, point
from sketchloft.brep.meridian import Piece, Straight
from sketchloft.brep.shell_parts import CurvePart, edge, edge_against, planar_face, vertex
from sketchloft.cloud import Floats
from sketchloft.wall.profile import ArcProfile, SplineProfile
from sketchloft.wall.torus import Torus

__all__ = ["axis_at", "half_plane_point", "profile_edge", "revolved_block", "torus_block"]


def revolved_block(outer: Sequence[Piece], inner: Sequence[Piece], centre: Floats) -> Block:
    """Turn the area between an outer and an inner profile about an axis along z.

    Parameters
    ----------
    outer, inner : sequence of Piece
        Rising between the same two heights; the inner one on the axis where there is no hole.
    centre : (2,) float array
        Where the axis is.

    Notes
    -----
    Lines make cylinders, cones and, where they are level, planes; arcs make spheres and tori.
    """
    pieces = _closed([*outer, *(piece.reversed() for piece in reversed(inner))])
    corners = [vertex(half_plane_point(piece.start, centre)) for piece in pieces]
    ends = [*corners[1:], corners[0]]
    edges = [profile_edge(*parts, centre) for parts in zip(pieces, corners, ends, strict=True)]
    plane = Geom_Plane(gp_Ax3(point((*centre, 0)), gp_Dir(0, -1, 0), gp_Dir(1, 0, 0)))
    turned = BRepPrimAPI_MakeRevol(planar_face(plane, [edges]), axis_at(centre)).Shape()
    low, high = float(outer[0].start[1]), float(outer[-1].end[1])
    block = Block([], [], [])
    for face in faces_of(turned):
        level = _level(face, (low, high))
        (block.walls if level is None else block.bottom if level == low else block.top).append(face)
    return block


def torus_block(torus: Torus) -> Block:
    """The one face of a torus."""
    axes = gp_Ax3(point((*torus.centre, torus.height)), gp_Dir(0, 0, 1))
    return Block(faces_of(BRepPrimAPI_MakeTorus(axes.Ax2(), torus.offset, torus.radius).Shape()), [], [])


def _level(face: TopoDS_Face, heights: tuple[float, float]) -> float | None:
    """At which of the heights a face is level; None for other faces."""
    surface = BRep_Tool.Surface_s(face)
    if not isinstance(surface, Geom_Plane):
        return None
    z = surface.Location().Z()
    return next((height for height in heights if abs(z - height) < CONFUSION), None)


def profile_edge(piece: Piece, start: TopoDS_Vertex, end: TopoDS_Vertex, centre: Floats) -> TopoDS_Edge:
    """Edge of a piece in the half plane x >= 0, y = 0 at the axis, from its start to its end."""
    part = _curve(piece, centre)
    if part.start > part.end:
        return edge_against(CurvePart(part.curve, part.end, part.start), start, end)
    return edge(part, start, end)


def _closed(pieces: list[Piece]) -> list[Piece]:
    """Close the gaps between pieces with straight ones: ledges and caps."""
    whole: list[Piece] = []
    for piece, following in pairwise([*pieces, pieces[0]]):
        whole.append(piece)
        if not np.array_equal(piece.end, following.start):
            whole.append(Piece(Straight(), piece.end, following.start))
    return whole


def axis_at(centre: Floats) -> gp_Ax1:
    """The axis at a centre, upwards."""
    return gp_Ax1(point((*centre, 0)), gp_Dir(0, 0, 1))


def half_plane_point(radius_height: Floats, centre: Floats) -> Floats:
    """Point (3,) of a radius and a height."""
    return np.array([centre[0] + radius_height[0], centre[1], radius_height[1]])


def _curve(piece: Piece, centre: Floats) -> CurvePart:
    match piece.profile:
        case ArcProfile(height, offset, radius, side):
            middle = np.array([offset or 0.0, height])
            # Against the side that the arc bulges to, its angles are within a quarter of a turn from pi.
            spokes = -side * (np.array([piece.start, piece.end]) - middle)
            angles = np.mod(np.arctan2(spokes[:, 1], spokes[:, 0]), 2 * np.pi)
            axes = gp_Ax2(point(half_plane_point(middle, centre)), gp_Dir(0, -1, 0), gp_Dir(-side, 0, 0))
            first, last = angles.tolist()
            circle = Geom_Circle(axes, radius)
            if offset is None or offset >= radius:
                return CurvePart(circle, first, last)
            # The whole torus would cut itself; as a free curve files keep the part of it that is meant.
            spline = GeomConvert.CurveToBSplineCurve_s(
                Geom_TrimmedCurve(circle, min(first, last), max(first, last)),
                Convert_ParameterisationType.Convert_QuasiAngular,
            )
            ends = spline.FirstParameter(), spline.LastParameter()
            return CurvePart(spline, *(ends if first < last else ends[::-1]))
        case SplineProfile(knots, radii):
            p = SplineProfile.degree
            profile = np.column_stack([radii, greville(knots, p)])
            poles = np.array([half_plane_point(pole, centre) for pole in profile])
            curve = bspline_curve(poles, None, knots, p)
            return CurvePart(curve, float(piece.start[1]), float(piece.end[1]))
    a, b = half_plane_point(piece.start, centre), half_plane_point(piece.end, centre)
    return CurvePart(Geom_Line(point(a), direction(b - a)), 0.0, float(np.linalg.norm(b - a)))
