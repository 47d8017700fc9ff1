"""The vertices and edges of the pieces that rims are cut into."""

from __future__ import annotations

from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopExp import TopExp
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Vertex

from sketchloft.brep.explore import vertices_of
from sketchloft.brep.kernel import CONFUSION
from sketchloft.brep.overlay import Overlay, Piece
from sketchloft.brep.section_rims import Rim, Section
from sketchloft.brep.shell_parts import vertex

__all__ = ["Corners", "corners_of", "edge_of", "widen"]

_BUILD = BRep_Builder()
Corners = dict[int, TopoDS_Vertex]


def corners_of(
    cut: Overlay, lower: Section, upper: Section, height: float
) -> tuple[Corners, list[tuple[TopoDS_Vertex, TopoDS_Vertex]]]:
    """The vertex at every node, and the vertices that others take the place of."""
    found: Corners = {}
    replaced = []
    for section, pieces in ((lower, cut.below), (upper, cut.above)):
        for piece in pieces:
            rim = section.rims[piece.rim]
            for node, is_own, corner in (
                (piece.nodes[0], piece.start == rim.curve.start, TopExp.FirstVertex_s(rim.edge)),
                (piece.nodes[1], piece.end == rim.curve.end, TopExp.LastVertex_s(rim.edge)),
            ):
                own = TopoDS.Vertex(corner.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
                if is_own and not found.setdefault(node, own).IsSame(own):
                    replaced.append((own, found[node]))
                    gap = BRep_Tool.Pnt_s(own).Distance(BRep_Tool.Pnt_s(found[node]))
                    _BUILD.UpdateVertex(found[node], max(CONFUSION, 1.1 * gap))
    for node, (x, y) in enumerate(cut.nodes.tolist()):
        if node not in found:
            found[node] = vertex((x, y, height))
    return found, replaced


def edge_of(rim: Rim, piece: Piece, corners: Corners) -> TopoDS_Edge:
    """The edge of a piece; that of the rim itself where it is the whole of it."""
    start, end = (corners[node] for node in piece.nodes)
    whole = piece.start == rim.curve.start and piece.end == rim.curve.end
    if whole and start.IsSame(TopExp.FirstVertex_s(rim.edge)) and end.IsSame(TopExp.LastVertex_s(rim.edge)):
        return rim.edge
    made = TopoDS.Edge(rim.edge.EmptyCopied())
    _BUILD.Add(made, start.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    _BUILD.Add(made, end.Oriented(TopAbs_Orientation.TopAbs_REVERSED))
    _BUILD.Range(made, piece.start, piece.end)
    for corner, at in ((start, piece.start), (end, piece.end)):
        gap = BRep_Tool.Pnt_s(corner).Distance(BRepAdaptor_Curve(rim.edge).Value(at))
        _BUILD.UpdateVertex(corner, max(CONFUSION, 1.1 * gap))
    return made


def widen(edge: TopoDS_Edge, away: float) -> None:
    """Let an edge and its ends count for all that is so far from it."""
    if away > CONFUSION / 2:
        _BUILD.UpdateEdge(edge, 1.5 * away)
        for corner in vertices_of(edge):
            _BUILD.UpdateVertex(corner, 1.6 * away)
