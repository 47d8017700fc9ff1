"""The face of one revolved wall, with open ends."""

from __future__ import annotations

import numpy as np
from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Shape, TopoDS_Vertex

from sketchloft.brep.explore import faces_of
from sketchloft.brep.meridian import meridian
from sketchloft.brep.revolved_block import axis_at, half_plane_point, profile_edge
from sketchloft.brep.shell_parts import vertex
from sketchloft.brep.tube import Tube
from sketchloft.wall.revolved import Revolved

__all__ = ["revolved_tube"]


def revolved_tube(wall: Revolved, low: float, high: float, size: float) -> Tube:
    """Make the face of a revolved wall between two heights; where it comes down to the axis it has no rim."""
    (piece,) = meridian([wall.profile], np.array([low, high]), size)
    foot, head = (vertex(half_plane_point(at, wall.centre)) for at in (piece.start, piece.end))
    edge = profile_edge(piece, foot, head, wall.centre)
    turned = BRepPrimAPI_MakeRevol(edge, axis_at(wall.centre))
    face = faces_of(turned.Shape())[0]
    if edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
        face = TopoDS.Face(face.Reversed())
    bottom = _rim(turned, foot) if piece.start[0] else []
    top = _rim(turned, head) if piece.end[0] else []
    return Tube([face], bottom, top)


def _rim(turned: BRepPrimAPI_MakeRevol, corner: TopoDS_Vertex) -> list[TopoDS_Edge]:
    found: list[TopoDS_Shape] = list(turned.Generated(corner))
    return [TopoDS.Edge(found[0])]
