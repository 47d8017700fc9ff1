"""Tilt: small turns of the slicing direction."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["onto_z", "tilted"]


def tilted(a: float, b: float) -> Floats:
    """Rotation (3, 3), to multiply points by from the right, that turns them by the vector (a, b, 0).

    Notes
    -----
    Rodrigues' formula.
    """
    angle = float(np.hypot(a, b))
    if angle == 0:
        return np.eye(3)
    skew = np.array([[0.0, 0.0, b], [0.0, 0.0, -a], [-b, a, 0.0]])
    matrix = np.eye(3) + np.sin(angle) / angle * skew + (1 - np.cos(angle)) / angle**2 * skew @ skew
    return np.asarray(matrix.T, dtype=np.float64)


def onto_z(slope: Floats) -> Floats:
    """Smallest rotation, to multiply points by from the right, that brings (slope, 1) onto z."""
    steep = float(np.hypot(*slope))
    share = np.arctan(steep) / steep if steep else 0.0
    return tilted(share * float(slope[1]), -share * float(slope[0]))
