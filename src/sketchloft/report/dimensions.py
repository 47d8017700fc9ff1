"""Dimensions: what a draughtsman would write beside a wall."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from sketchloft.outline.circle import Circle
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.stadium import Stadium
from sketchloft.outline.star import Star
from sketchloft.stack import Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import ArcProfile, LineProfile
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

__all__ = ["Dimension", "dimensions"]

Measure = Literal["length", "area", "angle", "ratio", "count"]
ALONG = np.linspace(0.0, 1.0, 65)


@dataclass(frozen=True)
class Dimension:
    """One dimension of a wall.

    Parameters
    ----------
    name : str
    value : float
        In the unit of the stack; angles in radians.
    measure : {"length", "area", "angle", "ratio", "count"}
    period : float
        Angles that differ by this are the same; 0 if none are.
    """

    name: str
    value: float
    measure: Measure = "length"
    period: float = 0.0


def dimensions(wall: Wall, low: float, high: float) -> tuple[Dimension, ...]:
    """Dimensions of a wall between two heights; always the same ones for walls of one kind.

    Sizes of an outline that tapers are those at the lower end. Angles of outlines are about z, from x.
    """
    match wall:
        case Revolved():
            return _revolved(wall, low, high)
        case Swept():
            size = float(wall.scale(np.array([low]))[0])
            return (*_outline(wall.outline, size, wall.twist * (low - wall.height)), *_moves(wall, low, high))
        case Ruled():
            return _ruled(wall, low, high)
        case Filleted():
            fillet = () if wall.fillet is None else (Dimension("fillets at the ends", wall.fillet),)
            return (*_outline(wall.outline, 1.0, 0.0), *fillet)
        case Lofted():
            ends = wall.area(np.array([low, high])).tolist()
            along, around = (
                Dimension(name, count, "count")
                for name, count in zip(("poles along", "around"), wall.poles.shape, strict=False)
            )
            return (
                Dimension("area below", ends[0], "area"),
                Dimension("above", ends[1], "area"),
                along,
                around,
            )


def _revolved(wall: Revolved, low: float, high: float) -> tuple[Dimension, ...]:
    match wall.profile:
        case LineProfile(_, radius, slope) if slope is None:
            return (Dimension("radius", radius),)
        case LineProfile(_, _, slope):
            below, above = radius_at(wall.profile, np.array([low, high]))[0].tolist()
            angle = float(np.arctan(abs(slope or 0.0)))
            return (
                Dimension("radius below", below),
                Dimension("radius above", above),
                Dimension("half angle", angle, "angle"),
            )
        case ArcProfile(_, offset, radius) if offset is None:
            return (Dimension("radius", radius),)
        case ArcProfile(_, offset, radius, side):
            return (
                Dimension("radius of the ring", abs(offset or 0.0)),
                Dimension("radius of the tube" if side > 0 else "radius of the groove", radius),
            )
        case _:
            radii = radius_at(wall.profile, low + (high - low) * ALONG)[0]
            named = {
                "radius below": radii[0],
                "above": radii[-1],
                "least": radii.min(),
                "largest": radii.max(),
            }
            found = tuple(Dimension(name, float(radius)) for name, radius in named.items())
            return (*found, _count("poles", len(wall.profile.radii)))


def _ruled(wall: Ruled, low: float, high: float) -> tuple[Dimension, ...]:
    match wall.bottom, wall.top:
        case (Rectangle() as one, DividedCircle() as other) | (DividedCircle() as one, Rectangle() as other):
            return (*_outline(one, 1.0, 0.0), *_outline(other, 1.0, 0.0))
        case (Rectangle() as one, Rectangle() as other):
            return tuple(
                replace(found, name=f"{found.name} {end}")
                for end, outline in (("below", one), ("above", other))
                for found in _outline(outline, 1.0, 0.0)
            )
    below, above = wall.area(np.array([low, high])).tolist()
    return (
        _count("edges", len(wall.bottom.chain()[1])),
        Dimension("area below", below, "area"),
        Dimension("area above", above, "area"),
    )


def _outline(outline: Outline, size: float, turned: float) -> tuple[Dimension, ...]:
    """Dimensions of an outline that is so many times as large, and turned by an angle."""

    def sides(width: float, depth: float) -> tuple[Dimension, Dimension]:
        return Dimension("width", size * width), Dimension("depth", size * depth)

    match outline:
        case Circle(_, radius) | DividedCircle(_, radius):
            return (Dimension("radius", size * radius),)
        case Ellipse(_, major, minor, angle):
            semi_axes = (Dimension("semi-axes", size * major), Dimension("and", size * minor))
            return (*semi_axes, _turn(angle + turned, np.pi))
        case Rectangle(_, width, depth, angle):
            return (*sides(width, depth), _turn(angle + turned, np.pi))
        case RoundedRectangle(_, width, depth, angle, radius):
            fillets = Dimension("fillets", size * radius)
            return (*sides(width, depth), fillets, _turn(angle + turned, np.pi))
        case Stadium(_, length, radius, angle):
            between = Dimension("between the arcs", size * length)
            return (Dimension("radius", size * radius), between, _turn(angle + turned, np.pi))
    return _cornered(outline, size, turned)


def _cornered(outline: Outline, size: float, turned: float) -> tuple[Dimension, ...]:
    """Dimensions of an outline of many corners, alike or not."""
    match outline:
        case RegularPolygon(_, radius, angle, corners):
            to_corners = Dimension("radius to the corners", size * radius)
            return (_count("corners", corners), to_corners, _turn(angle + turned, 2 * np.pi / corners))
        case Star(_, radius, inner, angle, tips):
            radii = (Dimension("radius to the tips", size * radius), Dimension("between", size * inner))
            return (_count("tips", tips), *radii, _turn(angle + turned, 2 * np.pi / tips))
        case RectilinearPolygon(offsets, angle):
            right = _count("right corners", len(offsets))
            return (right, _area(outline, size), _turn(angle + turned, np.pi / 2))
    return _free_outline(outline, size)


def _free_outline(outline: Outline, size: float) -> tuple[Dimension, ...]:
    """Numbers of edges and area of an outline that has no sizes of its own."""
    match outline:
        case RoundedPolygon(vertices, radius):
            found = [_count("corners", len(vertices)), Dimension("fillets", size * radius)]
        case Polygon(vertices):
            found = [_count("corners", len(vertices))]
        case LineArc(vertices, _, curved):
            arcs = int(curved.sum())
            found = [_count("lines", len(vertices) - arcs), _count("arcs", arcs)]
        case _:
            found = [_count("poles", len(outline.vector))]
    return (*found, _area(outline, size))


def _area(outline: Outline, size: float) -> Dimension:
    return Dimension("area", size**2 * outline.area, "area")


def _turn(angle: float, period: float) -> Dimension:
    return Dimension("turned by", angle, "angle", period)


def _count(name: str, number: int) -> Dimension:
    return Dimension(name, number, "count")


def _moves(wall: Swept, low: float, high: float) -> tuple[Dimension, ...]:
    """How a swept outline moves between two heights."""
    found = []
    if np.any(wall.drift):
        found.append(Dimension("slant", float(np.arctan(np.hypot(*wall.drift))), "angle"))
    if wall.bows:
        below, above = wall.tips()
        found.append(Dimension("dome", above - below, "length"))
    elif wall.taper:
        below, above = wall.scale(np.array([low, high])).tolist()
        found.append(Dimension("grows to", above / below, "ratio"))
    if wall.twist:
        found.append(Dimension("twist", wall.twist * (high - low), "angle"))
    return tuple(found)
