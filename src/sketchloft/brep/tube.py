"""Tube: the faces of a wall between two heights, on edges that neighbours share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.collections import Array1_double, Array1_gp_Pnt2d, Array1_int
from OCP.Geom import Geom_Plane, Geom_Surface
from OCP.Geom2d import Geom2d_BSplineCurve, Geom2d_Curve, Geom2d_Line
from OCP.gp import gp_Dir2d, gp_Pnt2d
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face, TopoDS_Shape, TopoDS_Vertex

from sketchloft.brep.kernel import CONFUSION
from sketchloft.brep.shell_parts import CurvePart, edge, edge_against, point_edge, turned_around, vertex, wire

__all__ = ["Side", "Tube", "tube"]

_BUILD = BRep_Builder()


@dataclass(frozen=True)
class Side:
    """A face of a wall: a rectangle of the parameters of a surface, v rising.

    Parameters
    ----------
    surface : Geom_Surface
        On a plane `u` and `v` do not matter.
    u, v : (float, float)
        From and to.
    bottom, top : CurvePart or None
        In the sense of growing u; None where the face comes down to a point.
    ahead : bool
        Whether growing u goes around the wall counter-clockwise, seen from above.
    """

    surface: Geom_Surface
    u: tuple[float, float]
    v: tuple[float, float]
    bottom: CurvePart | None
    top: CurvePart | None
    ahead: bool = True


@dataclass(frozen=True)
class Tube:
    """A wall with open ends.

    Parameters
    ----------
    faces : list of TopoDS_Face
        Normals away from what the wall encloses.
    bottom, top : list of TopoDS_Edge
        Its rims, walked counter-clockwise seen from above; none where it comes down to a point.
    """

    faces: list[TopoDS_Face]
    bottom: list[TopoDS_Edge]
    top: list[TopoDS_Edge]


def tube(sides: Sequence[Side], uprights: Sequence[CurvePart]) -> Tube:
    """Make the faces of a wall.

    Parameters
    ----------
    sides : sequence of Side
        Counter-clockwise around.
    uprights : sequence of CurvePart
        Rising; number i is where side i begins and the one before it ends. A single side has a seam there.
    """
    count = len(sides)
    feet = _corners([_xyz(part, part.start) for part in uprights], sides[0].bottom is None)
    heads = _corners([_xyz(part, part.end) for part in uprights], sides[0].top is None)
    posts = [edge(part, foot, head) for part, foot, head in zip(uprights, feet, heads, strict=True)]
    faces, bottom, top = [], [], []
    for i, side in enumerate(sides):
        j = (i + 1) % count
        bottom.append(_rim(side, side.bottom, feet[i], feet[j]))
        top.append(_rim(side, side.top, heads[i], heads[j]))
        frame = _Frame(bottom[i], top[i], posts[i], posts[j])
        faces.append(_face(side, frame, (uprights[i], uprights[j])))
    return Tube(faces, *([rim for rim in rims if not BRep_Tool.Degenerated_s(rim)] for rims in (bottom, top)))


def _corners(points: Sequence[list[float]], is_tip: bool) -> list[TopoDS_Vertex]:
    return [vertex(points[0])] * len(points) if is_tip else [vertex(at) for at in points]


@dataclass(frozen=True)
class _Frame:
    bottom: TopoDS_Edge
    top: TopoDS_Edge
    left: TopoDS_Edge
    right: TopoDS_Edge


def _rim(side: Side, part: CurvePart | None, start: TopoDS_Vertex, end: TopoDS_Vertex) -> TopoDS_Edge:
    """Edge of a rim, walked counter-clockwise."""
    if part is None:
        tip = point_edge(start)
        return tip if side.ahead else TopoDS.Edge(tip.Reversed())
    return (edge if side.ahead else edge_against)(part, start, end)


def _face(side: Side, frame: _Frame, uprights: tuple[CurvePart, CurvePart]) -> TopoDS_Face:
    face = TopoDS_Face()
    _BUILD.MakeFace(face, side.surface, TopLoc_Location(), CONFUSION)
    loop: list[TopoDS_Shape] = [frame.bottom, frame.right, frame.top.Reversed(), frame.left.Reversed()]
    if isinstance(side.surface, Geom_Plane):
        loop = [part for part in loop if not BRep_Tool.Degenerated_s(TopoDS.Edge(part))]
    else:
        _draw(side, frame, uprights, face)
    if side.ahead:
        _BUILD.Add(face, wire(loop))
    else:
        _BUILD.Add(face, wire(turned_around(loop)))
        face.Reverse()
    return face


def _draw(side: Side, frame: _Frame, uprights: tuple[CurvePart, CurvePart], face: TopoDS_Face) -> None:
    """Give the edges their curves in the parameters of the surface."""
    (u0, u1), (v0, v1) = side.u, side.v
    left_u, right_u = (u0, u1) if side.ahead else (u1, u0)
    for rim, part, v in ((frame.bottom, side.bottom, v0), (frame.top, side.top, v1)):
        run = (u0, u1) if part is None else (part.start, part.end)
        _BUILD.UpdateEdge(rim, _straight((u0, v), (u1, v), run), face, CONFUSION)
        _BUILD.Range(rim, face, *run)
    left, right = ((part.start, part.end) for part in uprights)
    at_left = _straight((left_u, v0), (left_u, v1), left)
    at_right = _straight((right_u, v0), (right_u, v1), right)
    if frame.left.IsSame(frame.right):  # the seam: its forward use bounds the face on the right
        _BUILD.UpdateEdge(frame.left, at_right, at_left, face, CONFUSION)
    else:
        _BUILD.UpdateEdge(frame.left, at_left, face, CONFUSION)
        _BUILD.UpdateEdge(frame.right, at_right, face, CONFUSION)


def _straight(a: tuple[float, float], b: tuple[float, float], run: tuple[float, float]) -> Geom2d_Curve:
    """Straight line from a to b while its parameter runs from the one value to the other."""
    step = np.subtract(b, a)
    length = float(np.hypot(*step))
    if abs(length - (run[1] - run[0])) <= 1e-14 * length:
        along = step / length
        at = np.asarray(a) - run[0] * along
        return Geom2d_Line(gp_Pnt2d(*at.tolist()), gp_Dir2d(*along.tolist()))
    poles, knots, counts = Array1_gp_Pnt2d(1, 2), Array1_double(1, 2), Array1_int(1, 2)
    for i, (pole, knot) in enumerate(((a, run[0]), (b, run[1])), start=1):
        poles.SetValue(i, gp_Pnt2d(*pole))
        knots.SetValue(i, knot)
        counts.SetValue(i, 2)
    return Geom2d_BSplineCurve(poles, knots, counts, 1)


def _xyz(part: CurvePart, at: float) -> list[float]:
    found = part.curve.Value(at)
    return [found.X(), found.Y(), found.Z()]
