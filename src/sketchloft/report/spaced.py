"""Spaced: places of labels that would overlap, moved apart as little as is needed."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["spaced"]


def spaced(places: Floats, apart: float) -> Floats:
    """Rising places (m,) so moved that neighbours are at least so far apart.

    Notes
    -----
    Isotonic regression of what is left when the least distances are taken off: least squares.
    """
    from scipy.optimize import isotonic_regression  # noqa: PLC0415

    rise = apart * np.arange(len(places))
    return np.asarray(isotonic_regression(places - rise).x + rise)
