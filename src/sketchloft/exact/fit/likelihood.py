"""Likelihood: how well walls, noise and density explain the points, and which way they should move.

The points are a Poisson process of density ``rho(x) * inside(x) + stray``, where ``inside`` falls from 1 to
0 across the walls as the normal distribution of the noise does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.fit.expected import expected_points, expected_slope, wall_nodes
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.soundness import sound

__all__ = ["Evaluation", "beside_walls", "evaluate", "losses", "share_of", "value_of"]

REACH = 5.0
"""Noise deviations beyond which a wall is taken to be a sharp step."""
FAR = 100.0
"""Noise deviations that are deep inside."""


@dataclass(frozen=True)
class Evaluation:
    """The log likelihood and its derivatives by walls, breaks, tilt, log sigma and log stray, in this order.

    Parameters
    ----------
    value : float
    score : (p,) float array
    information : (p, p) float array
        Sum of the outer products of the points' scores.
    reach : (p,) float array
        Largest movement of a wall that a unit of each parameter makes.
    """

    value: float
    score: Floats
    information: Floats
    reach: Floats


def beside_walls(points: Floats, model: ExactModel, width: float) -> NDArray[np.bool_]:
    """(n,) whether points (n, 3) lie within a width of a wall or a break, or outside."""
    return np.asarray(_share_inside(points, model, width / 3) < 0.9987)


def evaluate(points: Floats, model: ExactModel, *, caps: bool = True) -> Evaluation:
    """Evaluate the likelihood of the points (n, 3) and its derivatives.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    caps : bool
        Whether the first and last break are walls. Without, all points must lie between them.
    """
    size = model.size + len(model.stack.breaks)
    if not sound(model):
        nothing = np.zeros(size + 4)
        return Evaluation(-np.inf, nothing, np.zeros((size + 4, size + 4)), nothing)
    points = points[_rising(points)]
    inside, slope, reach = _inside(points, model, model.sigma, gradient=True, caps=caps)
    rho = model.density.at(points)
    total = rho * inside + model.stray
    ratio = (rho / total)[:, None] * slope
    ratio[:, -1] = model.stray / total
    score = ratio.sum(axis=0)
    nodes = wall_nodes(model)
    score[:size] -= expected_slope(model, nodes, caps=caps)
    score[-1] -= model.stray * model.space
    value = float(np.log(total).sum()) - expected_points(model, nodes) - model.stray * model.space
    return Evaluation(value, score, ratio.T @ ratio, reach)


def value_of(points: Floats, model: ExactModel, *, caps: bool = True) -> float:
    """Return the log likelihood alone, as `evaluate` does."""
    if not sound(model):
        return -np.inf
    points = points[_rising(points)]
    inside = _inside(points, model, model.sigma, gradient=False, caps=caps)[0]
    total = model.density.at(points) * inside + model.stray
    expected = expected_points(model, wall_nodes(model)) + model.stray * model.space
    return float(np.log(total).sum()) - expected


def share_of(points: Floats, model: ExactModel, *, caps: bool = True) -> Floats:
    """(n,) probability of each point to be none of the strays."""
    inside = model.density.at(points) * _share_inside(points, model, model.sigma, caps=caps)
    return inside / (inside + model.stray)


def losses(points: Floats, model: ExactModel) -> Floats:
    """(n,) what points (n, 3) cost in log likelihood beside ones that are deep inside."""
    inside = _share_inside(points, model, model.sigma)
    return -np.log(inside + model.stray / model.density.at(points))


def _rising(points: Floats) -> Ints:
    """Order (n,) in which the points of a run are all in a row."""
    return np.argsort(points[:, 2], kind="stable")


def _share_inside(points: Floats, model: ExactModel, sigma: float, *, caps: bool = True) -> Floats:
    """Soft indicator (n,) of points in any order."""
    order = _rising(points)
    inside = np.empty(len(points))
    inside[order] = _inside(points[order], model, sigma, gradient=False, caps=caps)[0]
    return inside


def _inside(
    points: Floats, model: ExactModel, sigma: float, *, gradient: bool, caps: bool = True
) -> tuple[Floats, Floats, Floats]:
    """Soft indicator (n,) of rising points, its derivatives (n, walls + breaks + 4), and the walls' reach."""
    stack = model.stack
    walls, k = model.size, len(stack.breaks)
    z = points[:, 2]
    heights = stack.breaks if caps else np.r_[-np.inf, stack.breaks[1:-1], np.inf]
    inside = np.zeros(len(points))
    slope = np.zeros((len(points), walls + k + 4)) if gradient else np.zeros((0, 0))
    reach = np.zeros(walls + k + 4)
    reach[walls:-1] = 1.0
    for j in range(len(stack.runs)):
        ends = heights[[j, j + 1]]
        if stack.runs[j].torus is not None:  # it ends where its walls turn into each other, at no cap
            ends = np.where([join == "pole" for join in model.joins[j : j + 2]], [-np.inf, np.inf], ends)
        first, last = np.searchsorted(z, ends + np.array([-REACH, REACH]) * sigma).tolist()
        if first == last:
            continue
        near = slice(first, last)
        below, above = (_below(height, z[near], sigma) for height in ends.tolist())
        between = above - below
        part, part_slope, tilt, grown = _section(points[near], model, j, sigma, gradient=gradient)
        inside[near] += between * part
        if not gradient:
            continue
        beside = slope[near]
        for slot, values, farthest in part_slope:
            columns = slice(slot[0], slot[-1] + 1) if (np.diff(slot) == 1).all() else slot
            beside[:, columns] += between[:, None] * values
            reach[slot] = np.maximum(reach[slot], farthest)
        away = ends - z[near, None]
        bell = np.exp(-0.5 * (away / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        slope[near, walls + j] -= bell[:, 0] * part
        slope[near, walls + j + 1] += bell[:, 1] * part
        # The tilt turns points by (a, b, 0): their heights rise by a y - b x.
        fall = part * (bell[:, 0] - bell[:, 1])
        slope[near, walls + k] += between * tilt[:, 0] + fall * points[near, 1]
        slope[near, walls + k + 1] += between * tilt[:, 1] - fall * points[near, 0]
        drop = -bell * np.where(np.isfinite(away), away, 0.0)
        slope[near, walls + k + 2] += between * grown + part * (drop[:, 1] - drop[:, 0])
    return inside, slope, reach


def _below(height: float, z: Floats, sigma: float) -> Floats:
    """Probability (n,) of rising heights z (n,) to be below another; far from it 0 or 1."""
    from scipy.special import ndtr  # noqa: PLC0415

    first, last = np.searchsorted(z, (height - REACH * sigma, height + REACH * sigma)).tolist()
    share = np.zeros(len(z))
    share[:first] = 1.0
    share[first:last] = ndtr((height - z[first:last]) / sigma)
    return share


def _section(
    points: Floats, model: ExactModel, j: int, sigma: float, *, gradient: bool
) -> tuple[Floats, list[tuple[Ints, Floats, Floats]], Floats, Floats]:
    """Soft indicator of a run's section, its derivatives by each wall, by the tilt and by log sigma."""
    from scipy.special import ndtr  # noqa: PLC0415

    run = model.stack.runs[j]
    feet = [wall.foot(points) for wall in run.walls]
    signs = np.array([run.sign(i) for i in range(len(feet))])
    depth = [
        -sign * (foot.distance + sigma**2 / 2 * foot.curvature)
        for sign, foot in zip(signs, feet, strict=True)
    ]
    if run.torus is not None:  # each wall is one to the points on its own side only
        outside = run.torus.beyond(points)
        sides = (outside, ~outside)
        depth = [np.where(side, d, FAR * sigma) for side, d in zip(sides, depth, strict=True)]
    soft = [ndtr(d / sigma) for d in depth]
    pieces = len(soft) - run.holes
    outer = np.sum(soft[:pieces], axis=0) if pieces else np.ones(len(points))
    voids = np.prod(soft[pieces:], axis=0)
    tilt, grown = np.zeros((len(points), 2)), np.zeros(len(points))
    slopes: list[tuple[Ints, Floats, Floats]] = []
    if not gradient:
        return outer * voids, slopes, tilt, grown
    for i, foot in enumerate(feet):
        bell = np.exp(-0.5 * (depth[i] / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        bell = bell * (voids if signs[i] > 0 else outer * voids / np.maximum(soft[i], 1e-12))
        values = -signs[i] * bell[:, None] * foot.gradient
        near = np.abs(depth[i]) < REACH * sigma
        farthest = np.abs(foot.gradient[near]).max(axis=0, initial=0.2)
        slopes.append((model.slots[j][i], values, farthest))
        if foot.by_ends is not None:
            ends = model.size + np.array([j, j + 1])
            slopes.append((ends, -signs[i] * bell[:, None] * foot.by_ends, np.ones(2)))
        # A point turned by (a, b, 0) moves by (b z, -a z, a y - b x).
        x, y, z = points.T
        nx, ny, nz = foot.normal.T
        tilt[:, 0] -= signs[i] * bell * (nz * y - ny * z)
        tilt[:, 1] -= signs[i] * bell * (nx * z - nz * x)
        grown -= bell * (depth[i] + signs[i] * sigma**2 * foot.curvature)
    return outer * voids, slopes, tilt, grown
