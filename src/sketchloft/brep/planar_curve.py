"""Planar curves: the edges of level sections as plain formulas."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.GeomAbs import GeomAbs_CurveType
from OCP.gp import gp_Circ, gp_Elips
from OCP.TopoDS import TopoDS_Edge

from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.gauss import gauss
from sketchloft.surface import basis_matrix

__all__ = ["PlanarCurve", "curve_of"]


@dataclass(frozen=True)
class PlanarCurve:
    """A curve in the plane, in the parameter of the edge that it is of.

    Parameters
    ----------
    frame : (3, 2) float array
        Of a line origin and direction; of a circle or an ellipse centre and the two semi-axes.
    poles : (k, 2) float array
    weights : (k,) float array
    knots : (k + degree + 1,) float array
    degree : int
        Of a B-spline. They are empty for other curves, and the degree is 1 for a line, 0 for a conic.
    start, end : float
        From and to.
    """

    frame: Floats
    poles: Floats
    weights: Floats
    knots: Floats
    degree: int
    start: float
    end: float

    def at(self, t: Floats, derivative: int = 0) -> Floats:
        """Points (m, 2) at parameters (m,), or first derivatives."""
        if len(self.poles):
            return self._spline(t, derivative)
        origin, x, y = self.frame
        if self.degree:
            return origin + t[:, None] * x if not derivative else np.broadcast_to(x, (len(t), 2))
        cos, sin = np.cos(t)[:, None], np.sin(t)[:, None]
        return origin + cos * x + sin * y if not derivative else cos * y - sin * x

    def _spline(self, t: Floats, derivative: int) -> Floats:
        values = basis_matrix(self.knots, self.degree, t) * self.weights
        rate = values.sum(axis=1)[:, None]
        points: Floats = values @ self.poles / rate
        if not derivative:
            return points
        slopes = basis_matrix(self.knots, self.degree, t, 1) * self.weights
        return (slopes @ self.poles - slopes.sum(axis=1)[:, None] * points) / rate

    @property
    def ends(self) -> Floats:
        """Where smooth pieces end: start, inner knots, end."""
        if not len(self.poles):
            return np.array([self.start, self.end])
        inner = self.knots[(self.knots > self.start) & (self.knots < self.end)]
        return np.unique(np.concatenate([[self.start], inner, [self.end]]))

    def spread(self, per_turn: int) -> Floats:
        """Parameters from start to end, about evenly, so many for a full turn; a line counts as a quarter."""
        if len(self.poles):
            ends = self.ends
            count = max(4, -(-per_turn // (len(ends) - 1)))
            steps = np.arange(count) / count
            return np.append((ends[:-1, None] + np.diff(ends)[:, None] * steps).ravel(), ends[-1])
        share = 0.25 if self.degree else (self.end - self.start) / (2 * np.pi)
        return np.linspace(self.start, self.end, max(4, int(np.ceil(per_turn * share))) + 1)

    def length(self, start: float, end: float) -> float:
        """Length of a short part; of a long one about it."""
        return float(np.hypot(*np.diff(self.at(np.linspace(start, end, 5)), axis=0).T).sum())

    def swept_area(self, start: float, end: float, origin: Floats) -> float:
        """Area that the ray from an origin sweeps, walking the curve from one parameter to another."""
        inner = self.ends
        ends = np.concatenate([[start], inner[(inner > start) & (inner < end)], [end]])
        x, w = GAUSS
        half = np.diff(ends)[:, None] / 2
        t, weights = (ends[:-1, None] + half * (1 + x)).ravel(), (half * w).ravel()
        arms, steps = self.at(t) - origin, self.at(t, 1)
        return float(weights @ (arms[:, 0] * steps[:, 1] - arms[:, 1] * steps[:, 0])) / 2


GAUSS = gauss(16)


def curve_of(edge: TopoDS_Edge) -> PlanarCurve:
    """Curve of a level edge, seen from above.

    Raises
    ------
    ModelError
        If the edge is neither straight, circular, elliptic nor a B-spline.
    """
    adaptor = BRepAdaptor_Curve(edge)
    start, end = adaptor.FirstParameter(), adaptor.LastParameter()
    none = np.empty(0)
    kind = adaptor.GetType()
    if kind == GeomAbs_CurveType.GeomAbs_Line:
        at, along = adaptor.Line().Location(), adaptor.Line().Direction()
        frame = np.array([(at.X(), at.Y()), (along.X(), along.Y()), (0.0, 0.0)])
        return PlanarCurve(frame, none.reshape(0, 2), none, none, 1, start, end)
    if kind in (GeomAbs_CurveType.GeomAbs_Circle, GeomAbs_CurveType.GeomAbs_Ellipse):
        conic = adaptor.Circle() if kind == GeomAbs_CurveType.GeomAbs_Circle else adaptor.Ellipse()
        return PlanarCurve(_axes(conic), none.reshape(0, 2), none, none, 0, start, end)
    if kind != GeomAbs_CurveType.GeomAbs_BSplineCurve:
        raise ModelError(
            f"a section has an edge of kind {kind.name}, which cannot be joined to another section"
        )
    spline = adaptor.BSpline()
    count = spline.NbPoles()
    poles = np.array([(spline.Pole(i).X(), spline.Pole(i).Y()) for i in range(1, count + 1)])
    weights = np.array([spline.Weight(i) for i in range(1, count + 1)])
    sequence = spline.KnotSequence()
    knots = np.array([sequence.Value(i) for i in range(1, sequence.Length() + 1)])
    return PlanarCurve(np.zeros((3, 2)), poles, weights, knots, spline.Degree(), start, end)


def _axes(conic: gp_Circ | gp_Elips) -> Floats:
    major, minor = (
        (conic.Radius(), conic.Radius())
        if isinstance(conic, gp_Circ)
        else (conic.MajorRadius(), conic.MinorRadius())
    )
    centre, x, y = conic.Location(), conic.XAxis().Direction(), conic.YAxis().Direction()
    return np.array(
        [(centre.X(), centre.Y()), (major * x.X(), major * x.Y()), (minor * y.X(), minor * y.Y())]
    )
