"""The door to the CAD kernel: it is kept silent, and arrays cross here."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from OCP.collections import (
    Array1_double,
    Array1_gp_Pnt,
    Array1_int,
    Array2_double,
    Array2_gp_Pnt,
)
from OCP.Geom import Geom_BSplineCurve, Geom_BSplineSurface, Geom_Curve
from OCP.gp import gp_Dir, gp_Pnt
from OCP.Message import Message, Message_Gravity

from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface

__all__ = ["CONFUSION", "UP", "bspline_curve", "bspline_surface", "direction", "point", "skin_of"]

UP = gp_Dir(0, 0, 1)
CONFUSION = 1e-7
"""Absolute distance below which the kernel takes two points for one."""


def _silence() -> None:
    """Keep the kernel's chatter off standard output, where `--json` prints."""
    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)


_silence()


def point(xyz: ArrayLike) -> gp_Pnt:
    """Make a kernel point of three coordinates."""
    x, y, z = np.asarray(xyz, dtype=np.float64).tolist()
    return gp_Pnt(x, y, z)


def direction(xyz: ArrayLike) -> gp_Dir:
    """Make a kernel direction of a vector of any length but 0."""
    x, y, z = np.asarray(xyz, dtype=np.float64).tolist()
    return gp_Dir(x, y, z)


def bspline_curve(poles: Floats, weights: Floats | None, knots: Floats, degree: int) -> Geom_Curve:
    """Make a B-spline curve.

    Parameters
    ----------
    poles : (n, 3) float array
    weights : (n,) float array or None
    knots : (n + degree + 1,) float array
        With repetitions.
    degree : int
    """
    rows = Array1_gp_Pnt(1, len(poles))
    for i, (x, y, z) in enumerate(poles.tolist(), start=1):
        rows.SetValue(i, gp_Pnt(x, y, z))
    values, counts = _knots(knots)
    if weights is None:
        return Geom_BSplineCurve(rows, values, counts, degree)
    return Geom_BSplineCurve(rows, _reals(weights), values, counts, degree)


def bspline_surface(surface: SkinSurface) -> Geom_BSplineSurface:
    """Make a B-spline surface, u around and v along as in `surface`."""
    n_along, n_around = surface.poles.shape[:2]
    grid = Array2_gp_Pnt(1, n_around, 1, n_along)
    for j, row in enumerate(surface.poles.tolist(), start=1):
        for i, (x, y, z) in enumerate(row, start=1):
            grid.SetValue(i, j, gp_Pnt(x, y, z))
    u_values, u_counts = _knots(surface.u_knots)
    v_values, v_counts = _knots(surface.v_knots)
    shape = (u_values, v_values, u_counts, v_counts, surface.u_degree, surface.v_degree)
    if surface.weights is None:
        return Geom_BSplineSurface(grid, *shape)
    weights = Array2_double(1, n_around, 1, n_along)
    for j, row in enumerate(surface.weights.tolist(), start=1):
        for i, weight in enumerate(row, start=1):
            weights.SetValue(i, j, weight)
    return Geom_BSplineSurface(grid, weights, *shape)


def skin_of(surface: Geom_BSplineSurface) -> SkinSurface:
    """Read a B-spline surface back into arrays, u and v as they are; a periodic one is cut at its seam."""
    surface = surface.Copy()
    surface.SetUNotPeriodic()
    surface.SetVNotPeriodic()
    grid = surface.Poles()
    n_around, n_along = surface.NbUPoles(), surface.NbVPoles()
    cells = [grid.Value(i, j) for j in range(1, n_along + 1) for i in range(1, n_around + 1)]
    poles = np.array([(cell.X(), cell.Y(), cell.Z()) for cell in cells]).reshape(n_along, n_around, 3)
    weights = None
    if surface.IsURational() or surface.IsVRational():
        rows = [[surface.Weight(i, j) for i in range(1, n_around + 1)] for j in range(1, n_along + 1)]
        weights = np.array(rows)
    # The outermost knots of a surface that was periodic lie outside, where they have no effect.
    u0, u1, v0, v1 = surface.Bounds()
    return SkinSurface(
        poles,
        np.clip(_values(surface.UKnotSequence()), u0, u1),
        np.clip(_values(surface.VKnotSequence()), v0, v1),
        surface.UDegree(),
        surface.VDegree(),
        weights,
    )


def _values(array: Array1_double) -> Floats:
    return np.array([array.Value(i) for i in range(array.Lower(), array.Upper() + 1)])


def _knots(knots: Floats) -> tuple[Array1_double, Array1_int]:
    values, counts = np.unique(knots, return_counts=True)
    multiplicities = Array1_int(1, len(counts))
    for i, count in enumerate(counts.tolist(), start=1):
        multiplicities.SetValue(i, count)
    return _reals(values), multiplicities


def _reals(values: Floats) -> Array1_double:
    array = Array1_double(1, len(values))
    for i, value in enumerate(values.tolist(), start=1):
        array.SetValue(i, value)
    return array
