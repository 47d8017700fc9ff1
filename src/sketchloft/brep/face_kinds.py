"""The kind of every face of a solid."""

from __future__ import annotations

from OCP.BRep import BRep_Tool

from sketchloft.brep.explore import faces_of
from sketchloft.brep.solid import Solid

__all__ = ["face_kinds"]


def face_kinds(solid: Solid) -> tuple[str, ...]:
    """Kind of surface of each face, in the solid's order, by the names that `SolidFacts` uses."""
    surfaces = (BRep_Tool.Surface_s(face) for face in faces_of(solid.shape))
    return tuple(type(surface).__name__.removeprefix("Geom_") for surface in surfaces)
