"""Section contours: the section of a segment, from all its points at once, and the loops that bound it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump
from sketchloft.exact.section.level_set import LevelSet, level_set
from sketchloft.ring import ring_area

__all__ = ["PlanView", "contours", "plan_view"]

SIGNIFICANT = 3.0
"""Logarithms of the number of points that a change of size must gain to be believed."""
DRIFTING = 1.2
"""The same for a drift: a small one that is not there harms less than one that is missed."""
STEEPEST = 2.0
"""Largest drift: what moves sideways faster than this is to be cut along another direction."""
GAP = 25.0
"""Points that a hole lacks, and that a piece holds, at least: fewer come by chance."""
PIECE = 0.03
"""Share of the section's area that a piece of it covers at least."""


@dataclass(frozen=True)
class PlanView:
    """The points of a segment, moved along its rule to one section.

    Parameters
    ----------
    points : (n, 2) float array
    height : float
        Middle of the segment.
    centre : (2,) float array
        Of the section at `height`.
    drift : (2,) float array
        Movement of the centre per height.
    scale : (n,) float array
        Size of the section at each point's height, relative to that at `height`.
    growth : (3,) float array
        Squared relative size as a polynomial of z - height, lowest power first.
    """

    points: Floats
    height: float
    centre: Floats
    drift: Floats
    scale: Floats
    growth: Floats


def plan_view(points: Floats, together: float = 1.0) -> PlanView:
    """Move the points (n, 3) of a segment to one section.

    Notes
    -----
    The centre moves evenly and the second moment is a parabola of the height for cylinders, cones,
    spheres, ellipsoids and all that drifts and tapers evenly, so that both come from least squares over
    the raw points, whatever the section's shape.
    """
    z = points[:, 2]
    height = float(z.min() + z.max()) / 2
    dz = z - height
    price = SIGNIFICANT * together * float(np.log(len(z)))
    centre, drift = points[:, :2].mean(axis=0), np.zeros(2)
    line = np.column_stack([np.ones(len(z)), dz])
    coefficients = np.linalg.lstsq(line, points[:, :2], rcond=None)[0]
    spread = points[:, :2].var(axis=0)
    gain = ((points[:, :2] - centre) ** 2 - (points[:, :2] - line @ coefficients) ** 2).sum(axis=0) / spread
    if gain.max() > DRIFTING / SIGNIFICANT * price and np.hypot(*coefficients[1]) < STEEPEST:
        centre, drift = coefficients
    arm = points[:, :2] - centre - dz[:, None] * drift
    square = np.einsum("ij,ij->i", arm, arm)
    growth = _growth(dz, square, price)
    scale = np.sqrt(np.maximum(growth[0] + growth[1] * dz + growth[2] * dz**2, 0.02))
    return PlanView(centre + arm / scale[:, None], height, centre, drift, scale, growth)


def _growth(dz: Floats, square: Floats, price: float) -> Floats:
    """Squared size by height: constant, line or parabola, as the squares (n,) demand, 1 at dz = 0."""
    parabola = np.column_stack([np.ones(len(dz)), dz, dz**2])
    weight = np.full(len(dz), 1 / square.mean())
    found, left = np.array([1.0, 0.0, 0.0]), np.inf
    for terms in (1, 3):
        weight = np.full(len(dz), 1 / square.mean())
        for _ in range(3):  # the scatter of squares grows with the square of the size
            rows = parabola[:, :terms] * weight[:, None]
            growth = np.linalg.lstsq(rows, square * weight, rcond=None)[0]
            weight = 1 / np.maximum(parabola[:, :terms] @ growth, 0.05 * float(square.mean()))
        even = float(((square * weight - 1) ** 2).mean())
        cost = len(dz) * np.log(even) + 2 * -np.log(weight).sum()
        if cost < left - price:
            found, left = np.r_[growth / growth[0], np.zeros(3 - terms)], cost
    return found


def contours(points: Floats, together: float = 1.0) -> tuple[list[Floats], list[Floats], float]:
    """Loops around the pieces of a section filled by points (n, 2), loops of its holes, and the blur.

    Parameters
    ----------
    points : (n, 2) float array
    together : float
        How many of the points go together (`dispersion`).

    Returns
    -------
    list of (m, 2) float arrays
        Outer loops, counter-clockwise, the largest first.
    list of (m, 2) float arrays
        Holes, counter-clockwise as well.
    float
        Standard deviation of the blur that the loops were found with.
    """
    import contourpy  # noqa: PLC0415

    grid = level_set(points, clump(together))
    level = np.where(grid.inside | (grid.level <= 0.5), grid.level, 0.0)
    generator = contourpy.contour_generator(z=level.T)
    loops = [np.asarray(line, dtype=float)[:-1] for line in generator.lines(0.5)]
    loops = [grid.origin + grid.cell * loop for loop in loops if len(loop) >= 8]
    areas = np.array([ring_area(loop) for loop in loops])
    if not len(areas):
        return [], [], grid.blur
    outer_sign = np.sign(areas[np.argmax(np.abs(areas))])
    # Where there are points for one piece only, what lies beside it may be a stray stroke.
    least = float(np.abs(areas).max()) * min(max(PIECE, GAP * together / len(points)), 1.0)
    order = np.argsort(-np.abs(areas))
    outer, holes = [], []
    for i in order:
        ring = loops[i] if areas[i] > 0 else loops[i][::-1]
        if np.sign(areas[i]) == outer_sign and abs(areas[i]) >= least:
            outer.append(ring)
        elif np.sign(areas[i]) != outer_sign and _missing(grid, ring, abs(float(areas[i]))) > GAP * together:
            holes.append(ring)
    return outer, holes, grid.blur


def _missing(grid: LevelSet, ring: Floats, area: float) -> float:
    """Points that would lie in a ring if it were filled as the section is around it."""
    low, high = ((end(axis=0) - grid.origin) / grid.cell for end in (ring.min, ring.max))
    box = tuple(slice(int(a), int(np.ceil(b)) + 1) for a, b in zip(low, high, strict=True))
    return float(grid.around[box].mean()) * area / grid.cell**2 * (1 - 2 * float(grid.level[box].min()))
