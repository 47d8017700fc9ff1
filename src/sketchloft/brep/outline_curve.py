"""The edges of outlines as the kernel's curves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from OCP.Convert import Convert_ParameterisationType
from OCP.Geom import Geom_Circle, Geom_Conic, Geom_Ellipse, Geom_TrimmedCurve
from OCP.GeomConvert import GeomConvert
from OCP.gp import gp_Ax2, gp_Dir

from sketchloft.brep.greville import greville
from sketchloft.brep.kernel import direction, point
from sketchloft.cloud import Floats
from sketchloft.outline.outline import Arc, Closed, Edge, Segment
from sketchloft.shapes.spline import ClosedSpline
from sketchloft.surface import basis_matrix, even_knots

__all__ = ["Conic", "Nurbs", "conic_of", "nurbs_of"]

ONE_SPAN = 2.0
"""Sweep in radians up to which an arc is written as one quadratic piece; the weights stay moderate."""


@dataclass(frozen=True)
class Conic:
    """Part of a circle or an ellipse in the plane, `centre + cos(t) * major * x + sin(t) * minor * y`.

    Parameters
    ----------
    centre : (2,) float array
    major, minor : float
        Equal for a circle.
    x : (2,) float array
        Unit vector; y is a quarter turn counter-clockwise from it.
    sweep : float
        t goes from 0 to this.
    ahead : bool
        Whether the outline runs along it with growing t.
    """

    centre: Floats
    major: float
    minor: float
    x: Floats
    sweep: float
    ahead: bool = True

    def at(self, height: float) -> Geom_Conic:
        """The whole curve at a height."""
        axes = gp_Ax2(point((*self.centre, height)), gp_Dir(0, 0, 1), direction((*self.x, 0.0)))
        if self.major == self.minor:
            return Geom_Circle(axes, self.major)
        return Geom_Ellipse(axes, self.major, self.minor)

    @property
    def start(self) -> Floats:
        """Where t is 0."""
        return self.centre + self.major * self.x


@dataclass(frozen=True)
class Nurbs:
    """A clamped rational curve in the plane: poles (k, 2), weights (k,) or None, knots, degree."""

    poles: Floats
    weights: Floats | None
    knots: Floats
    degree: int


def conic_of(edge: Arc | Closed) -> Conic:
    """The circle or ellipse that an edge is on."""
    if isinstance(edge, Closed):
        centre, (major, minor) = edge.poles[:2]
        x = edge.poles[2] if edge.kind == "ellipse" else np.array([1.0, 0.0])
        return Conic(centre, float(major), float(minor), x, 2 * np.pi)
    a, b = edge.middle - edge.start, edge.end - edge.start
    turn = float(a[0] * b[1] - a[1] * b[0])
    # Circumcentre of the three points, seen from the start.
    arm = np.array([b[1] * (a @ a) - a[1] * (b @ b), a[0] * (b @ b) - b[0] * (a @ a)]) / (2 * turn)
    centre, radius = edge.start + arm, float(np.hypot(*arm))
    ahead = turn > 0
    first, last = (edge.start, edge.end) if ahead else (edge.end, edge.start)
    x, end = (first - centre) / radius, last - centre
    sweep = float(np.arctan2(x[0] * end[1] - x[1] * end[0], x @ end)) % (2 * np.pi)
    return Conic(centre, radius, radius, x, sweep, ahead)


def nurbs_of(edge: Edge) -> Nurbs:
    """The edge as a rational curve, exactly; a closed one is cut where it starts."""
    if isinstance(edge, Segment):
        return Nurbs(np.array([edge.start, edge.end]), None, np.array([0.0, 0, 1, 1]), 1)
    if isinstance(edge, Closed) and edge.kind == "spline":
        return _cut_open(edge.poles)
    conic = conic_of(edge)
    kind = Convert_ParameterisationType
    how = kind.Convert_TgtThetaOver2 if conic.sweep <= ONE_SPAN else kind.Convert_QuasiAngular
    made = GeomConvert.CurveToBSplineCurve_s(Geom_TrimmedCurve(conic.at(0.0), 0.0, conic.sweep), how)
    count = made.NbPoles()
    poles = np.array([(made.Pole(i).X(), made.Pole(i).Y()) for i in range(1, count + 1)])
    weights = np.array([made.Weight(i) for i in range(1, count + 1)])
    sequence = made.KnotSequence()
    knots = np.array([sequence.Value(i) for i in range(1, sequence.Length() + 1)])
    if not conic.ahead:
        poles, weights, knots = poles[::-1], weights[::-1], knots[0] + knots[-1] - knots[::-1]
    if isinstance(edge, Closed):
        poles[-1] = poles[0]
    return Nurbs(poles, weights, knots, made.Degree())


def _cut_open(poles: Floats) -> Nurbs:
    knots = even_knots(0.0, 1.0, len(poles))
    sites = greville(knots, 3)
    clamped: Floats = np.linalg.inv(basis_matrix(knots, 3, sites)) @ ClosedSpline(poles).evaluate(sites)
    clamped[-1] = clamped[0]
    return Nurbs(clamped, None, knots, 3)
