"""Loft start: a free wall through the half-density contours of thin slabs."""

from __future__ import annotations

import itertools

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump
from sketchloft.exact.section.section_contours import contours, plan_view
from sketchloft.shapes.spline import fit_spline, resampled
from sketchloft.surface import basis_matrix, even_knots
from sketchloft.wall.lofted import Lofted, lofted

__all__ = ["loft_start"]

FEWEST = 80
SAMPLES = 128


def loft_start(
    points: Floats, ends: tuple[float, float], around: int, spans: int, together: float
) -> Lofted | None:
    """Wall through the contours of slabs of points (n, 3) between two heights.

    Parameters
    ----------
    points : (n, 3) float array
    ends : (low, high)
    around : int
        Poles around.
    spans : int
        Knot spans along.
    together : float
        How many of the points go together.

    Returns
    -------
    Lofted
        None where a slab has no contour, or more than one piece.
    """
    low, high = ends
    inner = points[(points[:, 2] > low) & (points[:, 2] < high)]
    slabs = int(np.clip(len(inner) / (FEWEST * 4), spans + 1, 2 * spans + 3))
    edges = np.linspace(low, high, slabs + 1)
    heights: list[float] = []
    rings: list[Floats] = []
    for bottom, top in itertools.pairwise(edges):
        slab = inner[(inner[:, 2] >= bottom) & (inner[:, 2] <= top)]
        if len(slab) < FEWEST:
            return None
        # Moved along its rule, a slanted or tapered slab shows the section that it has in its middle.
        plan = plan_view(slab, clump(together))
        outer, holes, _ = contours(plan.points, together)
        if len(outer) != 1 or holes:
            return None
        heights.append(plan.height)
        rings.append(_matched(outer[0], rings[-1] if rings else None))
    knots = even_knots(low, high, spans)
    sections = np.array([fit_spline(ring, around).poles for ring in rings])
    basis = basis_matrix(knots, Lofted.degree, np.array(heights))
    smooth = 0.05 * np.diff(np.eye(basis.shape[1]), 2, axis=0)
    rows = np.concatenate([basis, smooth])
    right = np.concatenate([sections.reshape(len(sections), -1), np.zeros((len(smooth), 2 * around))])
    poles = np.linalg.lstsq(rows, right, rcond=None)[0]
    return lofted(poles.reshape(-1, around, 2), knots)


def _matched(ring: Floats, before: Floats | None) -> Floats:
    """Ring resampled from where it lies closest to the one before, or from the direction of x."""
    even = resampled(ring, SAMPLES)
    spokes = (even - even.mean(axis=0)) @ [1, 1j]
    if before is None:
        return np.roll(even, -int(np.argmin(np.abs(np.angle(spokes)))), axis=0)
    other = (before - before.mean(axis=0)) @ [1, 1j]
    likeness = np.fft.ifft(np.fft.fft(spokes) * np.conj(np.fft.fft(other))).real
    return np.roll(even, -int(np.argmax(likeness)), axis=0)
