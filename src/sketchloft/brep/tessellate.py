"""Tessellation: a solid's surface as closed triangles."""

from __future__ import annotations

import math

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
from OCP.gp import gp_Trsf
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Face

from sketchloft.brep.explore import edges_of, faces_of
from sketchloft.brep.model import Fineness
from sketchloft.brep.solid import Solid
from sketchloft.cloud import Floats, Ints
from sketchloft.errors import ModelError
from sketchloft.mesh import Mesh

__all__ = ["tessellate", "tessellate_faces"]


def tessellate(solid: Solid, chord: float = Fineness.chord, angle: float = Fineness.angle) -> Mesh:
    """Approximate a solid by triangles.

    Parameters
    ----------
    solid : Solid
    chord : float
        Largest distance between surface and triangle, as a share of the diagonal of the solid's box.
    angle : float
        Largest angle, in radians, between the normals of the surface along an edge of the triangulation.

    Returns
    -------
    Mesh
        Closed: neighbouring triangles share vertices, across faces too.

    Raises
    ------
    ModelError
        If the kernel fails to triangulate a face, or the triangles do not close.
    """
    return tessellate_faces(solid, chord, angle)[0]


def tessellate_faces(
    solid: Solid, chord: float = Fineness.chord, angle: float = Fineness.angle
) -> tuple[Mesh, Ints]:
    """Like `tessellate`, with the face of each triangle.

    Returns
    -------
    Mesh
    (t,) int array
        Index of the face that each triangle lies on, in the solid's order of faces.
    """
    # The kernel hangs triangles on the shape and has an absolute least chord, so a copy of size 1 is used.
    box = Bnd_Box()
    BRepBndLib.Add_s(solid.shape, box)
    size = math.sqrt(box.SquareExtent())
    unit = gp_Trsf()
    unit.SetScaleFactor(1 / size)
    shape = BRepBuilderAPI_Transform(solid.shape, unit, True).Shape()
    BRepMesh_IncrementalMesh(shape, chord, False, angle, True)
    faces = faces_of(shape)
    pieces = [_triangles(face, i) for i, face in enumerate(faces)]
    sizes = np.array([len(nodes) for nodes, _ in pieces])
    starts = np.cumsum(sizes) - sizes
    vertex = _joined(int(sizes.sum()), _links(faces, starts))
    triangles = np.concatenate(
        [vertex[corners + start] for (_, corners), start in zip(pieces, starts, strict=True)]
    )
    face = np.repeat(np.arange(len(pieces)), [len(corners) for _, corners in pieces])
    a, b, c = triangles.T
    whole = (a != b) & (b != c) & (c != a)  # not those that shrink to an edge at the tip of a cone
    used, places = np.unique(triangles[whole], return_inverse=True)
    mesh = Mesh(size * np.concatenate([nodes for nodes, _ in pieces])[used], places.reshape(-1, 3))
    if not _is_closed(mesh.triangles):
        raise ModelError("the triangles of the solid leave gaps; use a finer chord")
    return mesh, face[whole]


def _triangles(face: TopoDS_Face, index: int) -> tuple[Floats, Ints]:
    location = TopLoc_Location()
    grid = BRep_Tool.Triangulation_s(face, location)
    if grid is None:
        raise ModelError(f"the CAD kernel cannot triangulate face {index} of the solid; use a finer chord")
    move = location.Transformation()
    nodes = [grid.Node(i).Transformed(move) for i in range(1, grid.NbNodes() + 1)]
    corners = [grid.Triangle(i).Get() for i in range(1, grid.NbTriangles() + 1)]
    triangles = np.array(corners, dtype=np.intp) - 1
    if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
        triangles = triangles[:, ::-1]
    return np.array([(node.X(), node.Y(), node.Z()) for node in nodes]), triangles


def _links(faces: list[TopoDS_Face], starts: Ints) -> Ints:
    """Pairs (k, 2) of nodes that are one: the points of an edge, as each of its faces numbers them."""
    index = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
    first_use: list[Ints] = []
    pairs: list[Ints] = []
    for face, start in zip(faces, starts.tolist(), strict=True):
        location = TopLoc_Location()
        grid = BRep_Tool.Triangulation_s(face, location)
        for edge in edges_of(face):
            numbers = BRep_Tool.PolygonOnTriangulation_s(edge, grid, location)
            nodes = np.array([numbers.Node(i) for i in range(1, numbers.NbNodes() + 1)]) - 1 + start
            at = index.Add(edge) - 1
            if at == len(first_use):
                first_use.append(nodes)
            if BRep_Tool.Degenerated_s(edge):
                pairs.append(np.stack([nodes[:-1], nodes[1:]], axis=1))
            pairs.append(np.stack([first_use[at], nodes], axis=1))
    return np.concatenate(pairs)


def _joined(count: int, pairs: Ints) -> Ints:
    """(count,) the lowest node that each node is linked with, over any number of links."""
    lowest = np.arange(count)
    while True:
        least = np.minimum(lowest[pairs[:, 0]], lowest[pairs[:, 1]])
        before = lowest.copy()
        np.minimum.at(lowest, pairs[:, 0], least)
        np.minimum.at(lowest, pairs[:, 1], least)
        if np.array_equal(before, lowest):
            return lowest


def _is_closed(triangles: Ints) -> bool:
    """Whether every edge is used as often in one direction as in the other."""
    n = int(triangles.max()) + 1
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    return bool(np.array_equal(np.sort(start * n + end), np.sort(end * n + start)))
