"""SkinSurface: the B-spline skin of a loft, as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from sketchloft.cloud import Floats

__all__ = ["SkinSurface", "basis_matrix", "distinct_knots", "evaluate"]


@dataclass(frozen=True)
class SkinSurface:
    """A B-spline surface closed around u, open along v: the skin of a loft.

    Parameters
    ----------
    poles : (nv, nu, 3) float array
        Control points, one row per section. The first and the last pole of a row are equal.
    u_knots : (nu + u_degree + 1,) float array
        Knots around, each as often as its multiplicity, clamped: the first and the last are
        repeated u_degree + 1 times. An inner knot of multiplicity u_degree allows a sharp edge.
    v_knots : (nv + v_degree + 1,) float array
        Knots along, clamped in the same way.
    u_degree, v_degree : int
    weights : (nv, nu) float array, optional
        Positive weights of a rational surface.
    """

    poles: Floats
    u_knots: Floats
    v_knots: Floats
    u_degree: int
    v_degree: int
    weights: Floats | None = None


def distinct_knots(knots: Floats) -> Floats:
    """Return the knots once each, in rising order: the ends of the polynomial spans."""
    return np.unique(knots)


def basis_matrix(knots: Floats, degree: int, at: ArrayLike, derivative: int = 0) -> Floats:
    """Values of all B-spline basis functions, or of one of their derivatives.

    Parameters
    ----------
    knots : (n + degree + 1,) float array
        Clamped knot vector.
    degree : int
    at : (m,) array_like
        Parameters; those outside the knots are taken to the nearer end.
    derivative : int
        0 for the values, 1 for the first derivative.

    Returns
    -------
    (m, n) float array
        Row i holds the n basis functions at `at[i]`; at an inner knot the span to its right counts,
        at the last knot the span to its left.

    References
    ----------
    L. Piegl, W. Tiller, The NURBS Book, 2nd ed., Springer 1997, sections 2.2-2.3.
    """
    x = np.clip(np.atleast_1d(np.asarray(at, dtype=np.float64)), knots[0], knots[-1])[:, None]
    n = len(knots) - degree - 1
    span = np.clip(np.searchsorted(knots, x[:, 0], side="right") - 1, degree, n - 1)
    values = np.zeros((len(x), len(knots) - 1))
    values[np.arange(len(x)), span] = 1.0
    for p in range(1, degree + 1):
        count = len(knots) - 1 - p
        left, right = knots[:count], knots[p + 1 : p + 1 + count]
        rise = _inverse(knots[p : p + count] - left)
        fall = _inverse(right - knots[1 : 1 + count])
        if p > degree - derivative:
            values = p * (rise * values[:, :-1] - fall * values[:, 1:])
        else:
            values = (x - left) * rise * values[:, :-1] + (right - x) * fall * values[:, 1:]
    return values


def evaluate(
    surface: SkinSurface, u: ArrayLike, v: ArrayLike, u_derivative: int = 0, v_derivative: int = 0
) -> Floats:
    """Points or first derivatives of the surface on a grid of parameters.

    Parameters
    ----------
    surface : SkinSurface
    u : (a,) array_like
        Parameters around, within `surface.u_knots`.
    v : (b,) array_like
        Parameters along, within `surface.v_knots`.
    u_derivative, v_derivative : int
        0 and 0 for points, 1 and 0 for the derivative around, 0 and 1 for the one along.

    Returns
    -------
    (b, a, 3) float array
    """
    around = basis_matrix(surface.u_knots, surface.u_degree, u, u_derivative)
    along = basis_matrix(surface.v_knots, surface.v_degree, v, v_derivative)
    if surface.weights is None:
        return _blend(surface.poles, around, along)
    weights = surface.weights[..., None]
    weighted = _blend(surface.poles * weights, around, along)
    if not u_derivative and not v_derivative:
        return weighted / _blend(weights, around, along)
    # The quotient rule (NURBS Book, eq. 4.8).
    u_basis = basis_matrix(surface.u_knots, surface.u_degree, u)
    v_basis = basis_matrix(surface.v_knots, surface.v_degree, v)
    rate, total = _blend(weights, around, along), _blend(weights, u_basis, v_basis)
    return (weighted - rate * evaluate(surface, u, v)) / total


def _blend(rows: Floats, around: Floats, along: Floats) -> Floats:
    columns: Floats = np.tensordot(along, rows, axes=(1, 0))
    blended: Floats = np.einsum("au,buk->bak", around, columns, optimize=True)
    return blended


def _inverse(widths: Floats) -> Floats:
    """1 / width, and 0 for a span of no width (the usual convention for repeated knots)."""
    return np.divide(1.0, widths, out=np.zeros_like(widths), where=widths > 0)
