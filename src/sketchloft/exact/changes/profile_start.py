"""Profile start: a free profile whose sections hold the second moments that the points have."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.surface import basis_matrix, even_knots
from sketchloft.wall.profile import SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at

__all__ = ["profile_start", "respanned"]

HEIGHTS = 60
"""Heights at which the radii are taken over from the fit of their squares."""
WIDER = (1.5, 1.2)
"""Points farther out than so many radii are strays, in each round."""
STIFF = 1e-3
LEAST = 1e-4
"""Smallest square of a radius, in that of the widest section."""


def profile_start(
    points: Floats, centre: Floats, near: tuple[Floats, Floats], ends: tuple[float, float], spans: int
) -> Revolved:
    """Free profile about an axis, found from how far the points lie from it.

    The mean squared distance of points spread evenly over a disk is half its squared radius, so that the
    squares of the radii are a linear regression on the points, with no slab flattened.

    Parameters
    ----------
    points : (n, 3) float array
    centre : (2,) float array
        Of the axis.
    near : (m,) float array and (m,) float array
        Heights and radii of a profile nearby, to tell strays by.
    ends : (low, high)
        Heights.
    spans : int
        Knot spans.
    """
    low, high = ends
    knots = _knots(ends, spans)
    inner = points[(points[:, 2] > low) & (points[:, 2] < high)]
    square = ((inner[:, :2] - centre) ** 2).sum(axis=1)
    basis = basis_matrix(knots, SplineProfile.degree, inner[:, 2])
    stiff = np.diff(np.eye(basis.shape[1]), 2, axis=0)
    r = np.interp(inner[:, 2], *near)
    for wider in WIDER:
        # A squared distance spreads as the squared radius does.
        weight = (square < (wider * r) ** 2) / np.maximum(r, 1e-3 * float(r.max(initial=1e-3))) ** 2
        rows, bend = weight[:, None] * basis, STIFF * float(weight.sum()) / len(stiff) * stiff
        # Basis functions overlap little, and poles without points are held by their neighbours, so that the
        # normal equations lose nothing; they take a tenth of the time.
        normal = rows.T @ rows + bend.T @ bend
        squares = np.linalg.lstsq(normal, rows.T @ (weight * 2 * square), rcond=None)[0]
        fitted = basis @ squares
        r = np.sqrt(np.maximum(fitted, LEAST * float(fitted.max(initial=0.0))))
    z = np.linspace(low, high, HEIGHTS)
    across = basis_matrix(knots, SplineProfile.degree, z) @ squares
    wall = np.sqrt(np.maximum(across, LEAST * float(across.max())))
    return Revolved(centre, _through(z, wall, knots))


def respanned(wall: Revolved, ends: tuple[float, float], spans: int) -> Revolved:
    """The wall with a free profile of so many knot spans that is nearest to its own.

    Parameters
    ----------
    wall : Revolved
    ends : (low, high)
        Heights.
    spans : int
    """
    z = np.linspace(*ends, HEIGHTS)
    return Revolved(wall.centre, _through(z, radius_at(wall.profile, z)[0], _knots(ends, spans)))


def _knots(ends: tuple[float, float], spans: int) -> Floats:
    """A little wider than the heights, so that the ends may move."""
    low, high = ends
    margin = 0.05 * (high - low) + 0.01
    return even_knots(low - margin, high + margin, spans)


def _through(z: Floats, radii: Floats, knots: Floats) -> SplineProfile:
    """Free profile nearest to radii (m,) at heights (m,)."""
    at = basis_matrix(knots, SplineProfile.degree, z)
    stiff = STIFF * np.diff(np.eye(at.shape[1]), 2, axis=0)
    rows = np.concatenate([at, stiff])
    return SplineProfile(knots, np.linalg.lstsq(rows, np.r_[radii, np.zeros(len(stiff))], rcond=None)[0])
