"""Exact direction: the direction along which the fewest runs explain the points, whatever it is.

Extruded things have walls along the direction, or across it; revolved ones have walls whose normals meet
the axis. Both are looked for among all directions; the principal axes join them, and the direction from a
ball to what sticks out of it. What decides is how likely the raw points are when their sections are moved
along the axis (`rule_likelihood`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import thinned
from sketchloft.exact.section.level_set import LevelSet
from sketchloft.exact.start.beside_ball import beside_ball
from sketchloft.exact.start.rule_likelihood import rule_likelihood
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.frame import frame_along

__all__ = ["Candidate", "exact_direction"]

SPHERE = 900
"""Directions on the half sphere that are tried."""
NORMALS = 3000
SMOOTHER = 1.8
"""Further blur, in cells, of the level set that normals are taken from."""
NARROW = 0.12
"""Sine of the angle within which a normal lies across or along a direction, or meets the axis."""
APART = 0.94
"""Cosine of the angle within which two candidates are one."""
RING = 0.85
"""Cosine of the angle up to which flat walls stand out from what is around them."""
BINS = 56
SHORTEST = 4
PRICE = 60.0
SYMMETRY = 0.4
LEANS = (0.03, 0.01)
"""Angles in radians by which candidates are tilted."""
SAME = 0.985
MOST_POINTS = 4000
REFINED = 3
CONTENDER = 0.12
"""Candidates farther than this behind the best are not refined."""


@dataclass(frozen=True)
class Candidate:
    """A direction and what it costs to explain the points along it.

    Parameters
    ----------
    vector : (3,) float array
    value : float
        Log likelihood per point, and a little more for a direction of symmetry.
    likelihood : float
        Log likelihood per point (`rule_likelihood`).
    source : str
        Why it is a candidate: "extrusion", "revolution", "caps", "ball" or "principal".
    """

    vector: Floats
    value: float
    likelihood: float
    source: str


def exact_direction(
    points: Floats, grid: LevelSet, params: SegmentsParams, together: float
) -> tuple[Candidate, ...]:
    """Find directions to slice along, the best first.

    Parameters
    ----------
    points : (n, 3) float array
        About their mean, strays left out.
    grid : LevelSet
        Of these points.
    params : SegmentsParams
    together : float
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
    scores = {
        "extrusion": _extrusion(sphere, normals),
        "revolution": _revolution(sphere, at, normals),
        "caps": _standing_out(sphere, _caps(sphere, normals)),
    }
    beside = beside_ball(points, at)
    found = [(axis, "principal") for axis in np.linalg.eigh(points.T @ points)[1].T]
    found += [] if beside is None else [(beside, "ball")]
    for source, score in scores.items():
        found += [(REFINE[source](start, at, normals), source) for start in _peaks(sphere, score)]
    coarse = replace(params, most_bins=BINS, shortest=SHORTEST, price=PRICE)
    every = len(points) // MOST_POINTS + 1
    judge = _Judge(points[::every], at, normals, coarse, thinned(together, every))
    candidates: list[Candidate] = []
    for vector, source in found:
        if all(abs(float(vector @ other.vector)) < SAME for other in candidates):
            candidates.append(judge(vector, source))
    candidates.sort(key=lambda candidate: -candidate.value)
    for i in range(min(REFINED, len(candidates))):
        start = candidates[i]
        if start.value < candidates[0].value - CONTENDER:
            break
        others = [judge(refine(start.vector, at, normals), start.source) for refine in REFINE.values()]
        best = max([start, *others], key=lambda other: other.value)
        candidates[i] = _refined(best, judge)
        if abs(float(best.vector @ start.vector)) < SAME:
            candidates.append(_refined(start, judge))
    candidates.sort(key=lambda candidate: -candidate.value)
    return tuple(candidates)


