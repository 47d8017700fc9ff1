"""Fitted loop: the closed spline of few poles nearest to a curve, its knots where the curve needs them."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.periodic_cubic import basis_at, curve_at, locate, pieces
from sketchloft.outline.spline_loop import SplineLoop, spline_loop
from sketchloft.shapes.spline import fit_spline, resampled

__all__ = ["fitted_loop"]

PER_POLE = 12
"""Places on the curve for each pole."""
ROUNDS = 30


def fitted_loop(ring: Floats, count: int) -> SplineLoop:
    """Closed spline nearest to a curve, along which its parameter may run as fast or slow as suits it.

    Parameters
    ----------
    ring : (m, 2) float array
        Points in order, counter-clockwise.
    count : int
        Number of poles.

    Notes
    -----
    Knots that are even along the curve waste poles on its straight parts. The parameter of each place is
    moved towards its foot on the spline, and the spline fitted again. A rough curve, like a contour of few
    points, is followed into its bays: there knots had better stay even.

    References
    ----------
    J. Hoschek, Intrinsic parametrization for approximation, Comput. Aided Geom. Des. 5 (1988).
    """
    places = resampled(ring, PER_POLE * count)
    poles = fit_spline(ring, count).poles
    u = np.arange(len(places)) / len(places)
    for _ in range(ROUNDS):
        span, t = locate(u, count)
        at, along, _ = curve_at(pieces(poles), span, t)
        step = np.einsum("di,di->i", places.T - at, along) / np.maximum((along**2).sum(axis=0), 1e-300)
        u = u + np.clip(step, -0.5, 0.5) / count
        columns, values = basis_at(*locate(u, count), count)
        rows = np.zeros((len(places), count))
        np.put_along_axis(rows, columns, values, axis=1)
        poles = np.asarray(np.linalg.lstsq(rows, places, rcond=None)[0], dtype=float)
    return spline_loop(poles)
