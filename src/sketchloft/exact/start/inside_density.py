"""Inside density: how densely the thing was drawn, place by place, before its walls are known."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.density import Density, regressed
from sketchloft.exact.section.level_set import LevelSet

__all__ = ["inside_density"]

DEEP = 0.7
"""Level above which a cell lies away from the walls."""
PRICE = 3.0
"""Log likelihood that each further term must gain, in logarithms of the number of points."""


def inside_density(points: Floats, grid: LevelSet, together: float) -> Density:
    """Fit the points (n, 3) in the cells deep inside by a density of 1, 4 or 10 terms.

    Notes
    -----
    Poisson regression on the counts; terms are added only where the likelihood, divided by the number
    of points that go together, rises by more than they cost.
    """
    deep = np.argwhere(grid.inside & (grid.level > DEEP))
    counts = grid.counts[tuple(deep.T)].astype(float)
    at = grid.origin + grid.cell * deep
    best = np.array([np.log(len(points) / (grid.inside.sum() * grid.cell**3))])
    if len(deep) < 30:
        return Density(best)
    mean = np.log(max(counts.mean(), 1e-6))
    value = -np.inf
    for terms in (1, 4, 10):
        rows = Density.terms(at, terms)
        coefficients = np.zeros(terms)
        coefficients[0] = mean
        coefficients = regressed(coefficients, rows, np.ones(len(rows)), counts @ rows, steps=8)
        rate = np.clip(rows @ coefficients, -30, 30)
        price = PRICE * terms * np.log(len(points) / together)
        found = float(counts @ rate - np.exp(rate).sum()) / together - price
        if found > value:
            value, best = found, coefficients.copy()
            best[0] -= 3 * np.log(grid.cell)
    return Density(best)