@dataclass(frozen=True)
class _Judge:
    """Says how good a direction is for a sample of points and the walls around them."""

    points: Floats
    at: Floats
    normals: Floats
    params: SegmentsParams
    together: float

    def __call__(self, vector: Floats, source: str) -> Candidate:
        """Favour what is revolved or extruded as a whole: of equals it has the simplest sections."""
        frame = frame_along(vector, self.points)
        likelihood = rule_likelihood(frame.to_local(self.points), self.params, self.together)
        along = frame.direction[None]
        revolved = float(_revolution(along, self.at, self.normals)[0])
        share = max(revolved, float(_extrusion(along, self.normals)[0]))
        return Candidate(frame.direction, likelihood + SYMMETRY * share, likelihood, source)


def _refined(candidate: Candidate, judge: _Judge) -> Candidate:
    """Tilt a candidate, less and less, as long as it gets better."""
    for angle in LEANS:
        x, y = frame_along(candidate.vector, judge.points).axes[:2]
        around = [judge(candidate.vector + angle * lean, candidate.source) for lean in (x, y, -x, -y)]
        candidate = max([candidate, *around], key=lambda other: other.value)
    return candidate


def _wall_normals(grid: LevelSet) -> tuple[Floats, Floats]:
    """Places on the half level and the outward normals there, evenly thinned."""
    from scipy import ndimage  # noqa: PLC0415

    level = ndimage.gaussian_filter(grid.level, SMOOTHER)
    index = np.argwhere(np.abs(level - 0.5) < 0.2)
    gradient = np.stack(
        [np.asarray(slope)[tuple(index.T)] for slope in np.gradient(level.astype(np.float64))], axis=1
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
    return np.asarray(_soft(along).mean(axis=1) + _soft(1 - along, 0.03).mean(axis=1))


def _revolution(directions: Floats, at: Floats, normals: Floats) -> Floats:
    """Share of the wall whose normals meet the axis through the centre along each direction."""
    moment = np.cross(at, normals)
    arm = np.sqrt(np.maximum((at**2).sum(axis=1) - (directions @ at.T) ** 2, 0.0))
    return np.asarray(_soft(np.abs(directions @ moment.T) / np.maximum(arm, 0.02)).mean(axis=1))


def _caps(directions: Floats, normals: Floats) -> Floats:
    """Share of the wall that lies flat across each direction."""
    return np.asarray(_soft(1 - np.abs(directions @ normals.T), 0.02).mean(axis=1))


def _standing_out(directions: Floats, score: Floats) -> Floats:
    """By how much scores are above the highest in a ring around each: curved walls are flat to all sides."""
    near = np.abs(directions @ directions.T)
    around = np.where((near > RING) & (near < APART), score, -np.inf)
    return np.asarray(score - around.max(axis=1))


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


def _refined_extrusion(start: Floats, at: Floats, normals: Floats) -> Floats:
    """Direction most at right angles to the walls along it, walls across it left out."""
    del at  # where the walls are does not matter
    vector = start
    for _ in range(8):
        along: Floats = normals @ vector
        weight = np.where(np.abs(along) < 0.5, _soft(along) ** 2, 0.0)
        if weight.sum() < 10:
            return vector
        matrix = (weight[:, None] * normals).T @ normals
        _, axes = np.linalg.eigh(matrix)
        least: Floats = axes[:, 0]
        vector = least if abs(float(least @ vector)) > 0.8 else vector
    return vector


def _refined_caps(start: Floats, at: Floats, normals: Floats) -> Floats:
    """Mean normal of the flat walls across a direction."""
    del at  # where the walls are does not matter
    vector = start
    for _ in range(5):
        along = normals @ vector
        weight = _soft(1 - np.abs(along), 0.01) ** 2 * np.sign(along)
        vector = weight @ normals
        vector = vector / np.linalg.norm(vector)
    return np.asarray(vector)


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


REFINE = {
    "extrusion": _refined_extrusion,
    "revolution": _refined_revolution,
    "caps": _refined_caps,
}
