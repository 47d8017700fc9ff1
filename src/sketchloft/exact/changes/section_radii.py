"""Section radii: how large round sections are, from how far the points lie from their axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.wall.revolved import Revolved

__all__ = ["SectionRadii", "piece_costs", "section_radii"]

SLABS = 40
FEWEST = 12.0
"""Points, of those that do not go together, that a slab needs on average."""
LEAST_SLABS = 8
WIDER = 2.0
"""Points farther out than so many times the widest radius are strays."""
SPREAD = 1 / np.sqrt(12)
"""Deviation of the radius that one point tells, in radii: a squared distance lies evenly up to the square."""


@dataclass(frozen=True)
class SectionRadii:
    """Radii of thin slabs.

    Parameters
    ----------
    heights, radii, deviations : (m,) float arrays
        Of the middles of the slabs; the standard deviations of the radii.
    """

    heights: Floats
    radii: Floats
    deviations: Floats


def section_radii(
    points: Floats, wall: Revolved, ends: tuple[float, float], together: float
) -> SectionRadii | None:
    """Radii between two heights, about the axis of a wall nearby; None where there are too few points.

    Parameters
    ----------
    points : (n, 3) float array
    wall : Revolved
    ends : (low, high)
        Heights.
    together : float
        How many of the points go together.
    """
    low, high = ends
    square = ((points[:, :2] - wall.centre) ** 2).sum(axis=1)
    most = WIDER**2 * float(wall.area(np.linspace(low, high, 33)).max()) / np.pi
    kept = (points[:, 2] > low) & (points[:, 2] < high) & (square < most)
    slabs = min(SLABS, int(kept.sum() / (FEWEST * together)))
    if slabs < LEAST_SLABS:
        return None
    slab = np.minimum(((points[kept, 2] - low) / (high - low) * slabs).astype(np.intp), slabs - 1)
    count = np.maximum(np.bincount(slab, minlength=slabs), 1)
    radii = np.sqrt(np.maximum(2 * np.bincount(slab, square[kept], slabs) / count, 1e-6 * most))
    deviations = SPREAD * radii * np.sqrt(together / count)
    return SectionRadii(low + (np.arange(slabs) + 0.5) * (high - low) / slabs, radii, deviations)


def piece_costs(found: SectionRadii, fewest: int, each: float, leaning: float) -> Floats:
    """Cost (m + 1, m + 1) of one line or arc over radii i to j - 1; inf for too few.

    Parameters
    ----------
    found : SectionRadii
    fewest : int
        Radii of a piece at least.
    each, leaning : float
        Price of a number, and what any but a cylinder must gain besides, in squared deviations.

    Notes
    -----
    An arc about the axis is a line in the sum of the squares of radius and height.
    """
    z, r = found.heights - found.heights.mean(), found.radii
    weight = 1 / found.deviations**2
    line = _left(z, r, weight)
    cylinder = _left(np.zeros_like(z), r, weight)
    arc = _left(z, r**2 + z**2, weight / (4 * r**2))
    cost = np.minimum(np.minimum(cylinder + each, line + 2 * each + leaning), arc + 2 * each + leaning)
    i, j = np.indices(cost.shape)
    return np.where(j - i >= fewest, cost, np.inf)


def _left(x: Floats, y: Floats, weight: Floats) -> Floats:
    """Weighted squares (m + 1, m + 1) that the best line leaves of y over entries i to j - 1."""
    terms = np.array([weight, weight * x, weight * y, weight * x * x, weight * x * y, weight * y * y])
    sums = np.concatenate([np.zeros((6, 1)), np.cumsum(terms, axis=1)], axis=1)
    s, sx, sy, sxx, sxy, syy = sums[:, None, :] - sums[:, :, None]
    s = np.where(s > 0, s, 1.0)
    across = np.maximum(sxx - sx * sx / s, 0.0)
    slope = np.where(across > 1e-12 * s, (sxy - sx * sy / s) / np.where(across > 0, across, 1.0), 0.0)
    return np.maximum(syy - sy * sy / s - slope * (sxy - sx * sy / s), 0.0)
