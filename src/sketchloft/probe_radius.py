"""The probe radius of an alpha shape, by a rule that follows from how random points are spaced."""

from __future__ import annotations

import numpy as np

from sketchloft.alpha_shape import AlphaComplex

__all__ = ["small_probe_radius"]


def small_probe_radius(shape: AlphaComplex, expected_holes: float = 0.1) -> float:
    """Smallest probe radius that is not expected to fall into the cloud.

    In an even random cloud the circumscribed balls of the Delaunay simplices follow a Gamma law:
    with d the dimension, `density * ball volume` is Gamma(d) distributed. The median radius gives the
    density, the number of simplices says how far out the tail must be cut so that only
    `expected_holes` simplices within the cloud are larger than the probe.

    Parameters
    ----------
    shape : AlphaComplex
    expected_holes : float
        How many simplices inside the cloud the probe may enter, on average.

    Returns
    -------
    float

    References
    ----------
    R. E. Miles, On the homogeneous planar Poisson point process, Mathematical Biosciences 6, 1970.
    """
    dimension = shape.points.shape[1]
    tail = min(0.4, expected_holes / len(shape.simplices))
    median, far = _gamma_quantile(dimension, 0.5), _gamma_quantile(dimension, tail)
    return float(np.median(shape.radii) * (far / median) ** (1 / dimension))


def _gamma_quantile(shape: int, upper_tail: float) -> float:
    """x with P(Gamma(shape) > x) = upper_tail, for shape 2 or 3, by Newton's method on its logarithm."""
    x = float(shape) - np.log(upper_tail)
    for _ in range(30):
        series = 1 + x + (x * x / 2 if shape == 3 else 0.0)
        density = x ** (shape - 1) / (2 if shape == 3 else 1)
        x -= (x - np.log(series) + np.log(upper_tail)) / (density / series)
    return x
