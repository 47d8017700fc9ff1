"""Greville abscissae of a knot vector."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["greville"]


def greville(knots: Floats, degree: int) -> Floats:
    """Means of `degree` knots in a row: as many places as poles, where a spline is well determined."""
    return np.array([knots[i + 1 : i + degree + 1].mean() for i in range(len(knots) - degree - 1)])
