"""Density: how densely the inside was drawn, place by place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["Density", "regressed"]

STEEPEST = 50.0
"""Largest logarithm of a density that is believed."""


@dataclass(frozen=True)
class Density:
    """Points per volume inside: exp of a polynomial in x, y, z.

    Parameters
    ----------
    coefficients : (1,), (4,) or (10,) float array
        Of 1; x, y, z; x², y², z², xy, xz, yz.
    """

    coefficients: Floats

    def at(self, points: Floats) -> Floats:
        """Density (n,) at points (n, 3)."""
        if len(self.coefficients) == 1:
            return np.full(len(points), np.exp(self.coefficients[0]))
        terms = self.terms(points, len(self.coefficients))
        return np.asarray(np.exp(np.clip(terms @ self.coefficients, -STEEPEST, STEEPEST)), dtype=np.float64)

    def times(self, factor: float) -> Density:
        """The density of so many times as many points."""
        coefficients = self.coefficients.copy()
        coefficients[0] += np.log(factor)
        return Density(coefficients)

    @staticmethod
    def terms(points: Floats, count: int) -> Floats:
        """Values (n, count) of the polynomial's terms."""
        terms = np.ones((len(points), count))
        if count > 1:
            terms[:, 1:4] = points
        if count > 4:
            x, y, z = points.T
            for k, product in enumerate((x * x, y * y, z * z, x * y, x * z, y * z), 4):
                terms[:, k] = product
        return terms


def regressed(coefficients: Floats, terms: Floats, weights: Floats, totals: Floats, *, steps: int) -> Floats:
    """Newton steps of a Poisson regression.

    Parameters
    ----------
    coefficients : (t,) float array
        To start from.
    terms : (m, t) float array
        Values of the terms at places.
    weights : (m,) float array
        Volume that each place stands for.
    totals : (t,) float array
        Sum of the terms over the points.
    steps : int
    """
    for _ in range(steps):
        rate = np.exp(np.clip(terms @ coefficients, -STEEPEST, STEEPEST)) * weights
        information = terms.T @ (rate[:, None] * terms)
        ridge = 1e-9 * np.trace(information) * np.eye(len(coefficients))
        coefficients = coefficients + np.linalg.solve(information + ridge, totals - rate @ terms)
    return coefficients
