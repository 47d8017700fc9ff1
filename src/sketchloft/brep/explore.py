"""Walks over the parts of a kernel shape."""

from __future__ import annotations

from collections.abc import Iterator

from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import (
    TopoDS,
    TopoDS_Edge,
    TopoDS_Face,
    TopoDS_Shape,
    TopoDS_Shell,
    TopoDS_Solid,
    TopoDS_Vertex,
)

__all__ = ["edges_of", "faces_of", "shells_of", "solids_of", "vertices_of"]


def solids_of(shape: TopoDS_Shape) -> list[TopoDS_Solid]:
    """Solids in a shape, in its order."""
    return [TopoDS.Solid(part) for part in _parts(shape, TopAbs_ShapeEnum.TopAbs_SOLID)]


def shells_of(shape: TopoDS_Shape) -> list[TopoDS_Shell]:
    """Shells in a shape, in its order."""
    return [TopoDS.Shell(part) for part in _parts(shape, TopAbs_ShapeEnum.TopAbs_SHELL)]


def faces_of(shape: TopoDS_Shape) -> list[TopoDS_Face]:
    """Faces in a shape, in its order."""
    return [TopoDS.Face(part) for part in _parts(shape, TopAbs_ShapeEnum.TopAbs_FACE)]


def edges_of(shape: TopoDS_Shape) -> list[TopoDS_Edge]:
    """Edges in a shape, once for every use by a face, with the orientation of that use."""
    return [TopoDS.Edge(part) for part in _parts(shape, TopAbs_ShapeEnum.TopAbs_EDGE)]


def vertices_of(shape: TopoDS_Shape) -> list[TopoDS_Vertex]:
    """Vertices in a shape, once for every use."""
    return [TopoDS.Vertex(part) for part in _parts(shape, TopAbs_ShapeEnum.TopAbs_VERTEX)]


def _parts(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> Iterator[TopoDS_Shape]:
    walk = TopExp_Explorer(shape, kind)
    while walk.More():
        yield walk.Current()
        walk.Next()
