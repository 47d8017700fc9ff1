"""Rarity: how seldom an outline is drawn, and which ones stand for a free curve."""

from __future__ import annotations

from collections.abc import Iterable

from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Arc, Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon, odd_corners
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import SplineLoop
from sketchloft.outline.stadium import Stadium
from sketchloft.outline.star import Star
from sketchloft.stack import Wall
from sketchloft.wall.swept import Swept

__all__ = ["COMMON", "LAST", "may_be_free", "rarer", "rarity"]

COMMON = (Circle, Ellipse, Rectangle)
"""Outlines that there is no simpler one for."""
RARE = 6.0
"""Log odds against other outlines of up to six edges, and against a rectangle with one radius, a star and one
of right corners, of which there are more to be taken for one by chance; one more for each further line, two
for each arc."""
REGULAR, SQUARE, HEXAGON = 4.0, 0.0, 2.0
"""The same against a regular polygon: its one size leaves it little to be taken for one by chance. A square
has no odds against it, and hexagons are drawn more often than others."""
ODD = 3.0
"""Log odds against each end of an arc at an odd angle."""
LAST = 12.0
"""Log odds against splines, which are drawn for want of anything else."""
MANY = 7
"""Corners of a polygon that may stand for a free curve."""


def rarity(outline: Outline) -> float:
    """Log odds against an outline before the points are seen."""
    if isinstance(outline, SplineLoop):
        return LAST
    if isinstance(outline, (RectilinearPolygon, RoundedRectangle, Stadium, Star)):
        return RARE
    if isinstance(outline, RegularPolygon):
        return {4: SQUARE, 6: HEXAGON}.get(outline.sides, REGULAR)
    edges = sum(2.0 if isinstance(edge, Arc) else 1.0 for edge in outline.edges())
    if isinstance(outline, LineArc):
        edges += ODD * odd_corners(outline)
    return 0.0 if isinstance(outline, COMMON) else max(RARE, edges)


def rarer(walls: Iterable[Wall], before: Iterable[Wall]) -> float:
    """By how much more the log odds are against the outlines of walls than against those before, or 0."""
    odds = [sum(rarity(w.outline) for w in each if isinstance(w, Swept)) for each in (walls, before)]
    return max(odds[0] - odds[1], 0.0)


def may_be_free(outline: Outline) -> bool:
    """Whether an outline is a free curve, or has edges enough to stand for one."""
    if isinstance(outline, Polygon):
        return len(outline.vertices) >= MANY
    return isinstance(outline, (LineArc, RoundedPolygon, SplineLoop, Star))
