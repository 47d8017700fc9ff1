"""Joining the blocks of a stack, one upon another, to one solid."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from OCP.BOPTools import BOPTools_AlgoTools2D
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepLib import BRepLib
from OCP.BRepTools import BRepTools_ReShape
from OCP.Geom import Geom_Plane
from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain
from OCP.TopoDS import TopoDS_Compound, TopoDS_Face, TopoDS_Shape, TopoDS_Solid

from sketchloft.brep.block import Block
from sketchloft.brep.explore import edges_of, faces_of, solids_of
from sketchloft.brep.ledges import Ledges, ledges
from sketchloft.brep.shell_parts import solid_of

__all__ = ["joined"]

_BUILD = BRep_Builder()


def joined(blocks: Sequence[Block], tolerance: float = 1e-6) -> TopoDS_Solid:
    """Join blocks to a solid; neighbouring faces on a common surface become one.

    Parameters
    ----------
    blocks : sequence of Block
        From the lowest to the highest.
    tolerance : float
        Distance up to which rims of neighbouring blocks are taken for one.
    """
    walls = [face for block in blocks for face in block.walls]
    closing = [*blocks[0].bottom, *blocks[-1].top]
    if len(blocks) == 1:
        return solid_of([*walls, *closing])
    seams = [
        ledges(below.top, above.bottom, tolerance)
        for below, above in pairwise(blocks)
        if below.top and above.bottom
    ]
    closing += [face for below, above in pairwise(blocks) if not above.bottom for face in below.top]
    closing += [face for below, above in pairwise(blocks) if not below.top for face in above.bottom]
    ledge_faces = [face for seam in seams for face in seam.faces]
    faces = _with_shared_edges([*walls, *closing], seams)
    unify = ShapeUpgrade_UnifySameDomain(solid_of([*faces, *ledge_faces]), True, True, False)
    unify.Build()
    return solids_of(unify.Shape())[0]


def _with_shared_edges(faces: Sequence[TopoDS_Face], seams: Sequence[Ledges]) -> list[TopoDS_Face]:
    """The faces with rims replaced by what they were cut into or share with other rims."""
    reshape = BRepTools_ReShape()
    for seam in seams:
        for corner, image in seam.vertices:
            reshape.Replace(corner, image)
        for rim, parts in seam.edges:
            reshape.Replace(rim, parts[0] if len(parts) == 1 else _compound(parts))
    whole = faces_of(reshape.Apply(_compound(faces)))
    for face in whole:
        if isinstance(BRep_Tool.Surface_s(face), Geom_Plane):
            continue
        for edge in edges_of(face):
            if not BOPTools_AlgoTools2D.HasCurveOnSurface_s(edge, face):
                BOPTools_AlgoTools2D.BuildPCurveForEdgeOnFace_s(edge, face)
                BRepLib.SameParameter_s(edge, 1e-7)
    return whole


def _compound(shapes: Sequence[TopoDS_Shape]) -> TopoDS_Compound:
    made = TopoDS_Compound()
    _BUILD.MakeCompound(made)
    for shape in shapes:
        _BUILD.Add(made, shape)
    return made
