"""Fitted loop: the closed spline of few poles nearest to a curve, its knots where the curve needs them."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.spline_loop import SplineLoop, spline_loop
from sketchloft.periodic_cubic import curve_at, locate, pieces
from sketchloft.shapes.spline import periodic_basis, resampled

__all__ = ["fitted_loop"]

PER_POLE = 12
"""Places on the curve for each pole."""
ROUNDS = 30
PHASES = 0.0, 0.5
"""Where the first knots are, in spans: knots in step with waves meet them best from one of these."""


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
    fits = [_followed(places, phase, count) for phase in PHASES]
    poles, _ = min(fits, key=lambda fit: fit[1])
    return spline_loop(poles)


def _followed(places: Floats, phase: float, count: int) -> tuple[Floats, float]:
    """Poles of the spline nearest to places (m, 2) from knots at a phase, and their squared distance."""
    u = np.arange(len(places)) / len(places) + phase / count
    poles, missed = _nearest(places, u, count)
    for _ in range(ROUNDS):
        at, along, _ = curve_at(pieces(poles), *locate(u, count))
        step = np.einsum("di,di->i", places.T - at, along) / np.maximum((along**2).sum(axis=0), 1e-300)
        u = u + np.clip(step, -0.5, 0.5) / count
        poles, missed = _nearest(places, u, count)
    return poles, missed


def _nearest(places: Floats, u: Floats, count: int) -> tuple[Floats, float]:
    """Poles of the spline that is nearest to places (m, 2) at parameters u, and the sum of squares left."""
    basis = periodic_basis(u, count)
    poles = np.asarray(np.linalg.lstsq(basis, places, rcond=None)[0], dtype=float)
    return poles, float(np.square(basis @ poles - places).sum())
