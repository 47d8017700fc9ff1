"""Strokes as a hand draws them: random walks inside a goal, their slow drift, and strays."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.sample.goals import Goal, bounds, inside

__all__ = ["stray_strokes", "walks", "wander"]

POINTS_PER_STROKE = 60
STEP = 0.01
"""Length of a step, as a share of the goal's diagonal."""
BEND = 0.25
"""How much a stroke's direction changes at a step (0 draws straight lines)."""
BOUNCE = 0.3
"""How much a direction scatters where it is turned back by the wall."""
DRIFT_TERMS = 4


def walks(goal: Goal, n: int, rng: np.random.Generator) -> Floats:
    """(s, 60, 3) points of s random walks inside a goal, as many strokes as hold n points.

    Notes
    -----
    The direction of a walk turns a little at every step of 1 % of the diagonal; a step that
    would leave the goal is tried again, turned back, and not made if that leaves it too.
    """
    low, high = bounds(goal)
    step = STEP * float(np.linalg.norm(high - low))
    strokes = -(-n // POINTS_PER_STROKE)
    paths = np.empty((strokes, POINTS_PER_STROKE, 3))
    paths[:, 0] = _starts(goal, strokes, rng)
    direction = _unit(rng.normal(size=(strokes, 3)))
    for i in range(1, POINTS_PER_STROKE):
        direction = _unit(direction + BEND * rng.normal(size=direction.shape))
        paths[:, i] = paths[:, i - 1] + step * direction
        out = np.flatnonzero(~inside(goal, paths[:, i]))
        direction[out] = _unit(-direction[out] + BOUNCE * rng.normal(size=(len(out), 3)))
        back = paths[out, i - 1] + step * direction[out]
        paths[out, i] = np.where(inside(goal, back)[:, None], back, paths[out, i - 1])
    return paths


def wander(strokes: int, length: int, rng: np.random.Generator) -> Floats:
    """(strokes, length, 3) slow error of a hand along each stroke, standard deviation 1 per axis.

    Notes
    -----
    A sum of cosines of 0 to 3 half waves along the stroke, amplitudes falling as 1 / (1 + k): a
    hand is off by about the same amount at neighbouring points.
    """
    along = np.linspace(0, 1, length)[:, None]
    total = np.zeros((strokes, length, 3))
    variance = 0.0
    for k in range(DRIFT_TERMS):
        amplitude = rng.normal(size=(strokes, 1, 3)) / (1 + k)
        phase = rng.random((strokes, 1, 3))
        total += amplitude * np.cos(2 * np.pi * (0.5 * k * along + phase))
        variance += 0.5 / (1 + k) ** 2
    return total / np.sqrt(variance)


def stray_strokes(paths: Floats, share: float, low: Floats, high: Floats, rng: np.random.Generator) -> Floats:
    """Replace a share of strokes (s, m, 3), at least one unless 0, by straight ones anywhere in a box."""
    if share == 0:
        return paths
    count = max(1, round(share * len(paths)))
    start, towards = rng.uniform(low, high, (2, count, 1, 3))
    along = np.linspace(0, 0.3, paths.shape[1])[:, None]
    result = paths.copy()
    result[rng.choice(len(paths), size=count, replace=False)] = start + along * (towards - start)
    return result


def _starts(goal: Goal, n: int, rng: np.random.Generator) -> Floats:
    low, high = bounds(goal)
    found, kept = 0, [np.empty((0, 3))]
    while found < n:
        points = rng.uniform(low, high, (4 * n + 64, 3))
        kept.append(points[inside(goal, points)])
        found += len(kept[-1])
    return np.concatenate(kept)[:n]


def _unit(vectors: Floats) -> Floats:
    return np.divide(vectors, np.linalg.norm(vectors, axis=-1, keepdims=True))
