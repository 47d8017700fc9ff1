"""The faces of a ruled wall: planes where they are, else B-splines."""

from __future__ import annotations

import numpy as np

from sketchloft.brep.kernel import bspline_curve, bspline_surface
from sketchloft.brep.plane_side import line_part, plane_side
from sketchloft.brep.shell_parts import CurvePart
from sketchloft.brep.tube import Side, Tube, tube
from sketchloft.cloud import Floats
from sketchloft.outline.chain import chords, outward
from sketchloft.surface import SkinSurface
from sketchloft.wall.ruled import Ruled

__all__ = ["ruled_tube"]

STRAIGHT = 1e-9
"""Edges of a smaller bulge are lines."""
FLAT = 1e-9
"""Corners of a side nearer to one plane than this, in a solid about 1 across, lie on it."""
LINE = np.array([0.0, 0.0, 1.0, 1.0])
CONIC = np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0])


def ruled_tube(wall: Ruled, low: float, high: float) -> Tube:
    """Make the faces of a ruled wall, whose outlines are at these two heights."""
    wall = wall.between(low, high)
    rims = [_rims(*end.chain(), height) for end, height in ((wall.bottom, low), (wall.top, high))]
    posts = [line_part(foot[0][0], head[0][0]) for foot, head in zip(*rims, strict=True)]
    return tube([_side(foot, head, (low, high)) for foot, head in zip(*rims, strict=True)], posts)


def _rims(vertices: Floats, bulges: Floats, height: float) -> list[tuple[Floats, Floats | None]]:
    """Poles (k, 3) and weights of each edge at a height: two of a line, three of an arc."""
    found: list[tuple[Floats, Floats | None]] = []
    for start, chord, bulge in zip(vertices, chords(vertices), bulges.tolist(), strict=True):
        if abs(bulge) < STRAIGHT:
            found.append((_lifted(np.array([start, start + chord]), height), None))
            continue
        # The tangents at the ends meet above the middle of the chord.
        apex = start + chord / 2 + bulge / (1 - bulge**2) * outward(chord)
        cosine = (1 - bulge**2) / (1 + bulge**2)
        poles = np.array([start, apex, start + chord])
        found.append((_lifted(poles, height), np.array([1.0, cosine, 1.0])))
    return found


def _lifted(points: Floats, height: float) -> Floats:
    return np.column_stack([points, np.full(len(points), height)])


def _side(
    foot: tuple[Floats, Floats | None], head: tuple[Floats, Floats | None], heights: tuple[float, float]
) -> Side:
    if foot[1] is None and head[1] is None:
        (a, b), (c, d) = foot[0], head[0]
        across = np.cross(d - a, c - b)
        size = float(np.linalg.norm(across))
        if abs(float(across @ (c - a))) <= FLAT * size:
            return plane_side(foot[0], head[0])
        poles, weights, knots, degree = np.stack([foot[0], head[0]]), None, LINE, 1
    else:
        rows = [_raised(*rim) for rim in (foot, head)]
        poles, weights = np.stack([row[0] for row in rows]), np.stack([row[1] for row in rows])
        knots, degree = CONIC, 2
    v_knots = np.repeat(heights, 2).astype(float)
    surface = bspline_surface(SkinSurface(poles, knots, v_knots, degree, 1, weights))
    bottom, top = (
        CurvePart(bspline_curve(row, None if weights is None else weights[i], knots, degree), 0.0, 1.0)
        for i, row in enumerate(poles)
    )
    return Side(surface, (0.0, 1.0), heights, bottom, top)


def _raised(poles: Floats, weights: Floats | None) -> tuple[Floats, Floats]:
    """Poles and weights of an edge as a conic, which a line is, too."""
    if weights is not None:
        return poles, weights
    return np.array([poles[0], poles.mean(axis=0), poles[1]]), np.ones(3)
