"""Candidates: outlines of every kind that a contour could be, started from the contour."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.pieces import line_arc_pieces
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import SplineLoop, spline_loop
from sketchloft.ring import ring_area, ring_centre
from sketchloft.shapes.spline import fit_spline, resampled

__all__ = ["chains", "circle_of", "ellipse_of", "polygons", "rectangle_like", "rectangle_of", "spline_of"]

CONTOUR_NOISE = 0.3
"""Standard deviation of the half-density contour in blurs of the density."""
ROUNDING = 1.5
"""Blurs beside a corner within which the contour is rounded off."""
PRICES = (10.0, 5.0, 2.5)
COARSE = (20.0, 40.0)
"""Of each piece, in the usual one: those for what chance leaves of an even cloud's contour, and further ones
for that of strokes, which waves more slowly and farther."""
MOST_CORNERS = 48
AROUND = 240
REGULAR = (3, 5, 6, 8)
"""Sides of regular polygons that are looked for."""


def circle_of(ring: Floats) -> Circle:
    """Circle of the contour's area about its centroid."""
    return Circle(ring_centre(ring), float(np.sqrt(_area(ring) / np.pi)))


def ellipse_of(ring: Floats) -> Ellipse:
    """Ellipse of the contour's second moments and area."""
    centre = ring_centre(ring)
    sizes, axes = np.linalg.eigh(_second_moments(ring, centre))
    ratio = float(np.sqrt(abs(sizes[1]) / max(abs(float(sizes[0])), 1e-12)))
    minor = float(np.sqrt(_area(ring) / np.pi / ratio))
    return Ellipse(centre, ratio * minor, minor, float(np.arctan2(axes[1, 1], axes[0, 1])))


def rectangle_of(ring: Floats) -> Rectangle:
    """Rectangle of least area around the contour (m, 2)."""
    angles = np.arange(90) * np.pi / 180
    turn = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    along = ring @ turn.T
    across = ring @ np.stack([-turn[:, 1], turn[:, 0]], axis=1).T
    low, high = (np.stack([f(along, axis=0), f(across, axis=0)]) for f in (np.min, np.max))
    best = int(np.argmin(np.prod(high - low, axis=0)))
    middle = (low[:, best] + high[:, best]) / 2
    c, s = turn[best]
    centre = np.array([c * middle[0] - s * middle[1], s * middle[0] + c * middle[1]])
    width, height = (high - low)[:, best].tolist()
    return Rectangle(centre, width, height, float(angles[best]))


def rectangle_like(ellipse: Ellipse) -> Rectangle:
    """Rectangle of the same second moments, but for its area."""
    width, height = np.sqrt(3) * ellipse.major, np.sqrt(3) * ellipse.minor
    return Rectangle(ellipse.centre, float(width), float(height), ellipse.angle)


def spline_of(ring: Floats, poles: int) -> SplineLoop:
    """Closed spline through the contour."""
    return spline_loop(fit_spline(ring, poles).poles)


def chains(ring: Floats, blur: float, *, strokes: bool = False) -> list[Outline]:
    """Polygons and chains of lines and arcs.

    Parameters
    ----------
    ring : (m, 2) float array
        Contour, counter-clockwise.
    blur : float
        Standard deviation of the blur it was found with.
    strokes : bool
        Whether its points go together, so that there are fewer pieces than there seem to be.
    """
    prices = (*PRICES, *COARSE) if strokes else PRICES
    found: list[Outline] = []
    seen: set[tuple[bool, ...]] = set()
    for vertices, bulges in line_arc_pieces(ring, CONTOUR_NOISE * blur, ROUNDING * blur, prices):
        curved = bulges != 0
        key = tuple(curved.tolist())
        if len(vertices) < 2 or len(vertices) > MOST_CORNERS or key in seen:
            continue
        seen.add(key)
        if not curved.any() and len(vertices) >= 3:
            found.append(Polygon(vertices))
        elif curved.any() and len(vertices) + curved.sum() >= 3:
            found.append(LineArc(vertices, bulges, curved))
    return found


def polygons(ring: Floats, polygon: Polygon | None, blur: float) -> list[Outline]:
    """Rectangles, regular and rounded polygons that a contour, cut into a polygon, could be."""
    found: list[Outline] = []
    rectangle = rectangle_of(ring)
    found.append(rectangle)
    lacking = rectangle.width * rectangle.height - _area(ring)
    radius = float(np.sqrt(max(lacking, 0.0) / (4 - np.pi)))
    radius = float(np.clip(radius, 0.5 * blur, 0.49 * min(rectangle.width, rectangle.height)))
    found.append(
        RoundedRectangle(rectangle.centre, rectangle.width, rectangle.height, rectangle.angle, radius)
    )
    found.extend(_regular(ring))
    if polygon is not None and len(polygon.vertices) != 4:
        found.append(RoundedPolygon(polygon.vertices, 1.5 * blur))
    return found


def _regular(ring: Floats) -> list[RegularPolygon]:
    """Hexagon, and the polygon with as many sides as the contour's radius has waves, turned with them."""
    centre = ring_centre(ring)
    spokes = (resampled(ring, AROUND) - centre) @ [1, 1j]
    turn = np.unwrap(np.angle(spokes))
    step = np.angle(np.roll(spokes, -1) / np.roll(spokes, 1))
    waves = np.array([np.sum(step * np.abs(spokes) * np.exp(-1j * sides * turn)) for sides in REGULAR])
    # The corners' share of a wave falls with the square of their number, that of noise more slowly.
    strongest = REGULAR[int(np.argmax(np.abs(waves) * REGULAR))]
    found = []
    for sides in sorted({6, strongest}):
        radius = float(np.sqrt(2 * _area(ring) / (sides * np.sin(2 * np.pi / sides))))
        angle = -float(np.angle(waves[REGULAR.index(sides)])) / sides
        found.append(RegularPolygon(centre, radius, angle, sides))
    return found


def _area(ring: Floats) -> float:
    """Area of a ring, positive even where an outline has shrunk to nothing or turned inside out."""
    return max(ring_area(ring), 1e-15)


def _second_moments(ring: Floats, centre: Floats) -> Floats:
    """(2, 2) second moments of the enclosed area."""
    p = ring - centre
    q = np.roll(p, -1, axis=0)
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    total = np.einsum("i,ij,ik->jk", cross, p, p) + np.einsum("i,ij,ik->jk", cross, q, q)
    mixed = np.einsum("i,ij,ik->jk", cross, p, q)
    return np.asarray((total + (mixed + mixed.T) / 2) / 12)
