"""Schwarz's criterion: what a model's parameters must gain in likelihood to be worth having."""

from __future__ import annotations

import numpy as np

from sketchloft.exact.fit.likelihood import Evaluation

__all__ = ["evidence", "price"]


def price(parameters: int, count: int, together: float) -> float:
    """Log likelihood that so many parameters must gain.

    Parameters
    ----------
    parameters : int
    count : int
        Number of points.
    together : float
        How many of them go together.

    References
    ----------
    G. Schwarz, Estimating the dimension of a model, Ann. Statist. 6 (1978) 461-464.
    """
    return 0.5 * parameters * float(np.log(max(count / together, 3.0)))


def evidence(seen: Evaluation, together: float) -> float:
    """Log likelihood of the points of a stretch, less the price of the walls."""
    return seen.value / together - price(seen.model.size, len(seen.points), together)
