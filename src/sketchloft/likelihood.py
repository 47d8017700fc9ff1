"""Likelihood: how well walls, noise and density explain the points, and which way they should move.

The points are a Poisson process of density ``rho(x) * inside(x) + stray``, where ``inside`` falls from 1 to
0 across the walls as the normal distribution of the noise does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.exact_model import ExactModel
from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.stack import Run, Wall
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import ArcProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

__all__ = [
    "Evaluation",
    "beside_walls",
    "covers",
    "evaluate",
    "mass_nodes",
    "share_of",
    "sound",
    "value_of",
    "wall_nodes",
]

REACH = 5.0
"""Noise deviations beyond which a wall is taken to be a sharp step."""
LEVELS = 17
"""Heights of a run at which its sections are looked at."""
NODES = 120
"""Points per wall to integrate the density with."""
RADIAL = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True)
class Evaluation:
    """The log likelihood and its derivatives by walls, breaks, tilt and log sigma, in this order.

    Parameters
    ----------
    value : float
        But for terms that no parameter changes.
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
    inside = _inside(points, model, width / 3, gradient=False)[0]
    return np.asarray(inside < 0.9987)


def evaluate(points: Floats, model: ExactModel, *, caps: bool = True) -> Evaluation:
    """Evaluate the likelihood of the points (n, 3) and its derivatives.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    caps : bool
        Whether the first and last break are walls. Without, all points must lie between them.
    """
    walls, breaks = model.size, len(model.stack.breaks)
    inside, slope, reach = _inside(points, model, model.sigma, gradient=True, caps=caps)
    rho = model.density.at(points)
    total = rho * inside + model.stray
    ratio = (rho / total)[:, None] * slope
    score = ratio.sum(axis=0)
    value = float(np.log(total).sum())
    if sound(model):
        value -= _mass(model)
        score[: walls + breaks] -= _mass_slope(model, caps=caps)
    else:
        value = -np.inf
    return Evaluation(value, score, ratio.T @ ratio, reach)


def value_of(points: Floats, model: ExactModel, *, caps: bool = True) -> float:
    """Return the log likelihood alone, as `evaluate` does."""
    if not sound(model):
        return -np.inf
    inside = _inside(points, model, model.sigma, gradient=False, caps=caps)[0]
    return float(np.log(model.density.at(points) * inside + model.stray).sum()) - _mass(model)


def share_of(points: Floats, model: ExactModel, *, caps: bool = True) -> Floats:
    """(n,) probability of each point to be none of the strays."""
    inside = model.density.at(points) * _inside(points, model, model.sigma, gradient=False, caps=caps)[0]
    return inside / (inside + model.stray)


