"""The fields of every kind of wall."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.outline.polygons import chain_outline
from sketchloft.plan.field import Choice, Fitted, Number, Quantity
from sketchloft.plan.form import Form, form
from sketchloft.plan.numbers import Shape
from sketchloft.plan.outlines import CENTRE, OUTLINES, RADIUS, SIDES
from sketchloft.ring import ring_area
from sketchloft.stack import Wall
from sketchloft.wall.filleted import ENDS, Filleted
from sketchloft.wall.lofted import Lofted, lofted
from sketchloft.wall.profile import ArcProfile, LineProfile, Profile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import MOVEMENTS, Freedom, Swept

__all__ = ["FORMS", "kind_of"]

AT = Number("height", "height", fitted="no")
"""The height that other numbers hold at; no parameter."""
HEIGHT = Number("height", "height")
KNOTS = Number("knots", "knots", shape=(None,), fitted="no", least=8)
MOVES = (
    Number("drift", "drift", "ratio", (2,), required=False),
    Number("taper", "taper", "per length", required=False),
    Number("twist", "twist", "angle per length", required=False),
    Number("bow", "bow", "per length", required=False),
)
_CHAIN: tuple[tuple[str, Quantity, Shape, Fitted], ...] = (
    ("vertices", "length", (None, 2), "each"),
    ("bulges", "ratio", (None,), "curved"),
)
PLACE = (
    Number("height", "height", fitted="no", required=False),
    Number("pivot", "pivot", shape=(2,), fitted="no", required=False),
)


def _revolved(described: Form) -> Form:
    """Put the centre before the fields of a profile."""

    def make(values: dict[str, Any]) -> Revolved:
        return Revolved(values["centre"], described.make(values))

    def read(wall: Revolved) -> dict[str, Any]:
        return {"centre": wall.centre, **described.read(wall.profile)}

    return Form((CENTRE, *described.fields), read, make)


def _cylinder(radius: float) -> Profile:
    return LineProfile(0.0, radius, None)


def _cone(radius: float, height: float, slope: float | None = None) -> Profile:
    return LineProfile(height, radius, slope)


def _sphere(height: float, radius: float) -> Profile:
    return ArcProfile(height, None, radius)


def _spline(knots: Floats, radii: Floats) -> Profile:
    _check_knots(knots, len(radii), "radii")
    return SplineProfile(knots, radii)


def _loft(poles: Floats, knots: Floats) -> Lofted:
    _check_knots(knots, len(poles), "rings of poles")
    for ring in poles:
        _check_turn(ring, "poles")
    return lofted(poles, knots)


def _swept(described: Form) -> Form:
    """Put the movement along the heights behind the fields of an outline."""

    def make(values: dict[str, Any]) -> Swept:
        outline = described.make(values)
        ring = outline.boundary(64)
        _check_turn(ring.points, "points")
        free: tuple[Freedom, ...] = tuple(f for f in MOVEMENTS if f in values)
        moves: dict[str, Any] = {name: values[name] for name in free}
        if "bow" in moves and (moves["bow"] <= abs(moves.get("taper", 0.0)) or "twist" in moves):
            raise ValueError(
                "found a bow beside a twist or a larger taper, expected a bow above the taper, and no twist"
            )
        centroid = ring.lengths @ ring.points / ring.lengths.sum()
        pivot, drift = values.get("pivot", centroid), moves.pop("drift", np.zeros(2))
        wall = Swept(outline, values.get("height", 0.0), pivot, drift, **moves, free=free)
        return wall if "pivot" in values else wall.about_centre()

    def read(wall: Swept) -> dict[str, Any]:
        outline: Outline = wall.outline
        found: dict[str, Any] = {f: getattr(wall, f) for f in MOVEMENTS}
        moves = {f: value for f, value in found.items() if f in wall.free or np.any(value)}
        turned = bool(moves.keys() - {"drift"}) and not wall.centred
        place = {"height": wall.height if moves else None, "pivot": wall.pivot if turned else None}
        return {**described.read(outline), **place, **moves}

    return Form((*described.fields, *PLACE, *MOVES), read, make)


def _check_turn(ring: Floats, what: str) -> None:
    if ring_area(ring) <= 0:
        raise ValueError(f"found {what} that run clockwise, or enclose nothing; list them counter-clockwise")


def _check_knots(knots: Floats, count: int, what: str) -> None:
    if len(knots) != count + 4:
        raise ValueError(f"found {len(knots)} knots and {count} {what}, expected 4 knots more than {what}")
    clamped = (knots[:4] == knots[0]).all() and (knots[-4:] == knots[-1]).all()
    if not clamped or (np.diff(knots[3:-3]) <= 0).any():
        raise ValueError("found knots that do not rise, expected the first and the last one four times each")


def _ruled() -> Form:
    """Two outlines of as many edges, each its vertices and bulges."""
    fields = [
        Number(f"{end}_{name}", "", quantity, shape, fitted, least=3)
        for end in ("bottom", "top")
        for name, quantity, shape, fitted in _CHAIN
    ]

    def make(values: dict[str, Any]) -> Ruled:
        ends = [(values[f"{end}_vertices"], values[f"{end}_bulges"]) for end in ("bottom", "top")]
        if len({len(part) for end in ends for part in end}) > 1:
            raise ValueError(
                "found outlines of different numbers of vertices and bulges, expected as many each"
            )
        for vertices, _ in ends:
            _check_turn(vertices, "vertices")
        below, above = (chain_outline(*end) for end in ends)
        return Ruled(below, above)

    def read(wall: Ruled) -> dict[str, Any]:
        ends = {"bottom": wall.bottom.chain(), "top": wall.top.chain()}
        return {f"{e}_{n}": end[k] for e, end in ends.items() for k, n in enumerate(("vertices", "bulges"))}

    return Form(tuple(fields), read, make)


def _square_and_round(*, up: bool) -> Form:
    """A rectangle and a circle of four arcs, the circle above or below."""
    square = form(Rectangle, replace(CENTRE, name="square_centre"), *SIDES[1:])
    circle = form(
        DividedCircle,
        replace(CENTRE, name="round_centre"),
        RADIUS,
        Number("first_cut", "angle", "angle"),
        Number("stagger", "stagger", "angle"),
    )
    return _from_to(*((square, circle) if up else (circle, square)))


def _between_rectangles() -> Form:
    """Two rectangles."""
    low, high = (
        form(Rectangle, *(replace(side, name=f"{end}_{side.name}") for side in SIDES))
        for end in ("bottom", "top")
    )
    return _from_to(low, high)


def _from_to(below: Form, above: Form) -> Form:
    """A ruled wall between two outlines of other keys."""

    def make(values: dict[str, Any]) -> Ruled:
        return Ruled(below.make(values), above.make(values))

    def read(wall: Ruled) -> dict[str, Any]:
        return {**below.read(wall.bottom), **above.read(wall.top)}

    return Form((*below.fields, *above.fields), read, make)


def _filleted() -> Form:
    """A rectangle, its corners sharp or rounded as the edges of the ends are."""
    fields = (
        *SIDES,
        Number("fillet", "fillet", sign="positive"),
        Choice("corners", "corners", {"round": True, "sharp": False}),
        Choice("ends", "ends", {end: end for end in ENDS}),
    )

    def make(values: dict[str, Any]) -> Filleted:
        sides = (values["centre"], values["width"], values["depth"], values["angle"])
        fillet, ends = values["fillet"], values.get("ends", ENDS[0])
        if values.get("corners", True):
            return Filleted(RoundedRectangle(*sides, fillet), None, ends)
        return Filleted(Rectangle(*sides), fillet, ends)

    def read(wall: Filleted) -> dict[str, Any]:
        sides = {name: getattr(wall.outline, name) for name in ("centre", "width", "height", "angle")}
        return {
            **{field.name: sides[field.attribute] for field in SIDES},
            "fillet": wall.radius,
            "corners": wall.fillet is None,
            "ends": wall.ends,
        }

    return Form(fields, read, make)


FORMS: dict[str, Form] = {
    "cylinder": _revolved(form(_cylinder, RADIUS)),
    "cone": _revolved(form(_cone, RADIUS, Number("slope", "slope", "ratio", required=False), AT)),
    "sphere": _revolved(form(_sphere, HEIGHT, RADIUS)),
    "torus": _revolved(
        form(
            ArcProfile,
            HEIGHT,
            Number("minor_radius", "radius", sign="positive"),
            Number("major_radius", "offset"),
            Choice("side", "side", {"outer": 1, "inner": -1}),
        )
    ),
    "spline revolve": _revolved(form(_spline, KNOTS, Number("radii", "radii", shape=(None,), least=4))),
    "filleted prism": _filleted(),
    "ruled": _ruled(),
    "square to round": _square_and_round(up=True),
    "round to square": _square_and_round(up=False),
    "rectangle to rectangle": _between_rectangles(),
    "loft": form(_loft, KNOTS, Number("poles", "poles", shape=(None, None, 2), fitted="across", least=4)),
    **{kind: _swept(outline) for kind, outline in OUTLINES.items()},
}
"""By the wall's kind; a swept wall's is that of its outline."""


def kind_of(wall: Wall) -> str:
    """Key of `FORMS` for a wall."""
    if isinstance(wall, Ruled):
        ends = type(wall.bottom), type(wall.top)
        return {
            (Rectangle, DividedCircle): "square to round",
            (DividedCircle, Rectangle): "round to square",
            (Rectangle, Rectangle): "rectangle to rectangle",
        }.get(ends, wall.kind)
    return wall.outline.kind if isinstance(wall, Swept) else wall.kind
