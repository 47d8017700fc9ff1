"""Exact direction: the direction along which the fewest runs explain the points, whatever it is.

Extruded things have walls along the direction, or across it; revolved ones have walls whose normals meet
the axis. Both are looked for among all directions; the principal axes join them. What decides is how
cheaply segments (`segments`) explain the raw points seen along each.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.frame import frame_along
from sketchloft.level_set import LevelSet
from sketchloft.segments import SegmentsParams, cut

__all__ = ["Candidate", "exact_direction"]

SPHERE = 900
"""Directions on the half sphere that are tried."""
NORMALS = 1500
NARROW = 0.12
"""Sine of the angle within which a normal lies across or along a direction, or meets the axis."""
APART = 0.94
"""Cosine of the angle within which two candidates are one."""
BINS = 72


@dataclass(frozen=True)
class Candidate:
    """A direction and what it costs to explain the points along it.

    Parameters
    ----------
    vector : (3,) float array
    cost : float
        Negative log likelihood of the moments, with the price of the runs.
    source : str
        Why it is a candidate: "extrusion", "revolution" or "principal".
    """

    vector: Floats
    cost: float
    source: str


def exact_direction(
    points: Floats, grid: LevelSet, params: SegmentsParams, dispersion: float
) -> tuple[Candidate, ...]:
    """Find directions to slice along, the best first.

    Parameters
    ----------
    points : (n, 3) float array
        About their mean, strays left out.
    grid : LevelSet
        Of these points.
    params : SegmentsParams
    dispersion : float
        How many of the points go together.

    Returns
    -------
    tuple of Candidate

    References
    ----------
    H. Pottmann, T. Randrup, Rotational and helical surface approximation for reverse engineering,
    Computing 60 (1998) 307-322.
    """
    at, normals = _wall_normals(grid)
    sphere = _half_sphere(SPHERE)
    found: list[tuple[Floats, str]] = [
        (axis, "principal") for axis in np.linalg.eigh(points.T @ points)[1].T
    ]
    for source, score in (
        ("extrusion", _extrusion(sphere, normals)),
        ("revolution", _revolution(sphere, at, normals)),
    ):
        for start in _peaks(sphere, score):
            refine = _refined_extrusion if source == "extrusion" else _refined_revolution
            found.append((refine(start, at, normals), source))
    coarse = replace(params, most_bins=BINS)
    candidates: list[Candidate] = []
    for vector, source in found:
        frame = frame_along(vector, points)
        _, cost = cut(frame.to_local(points), coarse, dispersion)
        candidates.append(Candidate(frame.direction, cost, source))
    candidates.sort(key=lambda candidate: candidate.cost)
    return tuple(candidates)


def _wall_normals(grid: LevelSet) -> tuple[Floats, Floats]:
    """Places on the half level and the outward normals there, evenly thinned."""
    level = np.where(grid.inside | (grid.level < 0.5), grid.level, 0.5)
    index = np.argwhere(np.abs(level - 0.5) < 0.2)
    gradient = np.stack(
        [axis[tuple(index.T)] for axis in np.gradient(level.astype(np.float64))], axis=1
    )
    steep = np.linalg.norm(gradient, axis=1)
    keep = steep > 0.4 * np.median(steep)
    index, gradient, steep = index[keep], gradient[keep], steep[keep]
    thin = np.linspace(0, len(index) - 1, min(NORMALS, len(index))).astype(int)
    return grid.origin + grid.cell * index[thin], -gradient[thin] / steep[thin, None]


def _half_sphere(count: int) -> Floats:
    """Evenly spread unit vectors (count, 3) with z >= 0 (Fibonacci's spiral)."""
    k = np.arange(count) + 0.5
    z = k / count
    angle = np.pi * (1 + np.sqrt(5)) * k
    r = np.sqrt(1 - z**2)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), z])


def _extrusion(directions: Floats, normals: Floats) -> Floats:
    """Share of the wall that lies along or across each direction."""
    along = np.abs(directions @ normals.T)
    return np.asarray(_soft(along) .mean(axis=1) + _soft(1 - along, 0.03).mean(axis=1))


def _revolution(directions: Floats, at: Floats, normals: Floats) -> Floats:
    """Share of the wall whose normals meet the axis through the centre along each direction."""
    moment = np.cross(at, normals)
    arm = np.linalg.norm(np.cross(directions[:, None], at[None]), axis=2)
    return np.asarray(_soft(np.abs(directions @ moment.T) / np.maximum(arm, 0.02)).mean(axis=1))


def _soft(sine: Floats, width: float = NARROW) -> Floats:
    return np.asarray(1 / (1 + (sine / width) ** 2))


def _peaks(directions: Floats, score: Floats) -> list[Floats]:
    """Up to three directions of high score, apart from each other."""
    order = np.argsort(-score)
    peaks: list[Floats] = []
    for i in order[:200]:
        if all(abs(float(directions[i] @ peak)) < APART for peak in peaks):
            peaks.append(directions[i])
        if len(peaks) == 3:
            break
    return peaks


def _refined_extrusion(start: Floats, _: Floats, normals: Floats) -> Floats:
    """Direction most at right angles to the walls along it, walls across it left out."""
    vector = start
    for _ in range(8):
        along = normals @ vector
        weight = np.where(np.abs(along) < 0.5, _soft(along) ** 2, 0.0)
        if weight.sum() < 10:
            return vector
        matrix = (weight[:, None] * normals).T @ normals
        _, axes = np.linalg.eigh(matrix)
        vector = axes[:, 0] if abs(float(axes[:, 0] @ vector)) > 0.8 else vector
    return vector


def _refined_revolution(start: Floats, at: Floats, normals: Floats) -> Floats:
    """Direction of the axis that the normals meet best, wherever it passes (linear line complex)."""
    vector, foot = start, np.zeros(3)
    for _ in range(8):
        moment = np.cross(at, normals)
        miss = moment @ vector - normals @ np.cross(foot, vector)
        arm = np.linalg.norm(np.cross(vector, at - foot), axis=1)
        weight = _soft(miss / np.maximum(arm, 0.02)) ** 2 / np.maximum(arm, 0.02) ** 2
        rows = np.column_stack([moment, normals])
        matrix = (weight[:, None] * rows).T @ rows
        a, b, d = matrix[:3, :3], matrix[:3, 3:], matrix[3:, 3:]
        inverse = np.linalg.pinv(d, rcond=1e-6, hermitian=True)
        _, axes = np.linalg.eigh(a - b @ inverse @ b.T)
        axis = axes[:, 0]
        if abs(float(axis @ vector)) < 0.8:
            return vector
        vector = axis * np.sign(axis @ vector)
        # The complex (c, c') belongs to an axis through c x c' where c . c' = 0.
        foot = np.cross(vector, -inverse @ b.T @ vector)
    return vector
