"""Further outlines: those of corners and free curves that a contour could be."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.section.rarity import may_be_free
from sketchloft.outline.candidates import chains, polygons, rectangle_like, spline_of
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.fitted_loop import fitted_loop
from sketchloft.outline.outline import Outline
from sketchloft.outline.polygons import LineArc, Polygon, corner_areas
from sketchloft.outline.rectilinear import rectilinear_of, with_a_step_less
from sketchloft.outline.simpler_chains import simpler_chains
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.outline.star import star_in

__all__ = ["STIFF", "Attempt", "Tried", "attempt_corners", "attempt_splines", "likeliest", "nearly_free"]

STIFF = 8
"""Poles of the first spline."""
POLES = (12, 16, 20)
AROUND = 160
"""Points on a spline that one of more poles is drawn through."""
NEARLY = 25.0
"""Evidence by which a spline of few poles, or many edges, may be behind and yet one of more be the best."""


class Attempt(Protocol):
    """Fits outlines, notes them, and says how likely they are."""

    def __call__(self, *outlines: Outline) -> list[float]:
        """Evidence of each."""


Tried = list[tuple[float, Outline]]
"""Evidence of outlines, and the outlines as fitted."""


def attempt_corners(attempt: Attempt, tried: Tried, ring: Floats, blur: float, *, strokes: bool) -> None:
    """Try outlines with corners, and the best polygon with fewer and fewer of them."""
    cut = chains(ring, blur, strokes=strokes)
    polygon = next((outline for outline in cut if isinstance(outline, Polygon)), None)
    # Where points are few, they tell the angle better than the contour.
    by_points = [rectangle_like(found) for _, found in tried if isinstance(found, Ellipse)]
    star = star_in(ring)
    stars = [] if star is None else [star]
    attempt(*cut, *polygons(ring, polygon, blur), *by_points, *stars)
    for kind in (Polygon, LineArc):
        _attempt_fewer_corners(attempt, tried, kind)
    _attempt_right_corners(attempt, tried)


def _attempt_fewer_corners(attempt: Attempt, tried: Tried, kind: type[Polygon | LineArc]) -> None:
    """Try the best outline of a kind with fewer and fewer corners, as long as it gets better.

    Arcs that have lost their points do not find them again with a corner less, as polygons do.
    """
    found = [one for one in tried if isinstance(one[1], kind) and (kind is Polygon or np.isfinite(one[0]))]
    if not found:
        return
    value, outline = max(found, key=lambda one: one[0])
    while isinstance(outline, kind) and (simpler := _simpler(outline)):
        gained = max(attempt(*simpler))
        if gained < value:
            return
        value, outline = max(tried[-len(simpler) :], key=lambda one: one[0])


def _attempt_right_corners(attempt: Attempt, tried: Tried) -> None:
    """Try what the polygons are with right corners, the best of as many corners, and with fewer steps."""
    seen: set[int] = set()
    for _, polygon in sorted(tried, key=lambda found: -found[0]):
        outline = rectilinear_of(polygon.vertices) if isinstance(polygon, Polygon) else None
        value = -np.inf
        while outline is not None and len(outline.offsets) not in seen:
            seen.add(len(outline.offsets))
            (simpler,) = attempt(outline)
            if simpler < value:
                break
            value, outline = simpler, with_a_step_less(outline)


def attempt_splines(attempt: Attempt, tried: Tried, ring: Floats) -> None:
    """Try splines of more poles; where one crosses itself in bays of the contour, from the best so far."""
    values = attempt(*(spline_of(ring, poles) for poles in POLES))
    crossed = [poles for poles, value in zip(POLES, values, strict=True) if not np.isfinite(value)]
    if crossed:
        splines = [found for found in tried if isinstance(found[1], SplineLoop)]
        best = likeliest(splines).boundary(AROUND).points
        attempt(*(fitted_loop(best, poles) for poles in crossed))


def nearly_free(tried: Tried) -> bool:
    """Whether an outline that is a free curve, or may stand for one, is nearly the best."""
    best = max(value for value, _ in tried)
    return any(may_be_free(outline) and value > best - NEARLY for value, outline in tried)


def likeliest(tried: Tried) -> Outline:
    """Give the outline of most evidence."""
    return max(tried, key=lambda found: found[0])[1]


def _simpler(outline: Polygon | LineArc) -> list[Outline]:
    """Drop the corner whose triangle with its neighbours is smallest; beside arcs, one that may be none."""
    if isinstance(outline, LineArc):
        return [*simpler_chains(outline)]
    if len(outline.vertices) < 4:
        return []
    smallest = int(np.argmin(corner_areas(outline.vertices)))
    return [Polygon(np.delete(outline.vertices, smallest, axis=0))]
