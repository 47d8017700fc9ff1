"""Dome: how points see a wall whose sections grow and shrink as an ellipse's chords do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.outline.outline import Foot

__all__ = ["DomeFoot", "dome_foot", "taper_and_bow"]

LEAST_SUPPORT = 1e-6
"""Smallest distance of a tangent from the pivot; the outline is meant to be seen whole from there."""


@dataclass(frozen=True)
class DomeFoot:
    """Signed distance of points from a dome, and its derivatives.

    Parameters
    ----------
    distance : (n,) float array
    normal : (n, 3) float array
    by_outline : (n,) float array
        What the outline's own derivatives are multiplied by.
    by_square : (n,) float array
        Derivative by the squared scale at the point's height.
    by_shift : (n, 2) float array
        Derivative by a shift of the section.
    curvature : (n,) float array
    """

    distance: Floats
    normal: Floats
    by_outline: Floats
    by_square: Floats
    by_shift: Floats
    curvature: Floats


def dome_foot(
    moved: Floats, seen: Foot, arm: Floats, square: tuple[Floats, Floats, float], drift: Floats
) -> DomeFoot:
    """Look at a dome from points.

    Parameters
    ----------
    moved : (n, 2) float array
        Points relative to the pivot of the section at their height.
    seen : Foot
        Of the outline, from `arm`.
    arm : (n, 2) float array
        `moved` over the scale.
    square : (n,), (n,) float arrays, float
        Squared scale Q at each point's height, half its slope, and half its second derivative.
    drift : (2,) float array

    Notes
    -----
    The wall is where ``F = ((n . x)**2 - h**2 Q) / 2`` is 0, x the point seen from the pivot, n the
    outline's normal and h the distance of its tangent from the pivot. The distance ``F / |grad F|`` is
    first order exact on the wall, and at the tip, too, where the scale has no derivative.
    """
    q, rise, bend = square
    support = np.maximum(np.einsum("ij,ij->i", seen.normal, arm) - seen.distance, LEAST_SUPPORT)
    reach = np.einsum("ij,ij->i", seen.normal, moved)
    fall = -reach * (seen.normal @ drift) - support**2 * rise
    steep = np.maximum(np.hypot(reach, fall), 1e-12)
    normal = np.column_stack([reach[:, None] * seen.normal, fall]) / steep[:, None]
    inside = np.maximum(q, 0.0)
    round_ = np.maximum(inside + (support * rise) ** 2, 1e-12)
    along = support * (rise**2 - bend * inside) / round_**1.5
    return DomeFoot(
        (reach**2 - support**2 * q) / (2 * steep),
        normal,
        support * inside / steep,
        -(support**2) / (2 * steep),
        -(reach / steep)[:, None] * seen.normal,
        seen.curvature / np.sqrt(round_) + along,
    )


def taper_and_bow(first: float, second: float) -> tuple[float, float]:
    """Taper and bow of a squared scale ``1 + first dz + second dz**2``; no bow where it curves upwards."""
    taper = first / 2
    return taper, float(np.sqrt(max(taper**2 - second, 0.0)))
