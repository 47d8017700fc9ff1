"""SkinSurface: the B-spline skin of a loft, as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from sketchloft.cloud import Floats, Ints

__all__ = [
    "SkinSurface",
    "basis_matrix",
    "distinct_knots",
    "evaluate",
    "even_knots",
    "local_bases",
    "local_basis",
    "spline_at",
]


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


def even_knots(low: float, high: float, spans: int, degree: int = 3) -> Floats:
    """Clamped knots (spans + 2 degree + 1,) that divide an interval evenly."""
    inner = np.linspace(low, high, spans + 1)
    return np.r_[np.repeat(inner[0], degree), inner, np.repeat(inner[-1], degree)]


def distinct_knots(knots: Floats) -> Floats:
    """Return the knots once each, in rising order: the ends of the polynomial spans."""
    return np.unique(knots)


def basis_matrix(knots: Floats, degree: int, at: ArrayLike, derivative: int = 0) -> Floats:
    """Values of all B-spline basis functions, or of their first derivatives.

    Parameters
    ----------
    knots : (n + degree + 1,) float array
        Clamped knot vector.
    degree : int
    at : (m,) array_like
        Parameters; those outside the knots are taken to the nearer end.
    derivative : int
        0 for the values, 1 for the first derivatives.

    Returns
    -------
    (m, n) float array
        Row i holds the n basis functions at `at[i]`; at an inner knot the span to its right counts,
        at the last knot the span to its left.

    References
    ----------
    L. Piegl, W. Tiller, The NURBS Book, 2nd ed., Springer 1997, sections 2.2-2.5.
    """
    first, values = local_basis(knots, degree, at, derivative)
    matrix = np.zeros((len(first), len(knots) - degree - 1))
    np.put_along_axis(matrix, first[:, None] + np.arange(degree + 1), values, axis=1)
    return matrix


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
    around = local_basis(surface.u_knots, surface.u_degree, u, u_derivative)
    along = local_basis(surface.v_knots, surface.v_degree, v, v_derivative)
    if surface.weights is None:
        return _blend(surface.poles, around, along)
    weights = surface.weights[..., None]
    weighted = _blend(surface.poles * weights, around, along)
    rate = _blend(weights, around, along)
    if not u_derivative and not v_derivative:
        return weighted / rate
    # The quotient rule (NURBS Book, eq. 4.8).
    u_basis = local_basis(surface.u_knots, surface.u_degree, u)
    v_basis = local_basis(surface.v_knots, surface.v_degree, v)
    return (weighted - rate * evaluate(surface, u, v)) / _blend(weights, u_basis, v_basis)


def local_basis(knots: Floats, degree: int, at: ArrayLike, derivative: int = 0) -> tuple[Ints, Floats]:
    """Index (m,) of the first basis function that is not 0, and the degree + 1 of them from there on.

    As `basis_matrix`, without the zeros.
    """
    first, values, slopes = local_bases(knots, degree, at)
    return first, slopes if derivative else values


def spline_at(knots: Floats, degree: int, poles: Floats, at: ArrayLike) -> tuple[Floats, Floats]:
    """Values (m,) and first derivatives of the spline of poles (n,) at parameters (m,)."""
    first, values, slopes = local_bases(knots, degree, at)
    near = poles[first[:, None] + np.arange(degree + 1)]
    return np.einsum("ij,ij->i", values, near), np.einsum("ij,ij->i", slopes, near)


def local_bases(knots: Floats, degree: int, at: ArrayLike) -> tuple[Ints, Floats, Floats]:
    """Values and first derivatives at once, as `local_basis` gives either."""
    x = np.minimum(np.maximum(np.atleast_1d(np.asarray(at, dtype=np.float64)), knots[0]), knots[-1])
    span = np.searchsorted(knots, x, side="right") - 1
    span = np.minimum(np.maximum(span, degree), len(knots) - degree - 2)
    # Functions by rows: the long axis last is what vectorised arithmetic likes.
    beside = knots[span + np.arange(1 - degree, degree + 1)[:, None]]
    below, above = x - beside[degree - 1 :: -1], beside[degree:] - x
    values = np.ones((1, len(x)))
    lower = values
    for p in range(1, degree + 1):
        lower, values = values, np.zeros((p + 1, len(x)))
        for r in range(p):
            share = lower[r] / (above[r] + below[p - 1 - r])
            values[r] += above[r] * share
            values[r + 1] = below[p - 1 - r] * share
    rates = degree * lower / (beside[degree:] - beside[:degree])
    slopes = np.zeros_like(values)
    slopes[1:] = rates
    slopes[:-1] -= rates
    return span - degree, values.T, slopes.T


def _blend(rows: Floats, around: tuple[Ints, Floats], along: tuple[Ints, Floats]) -> Floats:
    """Blend poles (nv, nu, k) first along v, then around u."""
    (first, values), (row, row_values) = around, along
    sections = row_values[:, 0, None, None] * rows[row]
    for j in range(1, row_values.shape[1]):
        sections += row_values[:, j, None, None] * rows[row + j]
    grid: Floats = values[:, 0, None] * sections[:, first]
    for j in range(1, values.shape[1]):
        grid += values[:, j, None] * sections[:, first + j]
    return grid
