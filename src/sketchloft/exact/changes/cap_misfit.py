"""Cap misfit: how far the flat faces across the axis are from where the points end, as a likelihood."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Ints
from sketchloft.exact.changes.misfit import BANDS, CHANCE, FEWEST
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.stack import THIN, Run, section_boundary

__all__ = ["cap_misfit"]

LATTICE = 40
"""Places across a face, each way, that tell how much of each patch lies on it."""
PATCHES = 4
"""Patches across a face, each way: what is finer is chance more often than shape."""


def cap_misfit(points: Floats, model: ExactModel, together: float) -> float:
    """Log likelihood that other faces would gain at least in the place of those across the axis, about.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    together : float
        How many of the points go together.

    Notes
    -----
    As for walls (`misfit`) one half of a band around the right face is filled, everywhere alike, and the mean
    does not count. A flat end in the place of a roof has too many points in its middle and none at the rim.
    """
    total = np.zeros(len(BANDS))
    for k, join in enumerate(model.joins):
        if join == "step":
            total += _of_face(points, model, _face(model, k), together)
    return float(total.max())


@dataclass(frozen=True)
class _Face:
    """What of the plane at a break bounds the solid: where one of the runs beside it is without the other."""

    height: float
    beside: tuple[Run | None, Run | None]
    low: Floats
    high: Floats

    def depth(self, places: Floats) -> Floats:
        """How far (m,) places (m, 2) on it are from its rim, negative off it."""
        below, above = (
            _depth(run, places, z)
            for run, z in zip(self.beside, (self.height - THIN, self.height + THIN), strict=True)
        )
        return np.maximum(np.minimum(below, -above), np.minimum(above, -below))

    def patch(self, places: Floats) -> Ints:
        """Which patch (m,) places belong to."""
        column, row = np.clip((places - self.low) / (self.high - self.low) * PATCHES, 0, PATCHES - 1).T
        return np.asarray(row.astype(np.intp) * PATCHES + column.astype(np.intp))


def _face(model: ExactModel, k: int) -> _Face:
    """The face at a break, and the rectangle around its runs."""
    runs, height = (None, *model.stack.runs, None), float(model.stack.breaks[k])
    beside = runs[k], runs[k + 1]
    rims = [
        section_boundary(wall, z, 64).points[:, :2]
        for run, z in zip(beside, (height - 2 * THIN, height + 2 * THIN), strict=True)
        for wall in (run.walls if run else ())
    ]
    corners = np.concatenate(rims)
    return _Face(height, beside, corners.min(axis=0), corners.max(axis=0))


def _depth(run: Run | None, places: Floats, height: float) -> Floats:
    """How far (m,) places (m, 2) in a run's section are from its walls, negative outside."""
    if run is None:
        return np.full(len(places), -np.inf)
    at = np.column_stack([places, np.full(len(places), height)])
    depth = np.array([-run.sign(i) * wall.foot(at).distance for i, wall in enumerate(run.walls)])
    outer = len(run.walls) - run.holes
    return np.asarray(np.minimum(depth[:outer].max(axis=0), depth[outer:].min(axis=0, initial=np.inf)))


def _of_face(points: Floats, model: ExactModel, face: _Face, together: float) -> Floats:
    """What the points have against a face, for each width of the band."""
    steps = (np.arange(LATTICE) + 0.5) / LATTICE
    across = face.high - face.low
    lattice = face.low + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * across
    widths = np.array(BANDS) * model.sigma
    away = np.abs(points[:, 2] - face.height)
    near, away = points[away < widths.max(), :2], away[away < widths.max()]
    patches, inner = face.patch(near), face.depth(near)
    deep = face.depth(lattice)
    per_width = model.density.at(np.column_stack([lattice, np.full(len(lattice), face.height)]))
    per_width *= float(np.prod(across)) / LATTICE**2
    found: list[float] = []
    for width in widths:
        expected = width * np.bincount(face.patch(lattice), per_width * (deep > width), PATCHES**2)
        counts = np.bincount(patches[(away < width) & (inner > width)], minlength=PATCHES**2).astype(float)
        full = expected > FEWEST
        found.append(_beyond_chance(counts[full], expected[full], together))
    return np.array(found)


def _beyond_chance(counts: Floats, expected: Floats, together: float) -> float:
    """Log likelihood that shares of their own gain over the same share of what is expected in each patch."""
    if len(counts) < 2:
        return 0.0
    same = expected * counts.sum() / expected.sum()
    power = float(((counts - same) ** 2 / (expected * together)).sum())
    freedom = len(counts) - 1
    return max((power - freedom - CHANCE * np.sqrt(2 * freedom)) / 2, 0.0)
