"""Outline: a closed curve of a section, with the distance of points from it and how that distance moves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, Self

from sketchloft.cloud import Floats

__all__ = ["Arc", "Boundary", "Closed", "Edge", "Foot", "Outline", "Segment"]


@dataclass(frozen=True)
class Foot:
    """What points see of the nearest piece of an outline.

    Parameters
    ----------
    distance : (n,) float array
        Signed distance, positive outside.
    normal : (n, 2) float array
        Unit gradient of the distance.
    slopes : callable
        Finds the gradient, which many who ask for the distance have no use for.
    curvature : (n,) float array
        Of the outline at the foot, positive where it is convex; 0 on lines and at corners.
    """

    distance: Floats
    normal: Floats
    slopes: Callable[[], Floats]
    curvature: Floats

    @cached_property
    def gradient(self) -> Floats:
        """Derivative (n, p) of the distance by the outline's parameters."""
        return self.slopes()


@dataclass(frozen=True)
class Boundary:
    """Points spread along an outline, counter-clockwise, none at a corner, to integrate with.

    Parameters
    ----------
    points : (m, 2) float array
    normals : (m, 2) float array
        Outward unit normals.
    lengths : (m,) float array
        Length that each point stands for; they add up to the perimeter.
    """

    points: Floats
    normals: Floats
    lengths: Floats


@dataclass(frozen=True)
class Segment:
    """A straight edge between two points (2,)."""

    start: Floats
    end: Floats


@dataclass(frozen=True)
class Arc:
    """A circular edge from start over a middle point to end, each (2,)."""

    start: Floats
    middle: Floats
    end: Floats


@dataclass(frozen=True)
class Closed:
    """An edge that is the whole outline: a full circle, full ellipse or periodic spline, as a NURBS curve.

    Parameters
    ----------
    kind : {"circle", "ellipse", "spline"}
    poles : (k, 2) float array
        For a circle: centre and (radius, radius); for an ellipse: centre, (major, minor), and the unit
        direction of the major axis; for a spline: the poles of a periodic cubic with evenly spaced knots,
        `sketchloft.shapes.spline.ClosedSpline`.
    """

    kind: str
    poles: Floats


Edge = Segment | Arc | Closed


class Outline(Protocol):
    """A closed curve in the plane that a vector of parameters moves.

    Frozen dataclasses; `moved(vector)` returns one of the same kind with other parameters.
    """

    @property
    def kind(self) -> str:
        """What it is called: "circle", "rounded rectangle", ..."""

    @property
    def vector(self) -> Floats:
        """Parameters (p,). Lengths but for angles in radians."""

    def moved(self, vector: Floats) -> Self:
        """Return the outline of the same kind with other parameters (p,)."""

    @property
    def area(self) -> float:
        """Enclosed area, positive."""

    def foot(self, points: Floats) -> Foot:
        """Signed distance of points (n, 2), and its derivatives."""

    def boundary(self, count: int) -> Boundary:
        """About `count` points along it, to integrate with."""

    def edges(self) -> tuple[Edge, ...]:
        """Its edges, counter-clockwise, each starting where the last one ended."""
