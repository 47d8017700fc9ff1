"""Periodic cubic splines with evenly spaced knots, piece by piece."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints

__all__ = ["basis_at", "curve_at", "locate", "pieces"]

POWERS = np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6
"""Coefficients of 1, t, t**2, t**3 of the 4 basis functions that are not 0 between two knots."""


def locate(u: Floats, count: int) -> tuple[Ints, Floats]:
    """Span (n,) of parameters u, once around from 0 to 1, and place within the span from 0 to 1."""
    x = np.mod(u, 1.0) * count
    span = np.minimum(x.astype(np.intp), count - 1)
    return span, x - span


def pieces(poles: Floats) -> Floats:
    """(4, d, k) coefficients of 1, t, t**2, t**3 on each span, for poles (k, d)."""
    # On span i the functions i - 3 to i are not 0: function 0 starts at u = 0, as in ClosedSpline.
    active = (np.arange(len(poles)) + np.arange(-3, 1)[:, None]) % len(poles)
    return np.einsum("pj,jkd->pdk", POWERS, poles[active])


def curve_at(coefficients: Floats, span: Ints, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Points (d, n), first and second derivatives by the place t within a span."""
    c0, c1, c2, c3 = np.take(coefficients, span, axis=2)
    first = c3 * t
    at = c0 + t * (c1 + t * (c2 + first))
    return at, c1 + t * (2 * c2 + 3 * first), 2 * c2 + 6 * first


def basis_at(span: Ints, t: Floats, count: int, derivative: int = 0) -> tuple[Ints, Floats]:
    """Indices (n, 4) and values of the basis functions that are not 0, or their derivatives by u."""
    one, nil = np.ones_like(t), np.zeros_like(t)
    powers = [
        [one, t, t * t, t * t * t],
        [nil, one, 2 * t, 3 * t * t],
        [nil, nil, 2 * one, 6 * t],
    ][derivative]
    values = count**derivative * np.stack(powers, axis=1) @ POWERS
    return (span[:, None] + np.arange(-3, 1)) % count, values
