"""Inside: how much of a place is inside a model whose walls the noise has blurred, and how that moves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.stack import Run
from sketchloft.wall.foot import WallFoot

__all__ = ["Slab", "share_within", "slabs_of", "slopes_of"]

REACH = 5.0
"""Noise deviations beyond which a wall is taken to be a sharp step."""
FAR = 100.0
"""Noise deviations that are deep inside."""


@dataclass(frozen=True)
class Section:
    """What points see of the walls of a run.

    Parameters
    ----------
    feet : list of WallFoot
    signs : (w,) int array
        -1 for the walls of holes.
    depth, soft : lists of (n,) float arrays
        How far inside each wall, and how much of it.
    voids, share : (n,) float arrays
        How much they are outside of the holes, and inside the section.
    """

    feet: list[WallFoot]
    signs: Ints
    depth: list[Floats]
    soft: list[Floats]
    voids: Floats
    share: Floats


@dataclass(frozen=True)
class Slab:
    """A run, and the points between its breaks or near by.

    Parameters
    ----------
    run : int
    near : slice
        Which of the rising points they are.
    ends : (2,) float array
        The breaks; infinite where there is none to see.
    between : (n,) float array
        How much they are between the breaks.
    section : Section
    """

    run: int
    near: slice
    ends: Floats
    between: Floats
    section: Section


def slabs_of(points: Floats, model: ExactModel, sigma: float, *, caps: bool) -> list[Slab]:
    """Look at every run from the points.

    Parameters
    ----------
    points : (n, 3) float array
        Rising.
    model : ExactModel
    sigma : float
        Noise.
    caps : bool
        Whether the first and last break are walls.
    """
    stack, z = model.stack, points[:, 2]
    heights = stack.breaks if caps else np.r_[-np.inf, stack.breaks[1:-1], np.inf]
    found = []
    for j, run in enumerate(stack.runs):
        ends = heights[[j, j + 1]]
        if run.torus is not None:  # it ends where its walls turn into each other, at no cap
            ends = np.where([join == "pole" for join in model.joins[j : j + 2]], [-np.inf, np.inf], ends)
        first, last = np.searchsorted(z, ends + np.array([-REACH, REACH]) * sigma).tolist()
        if first == last:
            continue
        near = slice(first, last)
        below, above = (_below(height, z[near], sigma) for height in ends.tolist())
        found.append(Slab(j, near, ends, above - below, _section(points[near], run, sigma)))
    return found


def share_within(count: int, slabs: list[Slab]) -> Floats:
    """How much each of so many points is inside (n,), from 0 to 1."""
    inside = np.zeros(count)
    for slab in slabs:
        inside[slab.near] += slab.between * slab.section.share
    return inside


def slopes_of(points: Floats, model: ExactModel, slabs: list[Slab]) -> tuple[Floats, Floats]:
    """Derivatives of that by walls, breaks, tilt, log sigma and log stray, in this order.

    Parameters
    ----------
    points : (n, 3) float array
        Rising.
    model : ExactModel
    slabs : list of Slab
        What the points see of this model at its noise.

    Returns
    -------
    slope : (n, p) float array
        The last column is 0.
    reach : (p,) float array
        Largest movement of a wall that a unit of each parameter makes.
    """
    sigma, walls, k = model.sigma, model.size, len(model.stack.breaks)
    # Each column in one piece: they are what is worked on.
    slope, reach = np.zeros((walls + k + 4, len(points))).T, np.zeros(walls + k + 4)
    reach[walls:-1] = 1.0
    for slab in slabs:
        j, near, between, part = slab.run, slab.near, slab.between, slab.section.share
        part_slope, tilt, grown = _section_slopes(points[near], model, slab)
        beside = slope[near]
        for slot, values, farthest in part_slope:
            columns = slice(slot[0], slot[-1] + 1) if (slot[1:] - slot[:-1] == 1).all() else slot
            beside[:, columns] += between[:, None] * values
            reach[slot] = np.maximum(reach[slot], farthest)
        away = slab.ends - points[near, 2, None]
        bell = np.exp(-0.5 * (away / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        slope[near, walls + j] -= bell[:, 0] * part
        slope[near, walls + j + 1] += bell[:, 1] * part
        # The tilt turns points by (a, b, 0): their heights rise by a y - b x.
        fall = part * (bell[:, 0] - bell[:, 1])
        slope[near, walls + k] += between * tilt[:, 0] + fall * points[near, 1]
        slope[near, walls + k + 1] += between * tilt[:, 1] - fall * points[near, 0]
        drop = -bell * np.where(np.isfinite(away), away, 0.0)
        slope[near, walls + k + 2] += between * grown + part * (drop[:, 1] - drop[:, 0])
    return slope, reach


def _below(height: float, z: Floats, sigma: float) -> Floats:
    """Probability (n,) of rising heights z (n,) to be below another; far from it 0 or 1."""
    from scipy.special import ndtr  # noqa: PLC0415

    first, last = np.searchsorted(z, (height - REACH * sigma, height + REACH * sigma)).tolist()
    share = np.zeros(len(z))
    share[:first] = 1.0
    share[first:last] = ndtr((height - z[first:last]) / sigma)
    return share


def _section(points: Floats, run: Run, sigma: float) -> Section:
    from scipy.special import ndtr  # noqa: PLC0415

    feet = [wall.foot(points) for wall in run.walls]
    signs = np.array([run.sign(i) for i in range(len(feet))])
    depth = [
        -sign * (foot.distance + sigma**2 / 2 * foot.curvature)
        for sign, foot in zip(signs, feet, strict=True)
    ]
    if run.torus is not None:  # each wall is one to the points on its own side only
        outside = run.torus.beyond(points)
        sides: tuple[NDArray[np.bool_], ...] = (outside, ~outside)
        depth = [np.where(side, d, FAR * sigma) for side, d in zip(sides, depth, strict=True)]
    soft = [ndtr(d / sigma) for d in depth]
    pieces = len(soft) - run.holes
    outer = sum(soft[1:pieces], start=soft[0]) if pieces else np.ones(len(points))
    voids = math.prod(soft[pieces:], start=np.ones(len(points)))
    return Section(feet, signs, depth, soft, voids, outer * voids)


def _section_slopes(
    points: Floats, model: ExactModel, slab: Slab
) -> tuple[list[tuple[Ints, Floats, Floats]], Floats, Floats]:
    """Derivatives of a section's share by each wall with their reach, by the tilt and by log sigma."""
    sigma, j, seen = model.sigma, slab.run, slab.section
    tilt, grown = np.zeros((len(points), 2)), np.zeros(len(points))
    slopes: list[tuple[Ints, Floats, Floats]] = []
    for i, (foot, sign, depth) in enumerate(zip(seen.feet, seen.signs, seen.depth, strict=True)):
        bell = np.exp(-0.5 * (depth / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        bell = bell * (seen.voids if sign > 0 else seen.share / np.maximum(seen.soft[i], 1e-12))
        values = -sign * bell[:, None] * foot.gradient
        near = np.abs(depth) < REACH * sigma
        farthest = np.abs(foot.gradient[near]).max(axis=0, initial=0.2)
        slopes.append((model.slots[j][i], values, farthest))
        if foot.by_ends is not None:
            ends = model.size + np.array([j, j + 1])
            slopes.append((ends, -sign * bell[:, None] * foot.by_ends, np.ones(2)))
        # A point turned by (a, b, 0) moves by (b z, -a z, a y - b x).
        x, y, z = points.T
        nx, ny, nz = foot.normal.T
        tilt[:, 0] -= sign * bell * (nz * y - ny * z)
        tilt[:, 1] -= sign * bell * (nx * z - nz * x)
        grown -= bell * (depth + sign * sigma**2 * foot.curvature)
    return slopes, tilt, grown
