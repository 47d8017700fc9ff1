"""Simpler walls: what a wall could be instead, with fewer parameters or of a likelier kind."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.changes.turning import turning
from sketchloft.outline.candidates import circle_of, ellipse_of, polygons, rectangle_of
from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon, flattest
from sketchloft.outline.rectilinear import RectilinearPolygon, rectilinear_of, with_a_step_less
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.simpler_chains import simpler_chains
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.outline.stadium import Stadium, stadium_like
from sketchloft.outline.star import Star, star_of
from sketchloft.outline.with_arc import with_an_arc
from sketchloft.stack import Wall
from sketchloft.wall.dome import taper_and_bow
from sketchloft.wall.profile import ArcProfile, LineProfile, Profile, SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Freedom, Swept

__all__ = ["as_revolved", "both_ways", "profiles_like", "walls_like"]

HEIGHTS = 25
TINY = 1e-12
ROUNDED = 0.12
"""Radius of the corners that a rectangle is tried with, in its short side."""
PARALLEL = 0.1
"""Sine of the angle between two edges that meet nowhere near."""
NEAR = 3.0
"""How far from a short edge those beside it meet at most, in its length."""
MORE: tuple[Freedom, ...] = ("drift", "taper")


def walls_like(wall: Wall, low: float, high: float) -> Iterator[Wall]:
    """Walls that could stand in for one between two heights."""
    if isinstance(wall, Revolved):
        z = np.linspace(low, high, HEIGHTS)
        r = radius_at(wall.profile, z)[0]
        for profile in profiles_like(z, r):
            if type(profile) is not type(wall.profile) or _form(profile) != _form(wall.profile):
                yield replace(wall, profile=profile)
        if isinstance(wall.profile, SplineProfile):
            yield from _spheroids(wall.centre, z, r)
    elif isinstance(wall, Ruled):
        yield from turning(wall)
    elif isinstance(wall, Swept):
        reshaped = (replace(wall, outline=outline) for outline in _outlines_like(wall.outline))
        yield from (other.about_centre() for other in chain(_moving_otherwise(wall), reshaped))
        yield from both_ways(wall, low, high)
        if isinstance(wall.outline, Circle) and not np.any(wall.drift):
            z = np.linspace(low, high, HEIGHTS)
            for profile in profiles_like(z, wall.outline.radius * wall.scale(z)):
                yield Revolved(wall.outline.centre, profile)


def as_revolved(wall: Swept) -> Wall:
    """The cylinder or cone that a circle is which goes straight up; any other wall as it is."""
    moves = wall.twist or wall.bows or np.any(wall.drift) or "drift" in wall.free
    if not isinstance(wall.outline, Circle) or moves or (wall.taper and not wall.free):
        return wall
    slope = wall.outline.radius * wall.taper if wall.free else None
    return Revolved(wall.outline.centre, LineProfile(wall.height, wall.outline.radius, slope))


def _spheroids(centre: Floats, z: Floats, r: Floats) -> Iterator[Swept]:
    """Spheroid, about an axis at a centre, nearest to radii (m,) at heights (m,)."""
    height = float(z.mean())
    second, first, square = np.polyfit(z - height, r**2, 2) if (r > 0).all() else np.zeros(3)
    taper, bow = taper_and_bow(*(float(term) / max(float(square), TINY) for term in (first, second)))
    if square > 0 and bow > abs(taper):
        circle = Circle(centre, float(np.sqrt(square)))
        yield Swept(circle, height, centre, np.zeros(2), taper, 0.0, ("taper", "bow"), bow)


def _moving_otherwise(wall: Swept) -> Iterator[Swept]:
    """The wall with a movement less, and with one more."""
    for name in wall.moves:
        still: Floats | float = np.zeros(2) if name == "drift" else 0.0
        left = wall.moving(*(other for other in wall.moves if other != name))
        yield replace(left, **{name: still})  # type: ignore[arg-type]
    for more in MORE:
        if more not in wall.free:
            yield wall.moving(*wall.moves, more)


def both_ways(wall: Wall, low: float, high: float) -> Iterator[Ruled]:
    """For a tapered rectangle: one that stands straight, whose sides may go by slopes of their own."""
    if not isinstance(wall, Swept) or not isinstance(wall.outline, Rectangle):
        return
    if wall.moves not in (("taper",), ("drift", "taper")):
        return
    outline = wall.outline
    below, above = (
        Rectangle(wall.pivot, scale * outline.width, scale * outline.height, outline.angle)
        for scale in wall.scale(np.array([low, high])).tolist()
    )
    yield Ruled(below, above, low, high)


def profiles_like(z: Floats, r: Floats) -> Iterator[Profile]:
    """Cylinder, cone and sphere nearest to a profile given by radii (m,) at heights (m,)."""
    middle = float(z.mean())
    yield LineProfile(middle, float(np.sqrt((r**2).mean())), None)
    slope, radius = np.polyfit(z - middle, r, 1)
    yield LineProfile(middle, float(radius), float(slope))
    first, constant = np.polyfit(z, r**2 + z**2, 1)
    square = float(constant + first**2 / 4)
    if square > 0:
        yield ArcProfile(float(first) / 2, None, float(np.sqrt(square)))


def _form(profile: Profile) -> tuple[bool, bool]:
    straight = isinstance(profile, LineProfile) and profile.slope is None
    return straight, isinstance(profile, ArcProfile) and profile.offset is None


def _outlines_like(outline: Outline) -> Iterator[Outline]:
    ring = outline.boundary(96).points
    yield from _ovals_like(outline, ring)
    if isinstance(outline, RoundedRectangle):
        yield Rectangle(outline.centre, outline.width, outline.height, outline.angle)
    if isinstance(outline, Rectangle):
        sides = (outline.width, outline.height)
        yield RoundedRectangle(outline.centre, *sides, outline.angle, ROUNDED * min(sides))
    yield from _with_simpler_corners(outline)
    polygon = _corners_of(outline)
    if polygon is not None and not isinstance(outline, Polygon):
        yield polygon
    if isinstance(outline, (Polygon, RectilinearPolygon)):
        yield from with_an_arc(polygon.vertices if polygon is not None else outline.chain()[0])
    if not isinstance(outline, (Rectangle, Circle, Star)):
        for other in polygons(ring, polygon, float(np.sqrt(outline.area)) * 0.05):
            if type(other) is not type(outline):
                yield other


def _ovals_like(outline: Outline, ring: Floats) -> Iterator[Outline]:
    """Circle, ellipse and stadium that an outline with a ring (m, 2) of points could be."""
    if isinstance(outline, (Ellipse, LineArc, SplineLoop, RegularPolygon, RoundedRectangle, Stadium)):
        yield circle_of(ring)
    if isinstance(outline, (LineArc, SplineLoop)):
        yield ellipse_of(ring)
    if isinstance(outline, (Ellipse, LineArc, RoundedRectangle)):
        yield stadium_like(outline if isinstance(outline, RoundedRectangle) else rectangle_of(ring))


def _corners_of(outline: Outline) -> Polygon | None:
    """The polygon of an outline's corners; None where it has none of its own."""
    match outline:
        case Polygon(vertices) | RoundedPolygon(vertices):
            return Polygon(vertices)
        case RectilinearPolygon():
            return Polygon(outline.chain()[0])
    return None


