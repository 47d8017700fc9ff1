"""Clouds as a hand scribbles them in anything that can tell what is inside."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.sample import FillParams
from sketchloft.sample.strokes import wander

Inside = Callable[[Floats], NDArray[np.bool_]]
LENGTH = 60
STEP = 0.01
DRIFT = 0.003
SCRIBBLED = FillParams(fill="strokes", jitter=0.001, drift=DRIFT, outliers=0.005)
"""The same in a goal, with strokes that stray."""


def scribbled(inside: Inside, low: Floats, high: Floats, n: int, seed: int) -> Floats:
    """(n, 3) points of strokes that wander in a thing between two corners, and drift."""
    rng = np.random.default_rng(seed)
    size = float(np.linalg.norm(high - low))
    count = -(-n // LENGTH)
    starts = rng.uniform(low, high, (60 * count, 3))
    at = starts[inside(starts)][:count]
    towards = unit(rng.normal(size=at.shape))
    paths = [at]
    for _ in range(LENGTH - 1):
        towards = unit(towards + 0.25 * rng.normal(size=at.shape))
        there = at + STEP * size * towards
        stays = inside(there)
        towards[~stays] = unit(-towards[~stays] + 0.3 * rng.normal(size=((~stays).sum(), 3)))
        at = np.where(stays[:, None], there, at)
        paths.append(at)
    strokes = np.stack(paths, axis=1) + DRIFT * size * wander(count, LENGTH, rng)
    return strokes.reshape(-1, 3)[:n]


def unit(vectors: Floats) -> Floats:
    return np.divide(vectors, np.linalg.norm(vectors, axis=1, keepdims=True))
