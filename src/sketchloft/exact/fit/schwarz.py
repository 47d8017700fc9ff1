"""Schwarz's criterion: what a model's parameters must gain in likelihood to be worth having."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.likelihood import value_of
from sketchloft.exact.model.exact_model import ExactModel

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


def evidence(points: Floats, model: ExactModel, together: float) -> float:
    """Log likelihood of the points (n, 3) of a stretch without caps, less the price of the walls."""
    return value_of(points, model, caps=False) / together - price(model.size, len(points), together)
