"""Wall colour: that of the faces which a wall makes."""

from __future__ import annotations

from sketchloft.report.palette import FACES
from sketchloft.stack import Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

__all__ = ["wall_colour"]

REVOLVED = {
    "cylinder": "CylindricalSurface",
    "cone": "ConicalSurface",
    "sphere": "SphericalSurface",
    "torus": "ToroidalSurface",
    "spline revolve": "SurfaceOfRevolution",
}
CURVED = {"ellipse", "spline", "line-arc"}


def wall_colour(wall: Wall) -> str:
    """Colour of the faces that make up most of a wall."""
    if isinstance(wall, Revolved):
        return FACES[REVOLVED[wall.kind]]
    if isinstance(wall, Filleted):
        return FACES["Plane"]
    if not isinstance(wall, Swept) or wall.twist or wall.bows:
        return FACES["BSplineSurface"]
    if wall.outline.kind == "circle":
        return FACES["ConicalSurface" if wall.taper else "CylindricalSurface"]
    if wall.outline.kind in CURVED:
        return FACES["BSplineSurface" if wall.taper else "SurfaceOfLinearExtrusion"]
    return FACES["Plane"]
