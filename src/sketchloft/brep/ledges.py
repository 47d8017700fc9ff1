"""Ledges: what is left open where one section stands upon another, and the edges that both share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from OCP.BOPTools import BOPTools_AlgoTools
from OCP.BRepAlgoAPI import BRepAlgoAPI_BuilderAlgo
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher, List_TopoDS_Shape
from OCP.IntTools import IntTools_Context
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face, TopoDS_Shape, TopoDS_Vertex

from sketchloft.brep.explore import edges_of, vertices_of

__all__ = ["Ledges", "ledges"]


@dataclass(frozen=True)
class Ledges:
    """What becomes of two sections at a break.

    Parameters
    ----------
    faces : list of TopoDS_Face
        What is left open, normals out of the solid: upwards where the lower section reaches farther.
    touching : bool
        Whether the sections overlap at all.
    edges : list of (TopoDS_Edge, list of TopoDS_Edge)
        Rims and what replaces them, in the sense of the rim.
    vertices : list of (TopoDS_Vertex, TopoDS_Vertex)
    """

    faces: list[TopoDS_Face]
    touching: bool
    edges: list[tuple[TopoDS_Edge, list[TopoDS_Edge]]]
    vertices: list[tuple[TopoDS_Vertex, TopoDS_Vertex]]


def ledges(below: Sequence[TopoDS_Face], above: Sequence[TopoDS_Face], fuzzy: float = 0.0) -> Ledges:
    """Overlay the section that ends at a break and the one that starts there.

    Parameters
    ----------
    below, above : sequence of TopoDS_Face
        Level faces at the same height: the top of the run below and the bottom of the one above.
    fuzzy : float
        Edges nearer to each other than this become one.

    Notes
    -----
    Only faces in one plane are cut with each other, never the walls, so that it is quick and sure.
    """
    overlay = BRepAlgoAPI_BuilderAlgo()
    overlay.SetArguments(_list([*below, *above]))
    overlay.SetFuzzyValue(fuzzy)
    overlay.Build()
    lower = [part for face in below for part in _images(overlay, face)]
    upper = [part for face in above for part in _images(overlay, face)]
    in_lower, in_upper = _index(lower), _index(upper)
    left = [part for part in lower if not in_upper.Contains(part)]
    left += [part for part in upper if not in_lower.Contains(part)]
    context = IntTools_Context()
    rims = _index([edge for face in (*below, *above) for edge in edges_of(face)])
    edges = []
    for i in range(1, rims.Extent() + 1):
        rim = TopoDS.Edge(rims.FindKey(i).Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        parts = _images(overlay, rim)
        if not (len(parts) == 1 and parts[0].IsSame(rim)):
            edges.append((rim, [_along(TopoDS.Edge(part), rim, context) for part in parts]))
    corners = _index([corner for face in (*below, *above) for corner in vertices_of(face)])
    vertices = []
    for i in range(1, corners.Extent() + 1):
        corner = corners.FindKey(i)
        (image,) = _images(overlay, corner)
        if not image.IsSame(corner):
            vertices.append((TopoDS.Vertex(corner), TopoDS.Vertex(image)))
    touching = len(left) < len(lower) + len(upper)
    return Ledges([TopoDS.Face(part) for part in left], touching, edges, vertices)


def _images(overlay: BRepAlgoAPI_BuilderAlgo, shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    """What a part of an argument has become; itself where nothing has changed."""
    return list(overlay.Modified(shape)) or [shape]


def _along(part: TopoDS_Edge, rim: TopoDS_Edge, context: IntTools_Context) -> TopoDS_Edge:
    """The part in the sense of the rim it is of."""
    part = TopoDS.Edge(part.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    if BOPTools_AlgoTools.IsSplitToReverse_s(part, rim, context, 0):
        return TopoDS.Edge(part.Reversed())
    return part


def _index(shapes: Sequence[TopoDS_Shape]) -> IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher:
    index = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
    for shape in shapes:
        index.Add(shape)
    return index


def _list(shapes: Sequence[TopoDS_Shape]) -> List_TopoDS_Shape:
    made = List_TopoDS_Shape()
    for shape in shapes:
        made.Append(shape)
    return made
