"""Deciding: the points that tell whether a change of some runs is right."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.exact.changes.change import Change
from sketchloft.exact.fit.likelihood import beside_walls, rising
from sketchloft.exact.model.exact_model import ExactModel

__all__ = ["BESIDE", "at_heights", "beside", "beside_either", "deciding"]

BESIDE = 6.0
"""Noise deviations from the walls within which points decide."""


def deciding(points: Floats, model: ExactModel, change: Change) -> Floats:
    """Points at the heights of a change beside the walls before it or after it, rising."""
    return beside_either(rising(points[at_heights(points, change)]), model, change.model)


def beside(points: Floats, model: ExactModel) -> Floats:
    """Points beside the walls of a model."""
    return points[beside_walls(points, model, BESIDE * model.sigma)]


def beside_either(points: Floats, model: ExactModel, candidate: ExactModel) -> Floats:
    """Points beside the walls of either model, as far as the noise of the first reaches."""
    width = BESIDE * model.sigma
    return points[beside_walls(points, model, width) | beside_walls(points, candidate, width)]


def at_heights(points: Floats, change: Change) -> NDArray[np.bool_]:
    """(n,) whether points (n, 3) lie at the heights of the changed runs and their neighbours."""
    breaks, runs = change.model.stack.breaks, change.runs
    low = -np.inf if runs.start <= 1 else breaks[runs.start - 1]
    high = np.inf if runs.stop >= len(breaks) - 2 else breaks[runs.stop + 1]
    return np.asarray((points[:, 2] > low) & (points[:, 2] < high))
