"""Inside: how much of a place is inside a model whose walls the noise has blurred, and how that moves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.fit.motion import LAST, Bools
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


def slopes_of(points: Floats, model: ExactModel, slabs: list[Slab], free: Bools) -> tuple[Floats, Floats]:
    """Derivatives of that by walls, breaks, tilt, log sigma and log stray, in this order.

    Parameters
    ----------
    points : (n, 3) float array
        Rising.
    model : ExactModel
    slabs : list of Slab
        What the points see of this model at its noise.
    free : (p,) bool array
        Parameters to differentiate by.

    Returns
    -------
    slope : (n, p) float array
        The last column is 0, and so are most of those of parameters that are not free.
    reach : (p,) float array
        Largest movement of a wall that a unit of each parameter makes.
    """
    sigma, walls, k = model.sigma, model.size, len(model.stack.breaks)
    # Each column in one piece: they are what is worked on.
    slope, reach = np.zeros((walls + k + LAST, len(points))).T, np.zeros(walls + k + LAST)
    reach[walls:-1] = 1.0
    tilts, blurs = bool(free[walls + k : walls + k + 2].any()), bool(free[walls + k + 2])
    for slab in slabs:
        j, near, between, part = slab.run, slab.near, slab.between, slab.section.share
        at_ends = bool(free[walls + j : walls + j + 2].any())
        if not (tilts or blurs or at_ends or any(free[slot].any() for slot in model.slots[j])):
            continue
        bells = _bells(slab.section, sigma)
        for slot, values, farthest in _by_walls(model, slab, bells, free):
            for column, value in zip(slot.tolist(), values.T, strict=True):  # of a wall may be one, too
                slope[near, column] += between * value
            np.maximum.at(reach, slot, farthest)
        if not (tilts or blurs or at_ends):
            continue
        away = slab.ends - points[near, 2, None]
        bell = np.exp(-0.5 * (away / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        slope[near, walls + j] -= bell[:, 0] * part
        slope[near, walls + j + 1] += bell[:, 1] * part
        if tilts:
            # The tilt turns points by (a, b, 0): their heights rise by a y - b x.
            fall = part * (bell[:, 0] - bell[:, 1])
            tilt = _by_tilt(points[near], slab.section, bells)
            slope[near, walls + k] += between * tilt[:, 0] + fall * points[near, 1]
            slope[near, walls + k + 1] += between * tilt[:, 1] - fall * points[near, 0]
        if blurs:
            drop = -bell * np.where(np.isfinite(away), away, 0.0)
            grown = _by_noise(slab.section, bells, sigma)
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


def _bells(seen: Section, sigma: float) -> list[Floats]:
    """By how much each wall's depth changes the share (n,) of a section."""
    bells = []
    for i, (sign, depth) in enumerate(zip(seen.signs, seen.depth, strict=True)):
        bell = np.exp(-0.5 * (depth / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        bells.append(bell * (seen.voids if sign > 0 else seen.share / np.maximum(seen.soft[i], 1e-12)))
    return bells


def _by_walls(
    model: ExactModel, slab: Slab, bells: list[Floats], free: Bools
) -> Iterator[tuple[Ints, Floats, Floats]]:
    """Derivatives (n, q) of a section's share by each wall, where it is free, and their reach."""
    j, seen = slab.run, slab.section
    ends = model.size + np.array([j, j + 1])
    for i, (foot, sign, depth, bell) in enumerate(zip(seen.feet, seen.signs, seen.depth, bells, strict=True)):
        slot = model.slots[j][i]
        if free[slot].any():
            near = np.abs(depth) < REACH * model.sigma
            farthest = np.abs(foot.gradient[near]).max(axis=0, initial=0.2)
            yield slot, -sign * bell[:, None] * foot.gradient, farthest
        if foot.by_ends is not None and free[ends].any():
            yield ends, -sign * bell[:, None] * foot.by_ends, np.ones(2)


def _by_tilt(points: Floats, seen: Section, bells: list[Floats]) -> Floats:
    """Derivatives (n, 2) of a section's share: a point turned by (a, b, 0) moves by (b z, -a z, ay - bx)."""
    tilt = np.zeros((len(points), 2))
    x, y, z = points.T
    for foot, sign, bell in zip(seen.feet, seen.signs, bells, strict=True):
        nx, ny, nz = foot.normal.T
        tilt[:, 0] -= sign * bell * (nz * y - ny * z)
        tilt[:, 1] -= sign * bell * (nx * z - nz * x)
    return tilt


def _by_noise(seen: Section, bells: list[Floats], sigma: float) -> Floats:
    """Derivative (n,) of a section's share by log sigma."""
    grown = np.zeros(len(seen.share))
    for foot, sign, depth, bell in zip(seen.feet, seen.signs, seen.depth, bells, strict=True):
        grown -= bell * (depth + sign * sigma**2 * foot.curvature)
    return grown
