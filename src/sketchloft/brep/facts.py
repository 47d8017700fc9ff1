"""SolidFacts: what a solid consists of, counted and measured."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from OCP.BRep import BRep_Tool
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS_Shape

from sketchloft.brep.bounds import bounds_of
from sketchloft.brep.explore import edges_of, faces_of
from sketchloft.brep.flux import volume_and_area
from sketchloft.brep.solid import Solid
from sketchloft.cloud import Floats

__all__ = ["SolidFacts", "edge_uses", "solid_facts"]


@dataclass(frozen=True)
class SolidFacts:
    """What a solid consists of.

    Parameters
    ----------
    faces : dict of str to int
        Number of faces by kind of surface: "BSplineSurface", "Plane", "CylindricalSurface", ...
    edges : int
        Number of edges, a shared one counted once.
    volume, area : float
        In the unit of the coordinates, cubed and squared; the volume is negative when the faces
        point inwards.
    bounds : (2, 3) float array
        Lower and upper corner of the bounding box, see `bounds_of` for how exact it is.
    """

    faces: dict[str, int]
    edges: int
    volume: float
    area: float
    bounds: Floats


def solid_facts(solid: Solid) -> SolidFacts:
    """Count and measure the parts of a solid."""
    surfaces = [BRep_Tool.Surface_s(face) for face in faces_of(solid.shape)]
    kinds = Counter(type(surface).__name__.removeprefix("Geom_") for surface in surfaces)
    volume, area = volume_and_area(solid.shape)
    return SolidFacts(
        dict(sorted(kinds.items())), len(edge_uses(solid.shape)), volume, area, bounds_of(solid.shape)
    )


def edge_uses(shape: TopoDS_Shape) -> list[tuple[int, int]]:
    """How often each edge is used forward and reversed; edges shrunk to a point are left out."""
    index = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
    uses: list[tuple[int, int]] = []
    for edge in edges_of(shape):
        if BRep_Tool.Degenerated_s(edge):
            continue
        at = index.Add(edge) - 1
        if at == len(uses):
            uses.append((0, 0))
        forward = edge.Orientation() == TopAbs_Orientation.TopAbs_FORWARD
        uses[at] = (uses[at][0] + forward, uses[at][1] + (not forward))
    return uses
