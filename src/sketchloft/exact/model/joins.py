"""Joins: the heights of breaks that follow from the walls beside them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.model.exact_model import ExactModel, Join
from sketchloft.exact.model.kinks import kink
from sketchloft.stack import Run, Wall
from sketchloft.wall.profile import ArcProfile, ends_of
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.swept import Swept

__all__ = ["crossing", "end_pole", "joined", "natural_joins", "poles", "sole_profile"]

COARSE, FINE = 65, 1025
"""Heights at which two walls are compared, over all their reach and then between two of these."""
CLOSE = 4.0
"""Walls that come this near to each other at a break, or to the axis at an end, in noise deviations, meet."""


def joined(model: ExactModel) -> ExactModel:
    """Put every break that is no step where its walls say, and steps where spheres beside them reach."""
    breaks = model.stack.breaks.copy()
    for k, join in enumerate(model.joins):
        height = _height(model, k, join)
        if height is not None:
            breaks[k] = height
        elif 0 < k < len(breaks) - 1:
            breaks[k] = _reached(model.stack.runs[k - 1], model.stack.runs[k], float(breaks[k]))
    breaks = np.maximum.accumulate(breaks)
    return model.between(breaks)


def natural_joins(model: ExactModel) -> ExactModel:
    """Let breaks be crossings, tangents or poles where the walls beside them nearly meet so."""
    runs, breaks = model.stack.runs, model.stack.breaks
    joins: list[Join] = ["step"] * len(breaks)
    near = CLOSE * model.sigma
    for k in range(1, len(runs)):
        joins[k] = _natural(runs[k - 1], runs[k], float(breaks[k]), near)
    for k, run, side in ((0, runs[0], -1), (len(runs), runs[-1], 1)):
        pole = end_pole(run, side)
        if pole is not None and side * (pole - breaks[k]) < near:
            joins[k] = "pole"
    return joined(replace(model, joins=tuple(joins)))


def _reached(below: Run, above: Run, height: float) -> float:
    """Height nearest to a break that all spheres below and above it reach, if there is one."""
    low = max(poles(wall)[0] for wall in above.walls)
    high = min(poles(wall)[1] for wall in below.walls)
    return min(max(height, low), high) if low < high else height


def _natural(below: Run, above: Run, height: float, near: float) -> Join:
    if kink(below, above) is not None:
        return "cross"
    first, second = sole_profile(below), sole_profile(above)
    if first is None or second is None or np.hypot(*(first.centre - second.centre)) > near:
        return "step"
    (r1, g1), (r2, g2) = (radius_at(wall.profile, np.array([height])) for wall in (first, second))
    gap = abs(float(r1[0] - r2[0]))
    bend = abs(float(np.arctan(g1[0]) - np.arctan(g2[0])))
    if {first.kind, second.kind} == {"cylinder", "sphere"} and gap < near:
        arc = (first if first.kind == "sphere" else second).profile
        if isinstance(arc, ArcProfile) and abs(arc.height - height) < max(0.2 * arc.radius, near):
            return "tangent"
    if bend < 0.05:
        return "step"
    found = crossing(below, above, height, near / max(bend, 0.1) + near)
    return "step" if found is None or gap > near * (1 + abs(float(g1[0]) - float(g2[0]))) else "cross"


def _height(model: ExactModel, k: int, join: str) -> float | None:
    runs = model.stack.runs
    if join == "pole":
        return end_pole(runs[0], -1) if k == 0 else end_pole(runs[-1], 1)
    if join == "tangent":
        for run in (runs[k - 1], runs[k]):
            wall = sole_profile(run)
            if wall is not None and isinstance(wall.profile, ArcProfile):
                return wall.profile.height
    if join == "cross":
        bend = kink(runs[k - 1], runs[k])
        if bend is not None:
            return bend
        reach = min(np.diff(model.stack.breaks)[[k - 1, k]]) / 2
        return crossing(runs[k - 1], runs[k], float(model.stack.breaks[k]), float(reach))
    return None


def poles(wall: Wall) -> tuple[float, float]:
    """Heights between which a sphere or a dome lies; infinite for other walls."""
    if isinstance(wall, Swept) and wall.bows:
        return wall.tips()
    if isinstance(wall, Revolved) and isinstance(wall.profile, ArcProfile) and wall.profile.offset is None:
        return ends_of(wall.profile)
    return -np.inf, np.inf


def end_pole(run: Run, side: int) -> float | None:
    """Height at which the wall of a run, if it has one only, meets its axis as a sphere or a dome does.

    A run that is a whole torus ends where its two walls meet.

    Parameters
    ----------
    run : Run
    side : {-1, 1}
        Below or above.
    """
    torus = run.torus
    if torus is not None:
        return torus.height + side * torus.radius
    pole = poles(run.walls[0])[side > 0]
    return pole if len(run.walls) == 1 and np.isfinite(pole) else None


def sole_profile(run: Run) -> Revolved | None:
    """Return the wall of a run that has one only, and that revolved."""
    if len(run.walls) == 1 and isinstance(run.walls[0], Revolved):
        return run.walls[0]
    return None


def crossing(below: Run, above: Run, height: float, reach: float) -> float | None:
    """Height nearest to a break, within reach, where two revolved walls have the same radius."""
    first, second = sole_profile(below), sole_profile(above)
    if first is None or second is None:
        return None
    z = height + reach * np.linspace(-1, 1, COARSE)
    for wall in (first, second):
        low, high = ends_of(wall.profile)
        z = z[(z >= low) & (z <= high)]
    for _ in range(2):
        gap = _gap(first, second, z)
        change = np.flatnonzero(gap[:-1] * gap[1:] <= 0)
        if not len(change):
            return None
        i = change[np.argmin(np.abs((z[change] + z[change + 1]) / 2 - height))]
        ends, beside = z[[i, i + 1]], gap[[i, i + 1]]
        z = np.linspace(ends[0], ends[1], FINE)
    low, high = beside.tolist()
    return float(ends[0] + (ends[1] - ends[0]) * (low / (low - high) if low != high else 0.5))


def _gap(first: Revolved, second: Revolved, z: Floats) -> Floats:
    return radius_at(first.profile, z)[0] - radius_at(second.profile, z)[0]