def _of_fewer_numbers(outline: Outline) -> Iterator[Outline]:
    """Outlines that a polygon could be, or one of right corners with a step less."""
    found: list[Outline | None] = []
    if isinstance(outline, Polygon):
        found = [star_of(outline.vertices), rectilinear_of(outline.vertices)]
    elif isinstance(outline, RectilinearPolygon):
        found = [with_a_step_less(outline)]
    yield from (other for other in found if other is not None)


def _with_simpler_corners(outline: Outline) -> Iterator[Outline]:
    yield from _of_fewer_numbers(outline)
    if isinstance(outline, Polygon) and len(outline.vertices) > 3:
        for k in flattest(outline.vertices):
            yield Polygon(np.delete(outline.vertices, k, axis=0))
        for corner in _without_chamfers(outline.vertices):
            yield Polygon(corner)
    if isinstance(outline, LineArc) and len(outline.vertices) > 2:
        yield from simpler_chains(outline)
        yield Polygon(outline.vertices)


def _without_chamfers(vertices: Floats) -> Iterator[Floats]:
    """Vertices with one of the two shortest edges left out, where those beside it meet not far away."""
    lengths = np.linalg.norm(np.roll(vertices, -1, axis=0) - vertices, axis=1)
    for k in np.argsort(lengths)[:2].tolist():
        ring = np.roll(vertices, -k, axis=0)
        before, start, end, after = ring[[-1, 0, 1, 2]]
        along = np.column_stack([start - before, after - end])
        if abs(float(np.linalg.det(along))) < PARALLEL * float(np.prod(np.linalg.norm(along, axis=0))):
            continue
        corner = before + np.linalg.solve(along, end - before)[0] * (start - before)
        if np.linalg.norm(corner - start) < NEAR * lengths[k]:
            yield np.vstack([corner, ring[2:]])
