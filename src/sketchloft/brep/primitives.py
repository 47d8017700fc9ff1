"""Primitives: the exact solid of a union of balls, frustums and prisms."""

from __future__ import annotations

from collections.abc import Sequence

from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
)
from OCP.gp import gp_Ax2, gp_Dir, gp_Vec
from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain
from OCP.TopoDS import TopoDS_Shape

from sketchloft.brep.check import check_closed
from sketchloft.brep.explore import solids_of
from sketchloft.brep.kernel import point
from sketchloft.brep.solid import Solid
from sketchloft.errors import ModelError
from sketchloft.sample.primitives import Ball, Frustum, Part, Prism

__all__ = ["fuse"]


def fuse(parts: Sequence[Part]) -> Solid:
    """Unite parts to one solid with exact faces.

    Parameters
    ----------
    parts : sequence of Ball, Frustum or Prism

    Returns
    -------
    Solid
        With spherical, cylindrical, conical and planar faces; faces on a common surface are one.

    Raises
    ------
    ModelError
        If there is no part, or the union is not one solid, as when parts lie apart.
    """
    if not parts:
        raise ModelError("there is no part to make a solid of; give at least one")
    shape = _shape(parts[0])
    for part in parts[1:]:
        shape = BRepAlgoAPI_Fuse(shape, _shape(part)).Shape()
    unified = ShapeUpgrade_UnifySameDomain(shape, True, True, False)
    unified.Build()
    solids = solids_of(unified.Shape())
    if len(solids) != 1:
        raise ModelError(f"the parts make {len(solids)} solids, expected one; let them overlap")
    solid = Solid(solids[0])
    check_closed(solid)
    return solid


def _shape(part: Part) -> TopoDS_Shape:
    match part:
        case Ball(centre, radius):
            return BRepPrimAPI_MakeSphere(point(centre), radius).Shape()
        case Frustum(centre, bottom, top, height):
            axes = gp_Ax2(point(centre), gp_Dir(0, 0, 1))
            if bottom == top:
                return BRepPrimAPI_MakeCylinder(axes, bottom, height).Shape()
            return BRepPrimAPI_MakeCone(axes, bottom, top, height).Shape()
        case Prism(outline, z0, height):
            polygon = BRepBuilderAPI_MakePolygon()
            for x, y in outline:
                polygon.Add(point((x, y, z0)))
            polygon.Close()
            base = BRepBuilderAPI_MakeFace(polygon.Wire()).Face()
            return BRepPrimAPI_MakePrism(base, gp_Vec(0, 0, height)).Shape()
