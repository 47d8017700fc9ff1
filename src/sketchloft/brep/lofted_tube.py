"""The face of a lofted wall: one B-spline."""

from __future__ import annotations

from sketchloft.brep.kernel import bspline_curve, bspline_surface
from sketchloft.brep.lofted_skin import lofted_skin
from sketchloft.brep.shell_parts import CurvePart
from sketchloft.brep.tube import Side, Tube, tube
from sketchloft.wall.lofted import Lofted

__all__ = ["lofted_tube"]


def lofted_tube(wall: Lofted, low: float, high: float) -> Tube:
    """Make the face of a lofted wall between two heights."""
    skin = lofted_skin(wall, low, high)
    bottom, top = (
        CurvePart(bspline_curve(row, None, skin.u_knots, skin.u_degree), 0.0, 1.0)
        for row in (skin.poles[0], skin.poles[-1])
    )
    post = CurvePart(bspline_curve(skin.poles[:, 0], None, skin.v_knots, skin.v_degree), low, high)
    return tube([Side(bspline_surface(skin), (0.0, 1.0), (low, high), bottom, top)], [post])
