"""Precision: how well the points of a cloud can say where walls are, in theory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.dispersion import dispersion
from sketchloft.exact.body import ExactBody
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.report.dimensions import dimensions
from sketchloft.stack import Run

__all__ = ["Precision", "precision", "spreads"]

INFORMATION = 0.9032
"""Of a place on a wall, per point and noise deviation: the integral of the normal density squared over the
normal distribution."""
NODES = 4096
"""Points per wall to integrate with."""
FLAT = 1e-9
"""Eigenvalues of the information smaller than this share of the largest say nothing."""
STEP = 1e-6


@dataclass(frozen=True)
class Precision:
    """Statistical errors of a model, in the body's unit.

    Parameters
    ----------
    covariance : (p, p) float array
        Of the walls' parameters.
    breaks : (k + 1,) float array
        Standard errors of the breaks; NaN where a break follows from walls.
    wall : float
        Root mean square error of a place on the walls.
    gap : float
        How far a wall can move, about, before it meets a point of those that each parameter rests on.
    together : float
        How many of the points go together, as those of a stroke do.
    """

    covariance: Floats
    breaks: Floats
    wall: float
    gap: float
    together: float


def precision(body: ExactBody) -> Precision:
    """Statistical errors of what was fitted to a body.

    Notes
    -----
    The Fisher information of a Poisson process whose density falls across the wall as the noise's normal
    distribution does. Where the noise is smaller than the gap that each parameter's points leave, the gap
    takes its place: then the error falls with the number of points, not with its root.

    References
    ----------
    A. P. Korostelev, A. B. Tsybakov, Minimax Theory of Image Reconstruction, Springer, 1993.
    """
    model = body.model
    together = dispersion(body.points)
    information, points = np.zeros((model.size, model.size)), 0.0
    for j, run in enumerate(model.stack.runs):
        low, high = model.stack.breaks[[j, j + 1]].tolist()
        for wall, slot in zip(run.walls, model.slots[j], strict=True):
            spread = wall.boundary(low, high, NODES)
            weight = spread.areas * model.density.at(spread.points) / together
            gradient = wall.foot(spread.points).gradient
            np.add.at(information, np.ix_(slot, slot), gradient.T @ (weight[:, None] * gradient))
            points += float(weight.sum())
    gap = model.parameters / points
    width = model.sigma / INFORMATION + gap
    ledges = np.array([_ledge(model, k) for k in range(len(model.stack.breaks))]) / together
    free = np.array([join == "step" for join in model.joins]) & (ledges > 0)
    breaks = np.where(free, np.sqrt(width / np.where(free, ledges, 1.0)), np.nan)
    typical = float(np.sqrt(width * model.size / points))
    return Precision(width * _inverse(information), breaks, typical, gap, together)


def spreads(model: ExactModel, found: Precision, run: int, wall: int) -> Floats:
    """Standard errors of the `dimensions` of a wall, in their order."""
    low, high = model.stack.breaks[[run, run + 1]].tolist()
    shape, slot = model.stack.runs[run].walls[wall], model.slots[run][wall]

    def values(vector: Floats) -> Floats:
        return np.array([one.value for one in dimensions(shape.moved(vector), low, high)])

    vector = shape.vector
    steps = STEP * np.eye(len(vector))
    slope = np.stack([(values(vector + step) - values(vector - step)) / (2 * STEP) for step in steps], axis=1)
    return np.sqrt(np.einsum("ij,jk,ik->i", slope, found.covariance[np.ix_(slot, slot)], slope))


def _ledge(model: ExactModel, k: int) -> float:
    """Points per height that a movement of a break wins or loses."""
    at = np.array([model.stack.breaks[k]])
    runs: tuple[Run, ...] = model.stack.runs[max(k - 1, 0) : k + 1]
    areas = [float(run.area(at)[0]) for run in runs]
    middle = np.append(_middle(runs[0], float(at[0])), at)
    change = abs(areas[1] - areas[0]) if 0 < k < len(model.joins) - 1 else areas[0]
    return float(change * model.density.at(middle[None])[0])


def _middle(run: Run, height: float) -> Floats:
    """Centre (2,) of the walls of a run near a height."""
    rims = [wall.boundary(height - 1e-6, height + 1e-6, 64).points[:, :2] for wall in run.walls]
    return np.concatenate(rims).mean(axis=0)


def _inverse(information: Floats) -> Floats:
    """Inverse of an information matrix; what it says nothing about gets a large variance."""
    diagonal = np.diag(information)
    scale = 1 / np.sqrt(np.maximum(diagonal, FLAT * diagonal.max()))
    values, vectors = np.linalg.eigh(information * np.outer(scale, scale))
    values = np.maximum(values, FLAT * values[-1])
    return np.asarray((vectors / values) @ vectors.T * np.outer(scale, scale))