def sound(model: ExactModel) -> bool:
    """Whether the breaks rise, and every wall encloses something and nowhere crosses itself."""
    breaks = model.stack.breaks
    if not np.isfinite(model.vector).all() or not (np.diff(breaks) > 0).all():
        return False
    for j, run in enumerate(model.stack.runs):
        if any(not covers(wall, breaks[j], breaks[j + 1]) for wall in run.walls):
            return False
        ends = np.linspace(breaks[j], breaks[j + 1], LEVELS)
        at = ends[LEVELS // 3 : -(LEVELS // 3)]  # a sphere may end before its break does
        if any((wall.area(at) <= 0).any() or not _simple(wall, ends[:: LEVELS // 8]) for wall in run.walls):
            return False
    return True


def _simple(wall: Wall, heights: Floats) -> bool:
    """Whether the sections at heights (m,) nowhere cross themselves."""
    from shapely import is_valid, linearrings, polygons  # noqa: PLC0415

    if isinstance(wall, Lofted):
        count = 4 * wall.poles.shape[1]
        rings = wall.ring(heights, np.arange(count) / count)
    elif isinstance(wall, Swept) and not isinstance(wall.outline, (Circle, Ellipse)):
        rings = wall.outline.boundary(64).points[None]
    else:
        return True
    return bool(is_valid(polygons(linearrings(rings))).all())


def covers(wall: Wall, low: float, high: float) -> bool:
    """Whether a spline's knots, or a torus, reach over a stretch of heights."""
    ends = (-np.inf, np.inf)
    if isinstance(wall, Lofted):
        ends = wall.knots[0], wall.knots[-1]
    if isinstance(wall, Revolved) and isinstance(wall.profile, SplineProfile):
        ends = wall.profile.knots[0], wall.profile.knots[-1]
        if not (wall.area(np.linspace(low, high, LEVELS)) > 0).all():
            return False
    if (
        isinstance(wall, Revolved)
        and isinstance(wall.profile, ArcProfile)
        and wall.profile.offset is not None
    ):
        ends = wall.profile.height - wall.profile.radius, wall.profile.height + wall.profile.radius
    return bool(ends[0] <= low and high <= ends[1])


def _inside(
    points: Floats, model: ExactModel, sigma: float, *, gradient: bool, caps: bool = True
) -> tuple[Floats, Floats, Floats]:
    """Soft indicator (n,), its derivatives (n, walls + breaks + 2 + 1), and the walls' reach."""
    from scipy.special import ndtr  # noqa: PLC0415

    stack = model.stack
    walls, k = model.size, len(stack.breaks)
    z = points[:, 2]
    heights = stack.breaks if caps else np.r_[-np.inf, stack.breaks[1:-1], np.inf]
    step = ndtr((heights - z[:, None]) / sigma)
    inside = np.zeros(len(points))
    slope = np.zeros((len(points), walls + k + 3)) if gradient else np.zeros((0, 0))
    reach = np.zeros(walls + k + 3)
    reach[walls:] = 1.0
    for j in range(len(stack.runs)):
        low, high = heights[j] - REACH * sigma, heights[j + 1] + REACH * sigma
        near = np.flatnonzero((z > low) & (z < high))
        if not len(near):
            continue
        between = step[near, j + 1] - step[near, j]
        part, part_slope, tilt, grown = _section(points[near], model, j, sigma, gradient=gradient)
        inside[near] += between * part
        if not gradient:
            continue
        for slot, values, farthest in part_slope:
            slope[near[:, None], slot] += between[:, None] * values
            reach[slot] = np.maximum(reach[slot], farthest)
        away = heights[[j, j + 1]] - z[near, None]
        bell = np.exp(-0.5 * (away / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        slope[near, walls + j] -= bell[:, 0] * part
        slope[near, walls + j + 1] += bell[:, 1] * part
        # The tilt turns points by (a, b, 0): their heights rise by a y - b x.
        fall = part * (bell[:, 0] - bell[:, 1])
        slope[near, walls + k] += between * tilt[:, 0] + fall * points[near, 1]
        slope[near, walls + k + 1] += between * tilt[:, 1] - fall * points[near, 0]
        ends = -bell * np.where(np.isfinite(away), away, 0.0)
        slope[near, walls + k + 2] += between * grown + part * (ends[:, 1] - ends[:, 0])
    return inside, slope, reach


def _section(
    points: Floats, model: ExactModel, j: int, sigma: float, *, gradient: bool
) -> tuple[Floats, list[tuple[Ints, Floats, Floats]], Floats, Floats]:
    """Soft indicator of a run's section, its derivatives by each wall, by the tilt and by log sigma."""
    run = model.stack.runs[j]
    from scipy.special import ndtr  # noqa: PLC0415

    feet = [wall.foot(points) for wall in run.walls]
    signs = np.array([run.sign(i) for i in range(len(feet))])
    depth = [
        -sign * (foot.distance + sigma**2 / 2 * foot.curvature)
        for sign, foot in zip(signs, feet, strict=True)
    ]
    soft = [ndtr(d / sigma) for d in depth]
    outer = np.zeros(len(points)) if (signs > 0).any() else np.ones(len(points))
    for s, sign in zip(soft, signs, strict=True):
        if sign > 0:
            outer = outer + s
    voids = np.ones(len(points))
    for s, sign in zip(soft, signs, strict=True):
        if sign < 0:
            voids = voids * s
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
        # A point turned by (a, b, 0) moves by (b z, -a z, a y - b x).
        x, y, z = points.T
        nx, ny, nz = foot.normal.T
        tilt[:, 0] -= signs[i] * bell * (nz * y - ny * z)
        tilt[:, 1] -= signs[i] * bell * (nx * z - nz * x)
        grown -= bell * depth[i]
    return outer * voids, slopes, tilt, grown


def wall_nodes(model: ExactModel) -> list[tuple[int, int, Floats, Floats, Floats, int]]:
    """Run, wall, points, normals, areas and sign of each wall's integration points."""
    found = []
    breaks = model.stack.breaks
    for j, run in enumerate(model.stack.runs):
        if breaks[j + 1] <= breaks[j]:
            continue
        for i, wall in enumerate(run.walls):
            spread = wall.boundary(breaks[j], breaks[j + 1], NODES)
            found.append((j, i, spread.points, spread.normals, spread.areas, run.sign(i)))
    return found


def mass_nodes(model: ExactModel) -> tuple[Floats, Floats]:
    """Points (m, 3) in the solid and the volumes (m,) they stand for; those of holes are negative."""
    points, volumes = [], []
    for _, _, at, normals, areas, sign in wall_nodes(model):
        p, v = _fan(at, normals, areas)
        points.append(p)
        volumes.append(sign * v)
    if model.core is not None:
        points.append(model.core[:, :3])
        volumes.append(-model.core[:, 3])
    return np.concatenate(points), np.concatenate(volumes)


def _fan(at: Floats, normals: Floats, areas: Floats) -> tuple[Floats, Floats]:
    """Spread wall points over the sections that they enclose (Gauss's theorem in each section)."""
    centre = (areas @ at[:, :2]) / max(float(areas.sum()), 1e-300)
    spoke = at[:, :2] - centre
    share = areas * np.einsum("ij,ij->i", normals[:, :2], spoke) / 2
    x, w = RADIAL
    t, weight = (x + 1) / 2, w / 2
    points = np.concatenate([np.column_stack([centre + r * spoke, at[:, 2]]) for r in t])
    return points, np.concatenate([2 * r * v * share for r, v in zip(t, weight, strict=True)])


def _mass(model: ExactModel) -> float:
    points, volumes = mass_nodes(model)
    mass = float(model.density.at(points) @ volumes)
    return mass if mass > 0 else np.inf  # it has lost all its points


def _mass_slope(model: ExactModel, *, caps: bool) -> Floats:
    """Derivatives of the expected number of points by walls and breaks."""
    walls, breaks = model.size, model.stack.breaks
    slope = np.zeros(walls + len(breaks))
    for j, i, at, _, areas, sign in wall_nodes(model):
        gradient = model.stack.runs[j].walls[i].foot(at).gradient
        np.add.at(slope, model.slots[j][i], -sign * (areas * model.density.at(at)) @ gradient)
    for j, run in enumerate(model.stack.runs):
        for k, sign in ((j, -1), (j + 1, 1)):
            if not caps and k in (0, len(breaks) - 1):
                continue
            slope[walls + k] += sign * _section_mass(model, run, float(breaks[k]))
    return slope


def _section_mass(model: ExactModel, run: Run, height: float) -> float:
    """Expected points per height of a run's section at a height."""
    total, thin = 0.0, 1e-6
    for i, wall in enumerate(run.walls):
        if len(model.density.coefficients) == 1:
            total += (
                run.sign(i) * float(wall.area(np.array([height]))[0]) * model.density.at(np.zeros((1, 3)))[0]
            )
            continue
        spread = wall.boundary(height - thin / 2, height + thin / 2, 64)
        points, volumes = _fan(spread.points, spread.normals, spread.areas / thin)
        total += run.sign(i) * float(model.density.at(points) @ volumes)
    return total
