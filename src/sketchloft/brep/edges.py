"""The vertices and edges that the faces of a loft share."""

from __future__ import annotations

from dataclasses import dataclass

from OCP.BRep import BRep_Builder
from OCP.Geom import Geom_Curve
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS_Edge, TopoDS_Vertex

from sketchloft.brep.kernel import CONFUSION, bspline_curve, point
from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface

__all__ = ["LoftEdges", "loft_edges"]

_BUILD = BRep_Builder()


@dataclass(frozen=True)
class LoftEdges:
    """Edges of a loft, one of each per patch.

    Parameters
    ----------
    bottom, top : list of TopoDS_Edge
        Along the first and the last section of each patch, in the sense of growing u.
    along : list of TopoDS_Edge
        Along the first column of each patch, from bottom to top.
    """

    bottom: list[TopoDS_Edge]
    top: list[TopoDS_Edge]
    along: list[TopoDS_Edge]


def loft_edges(sides: list[SkinSurface]) -> LoftEdges:
    """Make the edges around and between patches that follow each other around the loft."""
    feet = [_vertex(side.poles[0, 0]) for side in sides]
    heads = [_vertex(side.poles[-1, 0]) for side in sides]
    bottom, top, along = [], [], []
    for i, side in enumerate(sides):
        following = (i + 1) % len(sides)
        bottom.append(_edge(_section(side, 0), side.u_knots, feet[i], feet[following]))
        top.append(_edge(_section(side, -1), side.u_knots, heads[i], heads[following]))
        along.append(_edge(_first_column(side), side.v_knots, feet[i], heads[i]))
    return LoftEdges(bottom, top, along)


def _section(side: SkinSurface, row: int) -> Geom_Curve:
    weights = None if side.weights is None else side.weights[row]
    return bspline_curve(side.poles[row], weights, side.u_knots, side.u_degree)


def _first_column(side: SkinSurface) -> Geom_Curve:
    weights = None if side.weights is None else side.weights[:, 0]
    return bspline_curve(side.poles[:, 0], weights, side.v_knots, side.v_degree)


def _vertex(xyz: Floats) -> TopoDS_Vertex:
    vertex = TopoDS_Vertex()
    _BUILD.MakeVertex(vertex, point(xyz), CONFUSION)
    return vertex


def _edge(curve: Geom_Curve, knots: Floats, start: TopoDS_Vertex, end: TopoDS_Vertex) -> TopoDS_Edge:
    edge = TopoDS_Edge()
    _BUILD.MakeEdge(edge, curve, CONFUSION)
    _BUILD.Add(edge, start.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    _BUILD.Add(edge, end.Oriented(TopAbs_Orientation.TopAbs_REVERSED))
    _BUILD.Range(edge, float(knots[0]), float(knots[-1]))
    return edge
