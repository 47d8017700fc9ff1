"""Recognise section: the outline of every loop of a segment's section, chosen by evidence."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.section.fitted_outline import Loop, fitted_outline, loop_beside
from sketchloft.exact.section.further_outlines import (
    STIFF,
    Tried,
    attempt_corners,
    attempt_splines,
    likeliest,
    nearly_free,
)
from sketchloft.exact.section.roundness import seems_round
from sketchloft.exact.section.section_contours import contours
from sketchloft.outline.candidates import circle_of, ellipse_of, rectangle_like, rectangle_of, spline_of
from sketchloft.outline.circle import Circle
from sketchloft.outline.outline import Outline
from sketchloft.workers import ALONE, Workers

__all__ = ["SectionShape", "recognise_section"]

HOPELESS = 150.0, 25.0
"""An outline that is so much worse than another before the noise is fitted, in log likelihood and at least in
evidence, is given up."""


@dataclass(frozen=True)
class SectionShape:
    """The outlines that bound a section.

    Parameters
    ----------
    outlines : tuple of Outline
        Those of pieces, then those of holes.
    holes : int
    """

    outlines: tuple[Outline, ...]
    holes: int


def recognise_section(
    points: Floats, together: float, *, rough: bool = False, workers: Workers = ALONE
) -> SectionShape | None:
    """Find the outlines of a section filled by points (n, 2); None where there is no section.

    Parameters
    ----------
    points : (n, 2) float array
    together : float
        How many of the points go together; evidence counts that much less.
    rough : bool
        Whether a few kinds of outlines will do.
    workers : Workers, optional
    """
    outer, holes, blur = contours(points, together)
    if not outer:
        return None
    loops = [(ring, False) for ring in outer] + [(ring, True) for ring in holes]
    outlines = [
        _best(loop_beside(points, ring, blur, together, hole=hole), ring, rough=rough, workers=workers)
        for ring, hole in loops
    ]
    return SectionShape(tuple(outlines), len(holes))


def _best(loop: Loop, ring: Floats, *, rough: bool, workers: Workers) -> Outline:
    """Find the best outline for one loop from the points beside it."""
    tried: Tried = []
    seen = [-np.inf]
    hopeless = max(HOPELESS[0] / loop.together, HOPELESS[1])

    def attempt(*outlines: Outline) -> list[float]:
        least = max(seen) - hopeless
        found = workers.each(fitted_outline, [(loop, outline, least) for outline in outlines])
        seen.extend(one.settled for one in found)
        tried.extend((one.value, one.outline) for one in found)
        return [one.value for one in found]

    free, circle, ellipse = attempt(spline_of(ring, STIFF), circle_of(ring), ellipse_of(ring))
    round_one = tried[1][1]
    if circle > max(free, ellipse) and isinstance(round_one, Circle) and seems_round(loop, round_one):
        # Strokes fill the corners of a rectangle less evenly than the rest.
        squares = [] if loop.together == 1 else [rectangle_of(ring), rectangle_like(ellipse_of(ring))]
        if circle > max(attempt(*squares), default=-np.inf):
            return round_one
    if rough:
        attempt(rectangle_of(ring))
        return likeliest(tried)
    attempt_corners(attempt, tried, ring, loop.blur, strokes=loop.together > 1)
    if nearly_free(tried):
        attempt_splines(attempt, tried, ring)
    return likeliest(tried)
