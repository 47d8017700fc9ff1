"""The rims of a level section, and how far points are from it."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face

from sketchloft.brep.explore import edges_of
from sketchloft.brep.planar_curve import PlanarCurve, curve_of
from sketchloft.cloud import Floats, Ints

__all__ = ["Feet", "Rim", "Section", "section_of"]

PER_TURN = 64
"""Sides of the polygon that stands for a full turn when the rim nearest to a point is looked for."""
ASKEW = np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
STEPS = 6
"""Gauss-Newton steps to the foot; near a curve each gains several digits."""


@dataclass(frozen=True)
class Rim:
    """An edge of a section.

    Parameters
    ----------
    edge : TopoDS_Edge
        In the sense of its curve.
    curve : PlanarCurve
    ahead : bool
        Whether the section is on the left, seen from above, when the curve is walked in its sense.
    """

    edge: TopoDS_Edge
    curve: PlanarCurve
    ahead: bool


@dataclass(frozen=True)
class Feet:
    """Where points are nearest to the rims of a section.

    Parameters
    ----------
    distance : (n,) float array
        Negative inside.
    rim : (n,) int array
    at : (n,) float array
        Parameter on that rim's curve.
    """

    distance: Floats
    rim: Ints
    at: Floats


@dataclass(frozen=True)
class Section:
    """A level section as its rims; any number of pieces with any number of holes."""

    rims: tuple[Rim, ...]

    def at(self, rim: Ints, t: Floats) -> Floats:
        """Points (n, 2) at parameters t (n,) on rims (n,)."""
        points = np.empty((len(t), 2))
        for index in np.unique(rim).tolist():
            rows = rim == index
            points[rows] = self.rims[index].curve.at(t[rows])
        return points

    @functools.cached_property
    def _polygon(self) -> tuple[Floats, Floats, Ints, Floats, Floats]:
        """Ends of all sides (k, 2), the rim that each is of, and the parameters there."""
        spread = [rim.curve.spread(PER_TURN) for rim in self.rims]
        corners = [rim.curve.at(t) for rim, t in zip(self.rims, spread, strict=True)]
        a, b = (np.concatenate([part[ends] for part in corners]) for ends in (slice(-1), slice(1, None)))
        owner = np.repeat(np.arange(len(self.rims)), [len(t) - 1 for t in spread])
        t0, t1 = (np.concatenate([t[ends] for t in spread]) for ends in (slice(-1), slice(1, None)))
        return a, b, owner, t0, t1

    def feet(self, points: Floats) -> Feet:
        """Signed distance of points (n, 2), and where they are nearest."""
        a, b, owner, t0, t1 = self._polygon
        along = b - a
        spokes = points[:, None] - a
        share = np.einsum("nkd,kd->nk", spokes, along) / np.einsum("kd,kd->k", along, along)
        share = np.clip(share, 0.0, 1.0)
        gaps = spokes - share[..., None] * along
        squares = np.einsum("nkd,nkd->nk", gaps, gaps)
        side, row = np.argmin(squares, axis=1), np.arange(len(points))
        far = np.sqrt(squares[row, side])
        at = t0[side] + share[row, side] * (t1 - t0)[side]
        feet = Feet(np.where(_is_within(points, a, b), -far, far), owner[side], at)
        # The polygon is off by less than a side is long; from farther away it tells enough.
        self._refine(feet, points, np.flatnonzero(far < np.hypot(*along[side].T)), (t1 - t0)[side])
        return feet

    def _refine(self, feet: Feet, points: Floats, near: Ints, width: Floats) -> None:
        """Move feet of points near the rims from the polygon to the curves."""
        for index in np.unique(feet.rim[near]).tolist():
            rows = near[feet.rim[near] == index]
            curve, ahead = self.rims[index].curve, self.rims[index].ahead
            t = feet.at[rows]
            for _ in range(STEPS):
                gap, slope = points[rows] - curve.at(t), curve.at(t, 1)
                step = np.einsum("nd,nd->n", gap, slope) / np.einsum("nd,nd->n", slope, slope)
                t = np.clip(t + np.clip(step, -width[rows], width[rows]), curve.start, curve.end)
            gap, slope = points[rows] - curve.at(t), curve.at(t, 1)
            across = slope[:, 0] * gap[:, 1] - slope[:, 1] * gap[:, 0]
            # At a corner the side that a tangent tells may be the wrong one; between corners it is exact.
            is_end = (t <= curve.start) | (t >= curve.end)
            inside = np.where(is_end, feet.distance[rows] < 0, (across > 0) == ahead)
            far = np.hypot(*gap.T)
            feet.distance[rows], feet.at[rows] = np.where(inside, -far, far), t


def section_of(faces: Sequence[TopoDS_Face]) -> Section:
    """The section that level faces make."""
    rims: list[Rim] = []
    for face in faces:
        loops = []
        walk = TopExp_Explorer(face, TopAbs_ShapeEnum.TopAbs_WIRE)
        while walk.More():
            loops.append([_rim(edge) for edge in edges_of(walk.Current())])
            walk.Next()
        areas = [_area(loop) for loop in loops]
        outer = int(np.argmax(np.abs(areas)))
        for i, (loop, area) in enumerate(zip(loops, areas, strict=True)):
            is_right = (area > 0) == (i == outer)
            rims += [Rim(rim.edge, rim.curve, rim.ahead == is_right) for rim in loop]
    return Section(tuple(rims))


def _rim(edge: TopoDS_Edge) -> Rim:
    forward = TopAbs_Orientation.TopAbs_FORWARD
    return Rim(TopoDS.Edge(edge.Oriented(forward)), curve_of(edge), edge.Orientation() == forward)


def _area(loop: Sequence[Rim]) -> float:
    """Area of a loop of rims, walked as they are oriented; negative when that is clockwise."""
    origin = loop[0].curve.at(np.array([loop[0].curve.start]))[0]
    swept = [rim.curve.swept_area(rim.curve.start, rim.curve.end, origin) for rim in loop]
    return sum(area if rim.ahead else -area for rim, area in zip(loop, swept, strict=True))


def _is_within(points: Floats, a: Floats, b: Floats) -> NDArray[np.bool_]:
    """Whether points are within polygons of sides from a to b (k, 2), by how often a ray leaves them."""
    # The ray goes askew, since edges in its direction, and ends that differ by rounding, would be miscounted.
    points, a, b = points @ ASKEW, a @ ASKEW, b @ ASKEW
    x, y = points[:, :1], points[:, 1:]
    crosses = (a[:, 1] <= y) != (b[:, 1] <= y)
    rise = np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])
    reach = a[:, 0] + (y - a[:, 1]) / rise * (b[:, 0] - a[:, 0])
    within: NDArray[np.bool_] = (crosses & (reach > x)).sum(axis=1) % 2 == 1
    return within
