"""The fields of every kind of outline."""

from __future__ import annotations

from sketchloft.cloud import Floats
from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import spline_loop
from sketchloft.outline.stadium import Stadium
from sketchloft.outline.star import Star
from sketchloft.plan.field import Number
from sketchloft.plan.form import Form, form

__all__ = ["CENTRE", "OUTLINES", "RADIUS", "SIDES"]

CENTRE = Number("centre", "centre", shape=(2,))
RADIUS = Number("radius", "radius", sign="positive")
ANGLE = Number("angle", "angle", "angle")
SIDES = (
    CENTRE,
    Number("width", "width", sign="positive"),
    Number("depth", "height", sign="positive"),
    ANGLE,
)
CORNER_RADIUS = Number("corner_radius", "radius", sign="not negative")
VERTICES = Number("vertices", "vertices", shape=(None, 2), least=3)


def _line_arc(vertices: Floats, bulges: Floats) -> LineArc:
    if len(vertices) != len(bulges):
        raise ValueError(
            f"found {len(vertices)} vertices and {len(bulges)} bulges, expected one bulge for each vertex"
        )
    return LineArc(vertices, bulges, bulges != 0)


def _rectilinear(offsets: Floats, angle: float) -> RectilinearPolygon:
    if len(offsets) % 2:
        raise ValueError(f"found {len(offsets)} offsets, expected an even number, as edges turn by a quarter")
    return RectilinearPolygon(offsets, angle)


OUTLINES: dict[str, Form] = {
    "circle": form(Circle, CENTRE, RADIUS),
    "ellipse": form(
        Ellipse,
        CENTRE,
        Number("major_radius", "major", sign="positive"),
        Number("minor_radius", "minor", sign="positive"),
        ANGLE,
    ),
    "rectangle": form(Rectangle, *SIDES),
    "rounded rectangle": form(RoundedRectangle, *SIDES, CORNER_RADIUS),
    "stadium": form(Stadium, CENTRE, Number("length", "length", sign="positive"), RADIUS, ANGLE),
    "regular polygon": form(
        RegularPolygon, CENTRE, RADIUS, ANGLE, Number("sides", "sides", "count", fitted="no", least=3)
    ),
    "star": form(
        Star,
        CENTRE,
        RADIUS,
        Number("inner_radius", "inner_radius", sign="positive"),
        ANGLE,
        Number("tips", "tips", "count", fitted="no", least=3),
    ),
    "rectilinear polygon": form(_rectilinear, Number("offsets", "offsets", shape=(None,), least=4), ANGLE),
    "polygon": form(Polygon, VERTICES),
    "rounded polygon": form(RoundedPolygon, VERTICES, CORNER_RADIUS),
    "line-arc": form(
        _line_arc,
        Number("vertices", "vertices", shape=(None, 2), least=2),
        Number("bulges", "bulges", "ratio", shape=(None,), fitted="curved"),
    ),
    "spline": form(spline_loop, Number("poles", "poles", shape=(None, 2), fitted="across", least=4)),
}
"""By the outline's kind."""
