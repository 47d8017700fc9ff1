"""The bounding box of a solid."""

from __future__ import annotations

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.Geom import Geom_BSplineSurface, Geom_Plane
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

from sketchloft.brep.explore import faces_of, vertices_of
from sketchloft.brep.kernel import skin_of
from sketchloft.brep.sections import subdivided
from sketchloft.cloud import Floats
from sketchloft.surface import distinct_knots, evaluate

__all__ = ["bounds_of"]

PER_SPAN = 8
"""Points per knot span that a B-spline surface is sampled at."""


def bounds_of(shape: TopoDS_Shape) -> Floats:
    """Lower and upper corner (2, 3) of the box around a solid.

    Notes
    -----
    B-spline faces are sampled: for 40 poles around, the box misses less than 1e-4 of the size. The
    kernel's own box takes seconds there; it serves for the other faces, and is wider by 1e-7. Of planes the
    corners are enough, since their curved edges are edges of other faces too.
    """
    points = np.concatenate([_extremes(face) for face in faces_of(shape)])
    return np.stack([points.min(axis=0), points.max(axis=0)])


def _extremes(face: TopoDS_Face) -> Floats:
    """Points (n, 3) that reach as far as the face does, or corners of its box."""
    surface = BRep_Tool.Surface_s(face)
    if isinstance(surface, Geom_BSplineSurface):
        skin = skin_of(surface)
        u = subdivided(distinct_knots(skin.u_knots), PER_SPAN)
        v = subdivided(distinct_knots(skin.v_knots), PER_SPAN if skin.v_degree > 1 else 1)
        return evaluate(skin, u, v).reshape(-1, 3)
    if isinstance(surface, Geom_Plane):
        corners = [BRep_Tool.Pnt_s(corner) for corner in vertices_of(face)]
        return np.array([(corner.X(), corner.Y(), corner.Z()) for corner in corners]).reshape(-1, 3)
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(face, box, False, False)
    return np.array([[c.X(), c.Y(), c.Z()] for c in (box.CornerMin(), box.CornerMax())])
