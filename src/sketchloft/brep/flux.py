"""Volume and area of a solid, from the surfaces that the kernel holds."""

from __future__ import annotations

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.Geom import Geom_BSplineSurface, Geom_Plane
from OCP.GProp import GProp_GProps
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

from sketchloft.brep.explore import edges_of, faces_of, vertices_of
from sketchloft.brep.kernel import skin_of
from sketchloft.brep.sections import gauss_points
from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface, evaluate

__all__ = ["volume_and_area"]

EPSILON = 1e-7
"""Relative error asked of the kernel's own integration; without one it can be off by a tenth."""


def volume_and_area(shape: TopoDS_Shape) -> tuple[float, float]:
    """Volume (negative when the normals point inwards) and surface area of a solid.

    Notes
    -----
    By the divergence theorem: a third of the flux of x through every face. Planes and B-spline faces
    that fill their whole surface are integrated here, with Gauss points on every span, which is exact for
    polynomial ones; the kernel stalls at 1e-5 on them and takes half a second. A solid with any other
    face is left to the kernel.
    """
    faces = faces_of(shape)
    origin = _centre(faces[0])
    parts = [_flux_and_area(face, origin) for face in faces]
    known = [part for part in parts if part is not None]
    if len(known) == len(parts):
        return sum(flux for flux, _ in known) / 3, sum(area for _, area in known)
    whole = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, whole, EPSILON)
    return whole.Mass(), _kernel_area(shape)


def _flux_and_area(face: TopoDS_Face, origin: Floats) -> tuple[float, float] | None:
    surface = BRep_Tool.Surface_s(face)
    sign = 1 if face.Orientation() == TopAbs_Orientation.TopAbs_FORWARD else -1
    if isinstance(surface, Geom_Plane):
        plane = surface.Pln()
        normal, at = plane.Axis().Direction(), plane.Location()
        height = np.dot([normal.X(), normal.Y(), normal.Z()], [at.X(), at.Y(), at.Z()] - origin)
        area = _kernel_area(face)
        return sign * float(height) * area, area
    if isinstance(surface, Geom_BSplineSurface) and _fills(face, surface):
        flux, area = _skin_flux_and_area(skin_of(surface), origin)
        return sign * flux, area
    return None


def _skin_flux_and_area(skin: SkinSurface, origin: Floats) -> tuple[float, float]:
    extra = 0 if skin.weights is None else 4
    u, u_weights = gauss_points(skin.u_knots, (3 * skin.u_degree + 1) // 2 + extra)
    v, v_weights = gauss_points(skin.v_knots, (3 * skin.v_degree + 1) // 2)
    around, along = evaluate(skin, u, v, u_derivative=1), evaluate(skin, u, v, v_derivative=1)
    normals = np.cross(around, along)
    fluxes = np.einsum("vuk,vuk->vu", evaluate(skin, u, v) - origin, normals)
    areas = np.linalg.norm(normals, axis=2)
    return float(v_weights @ fluxes @ u_weights), float(v_weights @ areas @ u_weights)


def _kernel_area(shape: TopoDS_Shape) -> float:
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, properties, EPSILON)
    return float(properties.Mass())


def _fills(face: TopoDS_Face, surface: Geom_BSplineSurface) -> bool:
    """Whether the face is the whole rectangle of parameters of its surface."""
    return len(edges_of(face)) == 4 and np.allclose(BRepTools.UVBounds_s(face), surface.Bounds(), atol=1e-9)


def _centre(face: TopoDS_Face) -> Floats:
    """A point near the face, so that little is lost by cancellation far from the origin."""
    corner = BRep_Tool.Pnt_s(vertices_of(face)[0])
    return np.array([corner.X(), corner.Y(), corner.Z()])
