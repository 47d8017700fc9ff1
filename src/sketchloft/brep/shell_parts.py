"""Vertices, edges, wires, planar faces and solids, put together of parts that are shared, not sewn."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from numpy.typing import ArrayLike
from OCP.BRep import BRep_Builder
from OCP.Geom import Geom_Curve, Geom_Plane
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import (
    TopoDS,
    TopoDS_Edge,
    TopoDS_Face,
    TopoDS_Shape,
    TopoDS_Shell,
    TopoDS_Solid,
    TopoDS_Vertex,
    TopoDS_Wire,
)

from sketchloft.brep.kernel import CONFUSION, point

__all__ = [
    "CurvePart",
    "edge",
    "edge_against",
    "planar_face",
    "point_edge",
    "solid_of",
    "turned_around",
    "vertex",
    "wire",
]

_BUILD = BRep_Builder()


@dataclass(frozen=True)
class CurvePart:
    """A curve from one parameter to another."""

    curve: Geom_Curve
    start: float
    end: float


def vertex(xyz: ArrayLike) -> TopoDS_Vertex:
    """Make a vertex at a point (3,)."""
    made = TopoDS_Vertex()
    _BUILD.MakeVertex(made, point(xyz), CONFUSION)
    return made


def edge(part: CurvePart, start: TopoDS_Vertex, end: TopoDS_Vertex) -> TopoDS_Edge:
    """Make an edge in the sense of its curve; the vertices are where the part starts and ends."""
    made = TopoDS_Edge()
    _BUILD.MakeEdge(made, part.curve, CONFUSION)
    _BUILD.Add(made, start.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    _BUILD.Add(made, end.Oriented(TopAbs_Orientation.TopAbs_REVERSED))
    _BUILD.Range(made, part.start, part.end)
    return made


def edge_against(part: CurvePart, start: TopoDS_Vertex, end: TopoDS_Vertex) -> TopoDS_Edge:
    """Make an edge against the sense of its curve, from where the part ends to where it starts."""
    return TopoDS.Edge(edge(part, end, start).Reversed())


def point_edge(at: TopoDS_Vertex) -> TopoDS_Edge:
    """Make an edge that has shrunk to a vertex, to bound a face in its parameters."""
    made = TopoDS_Edge()
    _BUILD.MakeEdge(made)
    _BUILD.Add(made, at.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    _BUILD.Add(made, at.Oriented(TopAbs_Orientation.TopAbs_REVERSED))
    _BUILD.Degenerated(made, True)
    return made


def wire(edges: Iterable[TopoDS_Shape]) -> TopoDS_Wire:
    """Make a closed wire of edges in its sense."""
    made = TopoDS_Wire()
    _BUILD.MakeWire(made)
    for part in edges:
        _BUILD.Add(made, part)
    made.Closed(True)
    return made


def turned_around(edges: Sequence[TopoDS_Shape]) -> list[TopoDS_Shape]:
    """The same closed path, walked the other way."""
    return [part.Reversed() for part in reversed(edges)]


def planar_face(plane: Geom_Plane, loops: Iterable[Sequence[TopoDS_Shape]]) -> TopoDS_Face:
    """Make the face that loops bound, the outer one counter-clockwise about the normal, holes clockwise."""
    made = TopoDS_Face()
    _BUILD.MakeFace(made, plane, TopLoc_Location(), CONFUSION)
    for loop in loops:
        _BUILD.Add(made, wire(loop))
    return made


def solid_of(faces: Iterable[TopoDS_Shape]) -> TopoDS_Solid:
    """Make a solid of faces with outward normals that share all their edges."""
    shell = TopoDS_Shell()
    _BUILD.MakeShell(shell)
    for face in faces:
        _BUILD.Add(shell, face)
    shell.Closed(True)
    made = TopoDS_Solid()
    _BUILD.MakeSolid(made)
    _BUILD.Add(made, shell)
    return made
