"""Expected: how many points a model expects, and how that changes with its parameters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.motion import Bools
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.gauss import gauss
from sketchloft.stack import Run
from sketchloft.wall.foot import WallBoundary

__all__ = [
    "WallNodes",
    "empty_shell",
    "expected_points",
    "expected_slope",
    "mass_nodes",
    "section_mass",
    "wall_nodes",
]

NODES = 120
"""Points per wall to integrate the density with."""
THIN = 1e-6
"""Thickness of a section that stands for none."""
RADIAL = gauss(3)


@dataclass(frozen=True)
class WallNodes:
    """Integration points of one wall.

    Parameters
    ----------
    run, wall : int
        Which wall it is.
    sign : {1, -1}
        -1 for the wall of a hole.
    spread : WallBoundary
    """

    run: int
    wall: int
    sign: int
    spread: WallBoundary


def wall_nodes(model: ExactModel) -> list[WallNodes]:
    """Integration points of every wall between its breaks."""
    return [
        WallNodes(j, i, run.sign(i), wall.boundary(low, high, NODES))
        for j, (run, low, high) in enumerate(model.stack.slabs())
        if high > low
        for i, wall in enumerate(run.walls)
    ]


def mass_nodes(model: ExactModel, nodes: list[WallNodes]) -> tuple[Floats, Floats]:
    """Points (m, 3) in the solid and the volumes (m,) they stand for; those of holes are negative."""
    fans = [(node.sign, *_fan(node.spread)) for node in nodes]
    points, volumes = [at for _, at, _ in fans], [sign * volume for sign, _, volume in fans]
    if model.core is not None:
        points.append(model.core[:, :3])
        volumes.append(-model.core[:, 3])
    return np.concatenate(points), np.concatenate(volumes)


def expected_points(model: ExactModel, nodes: list[WallNodes]) -> float:
    """Expected number of points inside; infinite where the model has lost all of them."""
    points, volumes = mass_nodes(model, nodes)
    mass = float(model.density.at(points) @ volumes)
    return mass if mass > 0 else np.inf


def expected_slope(model: ExactModel, nodes: list[WallNodes], free: Bools, *, caps: bool) -> Floats:
    """Derivatives of the expected number of points by the walls and breaks that are free; 0 by others.

    Parameters
    ----------
    model : ExactModel
    nodes : list of WallNodes
        Of this model.
    free : (p,) bool array
        Of all parameters.
    caps : bool
        Whether the first and last break count.
    """
    walls, breaks = model.size, model.stack.breaks
    slope = np.zeros(walls + len(breaks))
    for node in nodes:
        slot, ends = model.slots[node.run][node.wall], slice(walls + node.run, walls + node.run + 2)
        if not (free[slot].any() or free[ends].any()):
            continue
        at, weight = node.spread.points, node.spread.areas * model.density.at(node.spread.points)
        foot = model.stack.runs[node.run].walls[node.wall].foot(at)
        if free[slot].any():
            np.add.at(slope, slot, -node.sign * weight @ foot.gradient)
        if foot.by_ends is not None:
            slope[ends] -= node.sign * weight @ foot.by_ends
    for j, run in enumerate(model.stack.runs):
        for k, sign in ((j, -1), (j + 1, 1)):
            if free[walls + k] and (caps or 0 < k < len(breaks) - 1):
                slope[walls + k] += sign * section_mass(model, run, float(breaks[k]))
    return slope


def empty_shell(model: ExactModel, count: int) -> float:
    """Expected width V / (n S) of the empty shell that so many points leave inside the walls."""
    nodes = wall_nodes(model)
    _, volumes = mass_nodes(model, nodes)
    surface = sum(float(node.spread.areas.sum()) for node in nodes)
    return float(volumes.sum()) / (count * surface)


def _fan(spread: WallBoundary) -> tuple[Floats, Floats]:
    """Spread wall points over the sections that they enclose (Gauss's theorem in each section)."""
    at, areas = spread.points, spread.areas
    centre = at[:, :2].mean(axis=0)  # any point will do
    spoke = at[:, :2] - centre
    share = areas * np.einsum("ij,ij->i", spread.normals[:, :2], spoke) / 2
    x, w = RADIAL
    t, weight = (x + 1) / 2, w / 2
    points = np.empty((len(t), len(at), 3))
    points[..., :2], points[..., 2] = centre + t[:, None, None] * spoke, at[:, 2]
    return points.reshape(-1, 3), np.ravel((2 * t * weight)[:, None] * share)


def section_mass(model: ExactModel, run: Run, height: float) -> float:
    """Expected points per height of a run's section at a height."""
    if len(model.density.coefficients) == 1:
        return float(run.area(np.array([height]))[0] * model.density.at(np.zeros((1, 3)))[0])
    total = 0.0
    for i, wall in enumerate(run.walls):
        points, volumes = _fan(wall.boundary(height - THIN / 2, height + THIN / 2, 64))
        total += run.sign(i) * float(model.density.at(points) @ volumes) / THIN
    return total
