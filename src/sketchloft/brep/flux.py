"""Volume and area of a solid, from the surfaces that the kernel holds."""

from __future__ import annotations

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve2d
from OCP.BRepGProp import BRepGProp, BRepGProp_Domain, BRepGProp_Face, BRepGProp_Vinert
from OCP.BRepTools import BRepTools
from OCP.Geom import Geom_BSplineSurface, Geom_Plane, Geom_RectangularTrimmedSurface, Geom_SweptSurface
from OCP.GeomConvert import GeomConvert
from OCP.GProp import GProp_GProps
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

from sketchloft.brep.explore import edges_of, faces_of, vertices_of
from sketchloft.brep.kernel import point, skin_of
from sketchloft.cloud import Floats
from sketchloft.gauss import gauss_between
from sketchloft.surface import SkinSurface, distinct_knots, evaluate

__all__ = ["volume_and_area"]

SLACK = 1e-7
"""Distance of an edge from a side of the rectangle, as a share of it, up to which it is on that side."""
EPSILON = 1e-7
"""Relative error asked of the kernel's own integration; without one it can be off by a tenth."""


def volume_and_area(shape: TopoDS_Shape) -> tuple[float, float]:
    """Volume (negative when the normals point inwards) and surface area of a solid.

    Notes
    -----
    By the divergence theorem: a third of the flux of x through every face. B-spline faces, extrusions and
    surfaces of revolution that fill a rectangle of their parameters are integrated here, with Gauss points
    on every span, which is exact for polynomial ones; the kernel stalls at 1e-5 on them and takes half a
    second. Planes need their area only, and the kernel does well on the other elementary surfaces.
    """
    faces = faces_of(shape)
    origin = _centre(faces[0])
    parts = [_flux_and_area(face, origin) for face in faces]
    return sum(flux for flux, _ in parts) / 3, sum(area for _, area in parts)


def _flux_and_area(face: TopoDS_Face, origin: Floats) -> tuple[float, float]:
    surface = BRep_Tool.Surface_s(face)
    sign = 1 if face.Orientation() == TopAbs_Orientation.TopAbs_FORWARD else -1
    if isinstance(surface, Geom_Plane):
        plane = surface.Pln()
        normal, at = plane.Axis().Direction(), plane.Location()
        height = np.dot([normal.X(), normal.Y(), normal.Z()], [at.X(), at.Y(), at.Z()] - origin)
        area = _kernel_area(face)
        turned = 1 if plane.Direct() else -1  # of a left-handed system the axis is not the normal
        return sign * turned * float(height) * area, area
    if isinstance(surface, Geom_BSplineSurface | Geom_SweptSurface) and _fills_rectangle(face):
        flux, area = _skin_flux_and_area(_skin(face, surface), origin)
        return sign * flux, area
    cone = BRepGProp_Vinert(BRepGProp_Face(face), BRepGProp_Domain(face), point(origin), EPSILON)
    return 3 * cone.Mass(), _kernel_area(face)


def _skin(face: TopoDS_Face, surface: Geom_BSplineSurface | Geom_SweptSurface) -> SkinSurface:
    """The part of the surface that the face fills, as arrays."""
    found, whole = np.array(BRepTools.UVBounds_s(face)), np.array(surface.Bounds())
    if isinstance(surface, Geom_BSplineSurface) and np.allclose(found, whole, atol=SLACK):
        return skin_of(surface)
    for periodic, ends in ((surface.IsUPeriodic(), slice(0, 2)), (surface.IsVPeriodic(), slice(2, 4))):
        if not periodic:
            found[ends] = np.clip(found[ends], *whole[ends])
    part = Geom_RectangularTrimmedSurface(surface, *found.tolist())
    return skin_of(GeomConvert.SurfaceToBSplineSurface_s(part))


def _skin_flux_and_area(skin: SkinSurface, origin: Floats) -> tuple[float, float]:
    extra = 0 if skin.weights is None else 6
    u, u_weights = gauss_between(distinct_knots(skin.u_knots), (3 * skin.u_degree + 1) // 2 + extra)
    v, v_weights = gauss_between(distinct_knots(skin.v_knots), (3 * skin.v_degree + 1) // 2 + extra)
    around, along = evaluate(skin, u, v, u_derivative=1), evaluate(skin, u, v, v_derivative=1)
    normals = np.cross(around, along)
    fluxes = np.einsum("vuk,vuk->vu", evaluate(skin, u, v) - origin, normals)
    areas = np.linalg.norm(normals, axis=2)
    return float(v_weights @ fluxes @ u_weights), float(v_weights @ areas @ u_weights)


def _kernel_area(shape: TopoDS_Shape) -> float:
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, properties, EPSILON)
    return float(properties.Mass())


def _fills_rectangle(face: TopoDS_Face) -> bool:
    """Whether the face is a whole rectangle of its surface's parameters, with all edges on the sides."""
    u0, u1, v0, v1 = BRepTools.UVBounds_s(face)
    for edge in edges_of(face):
        curve = BRepAdaptor_Curve2d(edge, face)
        ends = curve.FirstParameter(), curve.LastParameter()
        at = [curve.Value(ends[0] + share * (ends[1] - ends[0])) for share in (0.0, 0.4, 1.0)]
        u, v = np.array([(p.X(), p.Y()) for p in at]).T
        sides = (u - u0, u - u1, v - v0, v - v1)
        if min(float(np.abs(side).max()) for side in sides) > SLACK * max(u1 - u0, v1 - v0):
            return False
    return True


def _centre(face: TopoDS_Face) -> Floats:
    """A point near the face, so that little is lost by cancellation far from the origin."""
    corner = BRep_Tool.Pnt_s(vertices_of(face)[0])
    return np.array([corner.X(), corner.Y(), corner.Z()])
