"""Overlay: two level sections cut into pieces where they meet, each inside, outside or on the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from sketchloft.brep.crossings import crossings
from sketchloft.brep.planar_curve import PlanarCurve
from sketchloft.brep.section_rims import Section
from sketchloft.cloud import Floats

__all__ = ["Overlay", "Piece", "overlay"]

Place = Literal["in", "out", "on"]
SLACK = 1.5
"""Of a piece that ends where the distance is the tolerance, some points may be a little farther."""
WITHIN = np.array([0.06, 0.22, 0.36, 0.5, 0.64, 0.78, 0.94])


@dataclass(frozen=True)
class Piece:
    """Part of a rim between two nodes.

    Parameters
    ----------
    rim : int
    start, end : float
        Parameters on its curve.
    nodes : (int, int)
        Where it starts and ends.
    place : {"in", "out", "on"}
        Where it is in relation to the other section.
    away : float
        Farthest distance of its points from the other section's rims, where it is on them.
    """

    rim: int
    start: float
    end: float
    nodes: tuple[int, int]
    place: Place
    away: float


@dataclass(frozen=True)
class Overlay:
    """Two sections cut by each other.

    Parameters
    ----------
    nodes : (n, 2) float array
    below, above : list of Piece
        Of each section, rim by rim in the sense of its curve.
    """

    nodes: Floats
    below: list[Piece]
    above: list[Piece]


class _Nodes:
    """Points that are one when nearer to each other than a tolerance."""

    def __init__(self, tolerance: float) -> None:
        self.points = np.empty((0, 2))
        self._tolerance = tolerance

    def at(self, point: Floats) -> int:
        """Number of the node at a point, a new one if there is none."""
        if len(self.points):
            away = np.hypot(*(self.points - point).T)
            if away.min() <= self._tolerance:
                return int(away.argmin())
        self.points = np.vstack([self.points, point])
        return len(self.points) - 1


Cuts = list[list[tuple[float, int]]]
"""For each rim the parameters that it is cut at, and the nodes there."""


def overlay(below: Section, above: Section, tolerance: float) -> Overlay:
    """Cut two sections by each other.

    Parameters
    ----------
    below, above : Section
    tolerance : float
        Distance up to which rims and corners are taken for one.
    """
    nodes = _Nodes(2 * tolerance)
    lower, upper = _ends(below, nodes), _ends(above, nodes)
    _cut_at_corners(lower, below, above, upper, tolerance)
    _cut_at_corners(upper, above, below, lower, tolerance)
    for found in crossings(below, above, tolerance):
        node = nodes.at(below.rims[found.rim].curve.at(np.array([found.at]))[0])
        lower[found.rim].append((found.at, node))
        upper[found.other_rim].append((found.other_at, node))
    return Overlay(
        nodes.points,
        _pieces(below, lower, above, tolerance),
        _pieces(above, upper, below, tolerance),
    )


def _ends(section: Section, nodes: _Nodes) -> Cuts:
    found: Cuts = []
    for rim in section.rims:
        t = np.array([rim.curve.start, rim.curve.end])
        found.append([(float(at), nodes.at(point)) for at, point in zip(t, rim.curve.at(t), strict=True)])
    return found


def _cut_at_corners(own: Cuts, section: Section, other: Section, others: Cuts, tolerance: float) -> None:
    """Cut the other section's rims where corners of this one lie on them."""
    for rim, cuts in zip(section.rims, own, strict=True):
        (start, node), _ = cuts[:2]
        feet = other.feet(rim.curve.at(np.array([start])))
        if abs(feet.distance[0]) <= tolerance:
            others[int(feet.rim[0])].append((float(feet.at[0]), node))


def _pieces(section: Section, cuts: Cuts, other: Section, tolerance: float) -> list[Piece]:
    spans = [
        (rim, *span)
        for rim, (part, found) in enumerate(zip(section.rims, cuts, strict=True))
        for span in _spans(part.curve, sorted(found), tolerance)
    ]
    starts, ends = (np.array([span[i] for span in spans]) for i in (1, 2))
    rims = np.array([span[0] for span in spans])
    t = starts[:, None] + (ends - starts)[:, None] * WITHIN
    feet = other.feet(section.at(np.repeat(rims, len(WITHIN)), t.ravel()))
    distance = feet.distance.reshape(t.shape)
    farthest = distance[np.arange(len(t)), np.argmax(np.abs(distance), axis=1)]
    places: list[Place] = [
        "on" if abs(d) <= SLACK * tolerance else "in" if d < 0 else "out" for d in farthest
    ]
    return [
        Piece(*span, place, abs(float(d))) for span, place, d in zip(spans, places, farthest, strict=True)
    ]


def _spans(
    curve: PlanarCurve, cuts: Sequence[tuple[float, int]], tolerance: float
) -> list[tuple[float, float, tuple[int, int]]]:
    """From cut to cut; cuts at one node next to each other are one."""
    kept = [cuts[0]]
    for at, node in cuts[1:]:
        if node == kept[-1][1] and curve.length(kept[-1][0], at) <= 8 * tolerance:
            if at == curve.end and len(kept) > 1:
                kept[-1] = (at, node)
            continue
        kept.append((at, node))
    return [(t0, t1, (n0, n1)) for (t0, n0), (t1, n1) in pairwise(kept)]
