"""Misfit: how much the points could gain at most if a run's walls were free to move, patch by patch."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.model import ExactModel
from sketchloft.stack import Wall

__all__ = ["misfit"]

AROUND = 16
ALONG = 8
NODES = 2000
THIN = 1e-6
INFORMATION = 0.3
"""Share of the expected information that a patch has at least, however few points are there."""


def misfit(points: Floats, model: ExactModel, runs: range, together: float) -> float:
    """Log likelihood that free walls would gain in the place of the walls of some runs, about.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    runs : range
    together : float
        How many of the points go together.

    Notes
    -----
    The score test: half the sum of each patch's squared score over its information, less what chance makes
    of it; the score is the derivative by a movement of the patch along its normal.
    """
    breaks, sigma = model.stack.breaks, model.sigma
    total = 0.0
    for j in runs:
        low, high = float(breaks[j]), float(breaks[j + 1])
        inner = points[(points[:, 2] > low) & (points[:, 2] < high)]
        for wall in model.stack.runs[j].walls:
            nodes = wall.boundary(low, high, NODES)
            density = model.density.at(nodes.points)
            at, expected = _patches(nodes.points, wall, low, high), density * nodes.areas
            foot = wall.foot(inner)
            near = np.abs(foot.distance) < 5 * sigma
            score = _scores(inner[near], foot.distance[near], model)
            patch = _patches(inner[near], wall, low, high)
            count = AROUND * ALONG
            lack = np.bincount(patch, score, count) - np.bincount(at, expected, count)
            least = INFORMATION * np.bincount(at, expected, count) / sigma
            information = np.maximum(np.bincount(patch, score**2, count), least)
            total += float((lack**2 / np.maximum(information, 1e-300) - together).sum()) / 2
    return total / together


def _scores(points: Floats, distance: Floats, model: ExactModel) -> Floats:
    """Derivative (n,) of each point's log likelihood by a movement of the wall outwards."""
    from scipy.special import ndtr  # noqa: PLC0415

    density = model.density.at(points)
    bell = np.exp(-0.5 * (distance / model.sigma) ** 2) / (model.sigma * np.sqrt(2 * np.pi))
    return np.asarray(density * bell / (density * ndtr(-distance / model.sigma) + model.stray))


def _patches(points: Floats, wall: Wall, low: float, high: float) -> Ints:
    """Which patch (n,) of the wall points belong to: by height, and by the angle about its middle."""
    ends = [wall.boundary(z - THIN, z + THIN, 64) for z in (low + THIN, high - THIN)]
    first, last = (end.areas @ end.points[:, :2] / max(float(end.areas.sum()), 1e-300) for end in ends)
    share = np.clip((points[:, 2] - low) / (high - low), 0, 1 - 1e-9)
    spoke = points[:, :2] - first - share[:, None] * (last - first)
    turn = np.arctan2(spoke[:, 1], spoke[:, 0]) / (2 * np.pi) % 1.0
    return (share * ALONG).astype(np.intp) * AROUND + np.minimum((turn * AROUND).astype(np.intp), AROUND - 1)
