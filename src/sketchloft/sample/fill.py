"""Clouds that fill or cover a goal, with the errors that a hand and a tracker make."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from sketchloft.cloud import Floats, PointCloud
from sketchloft.errors import UsageError
from sketchloft.sample.goals import Goal, bounds, inside, on_surface
from sketchloft.sample.strokes import stray_strokes, walks, wander

__all__ = ["FILLS", "Fill", "FillParams", "sample_goal"]

Fill = Literal["uniform", "graded", "strokes", "surface"]
FILLS: tuple[Fill, ...] = get_args(Fill)

GRADING = 6.0
"""How many times denser a graded cloud is at the low end than at the high end."""
STRAY_MARGIN = 0.1
"""How far stray points reach beyond the goal's box on each side, as a share of its extents."""
BATCH = 1 << 18
"""How many points are tried at once, which bounds the memory that rejection needs."""


@dataclass(frozen=True)
class FillParams:
    """How a cloud is drawn.

    Parameters
    ----------
    fill : {"uniform", "graded", "strokes", "surface"}
        Points uniform in the volume; denser at the low end of the longest axis by 6:1, falling
        linearly; strokes that wander inside as a hand scribbles; or points uniform on the surface.
    jitter : float
        Standard deviation per axis of white Gaussian noise, as a share of the goal's diagonal.
    outliers : float
        Share of points thrown anywhere into the goal's box grown by 20 %; with strokes, the share
        of strokes that stray as a whole.
    drift : float
        Standard deviation per axis of the slow error of each stroke, as a share of the goal's
        diagonal; for strokes only.
    """

    fill: Fill = "uniform"
    jitter: float = 0.0
    outliers: float = 0.0
    drift: float = 0.0


def sample_goal(goal: Goal, n: int, params: FillParams | None = None, *, seed: int = 0) -> PointCloud:
    """Draw a cloud of exactly n points that fills or covers a goal.

    Parameters
    ----------
    goal : Goal
    n : int
        How many points, at least 1.
    params : FillParams, optional
        A uniform, exact filling if not given.
    seed : int
        The same seed gives the same cloud.

    Returns
    -------
    PointCloud
        Named after the goal; with strokes, in the order drawn, with the stroke of each point.

    Raises
    ------
    UsageError
        If n or a parameter has a value that it cannot have.
    """
    params = params or FillParams()
    _check(n, params, seed)
    rng = np.random.default_rng(seed)
    low, high = bounds(goal)
    diagonal = float(np.linalg.norm(high - low))
    stroke = None
    if params.fill == "strokes":
        paths = walks(goal, n, rng)
        if params.drift:
            paths += wander(paths.shape[0], paths.shape[1], rng) * (params.drift * diagonal)
        points = stray_strokes(paths, params.outliers, *_grown(low, high), rng).reshape(-1, 3)[:n]
        stroke = np.repeat(np.arange(paths.shape[0]), paths.shape[1])[:n]
    elif params.fill == "surface":
        points = on_surface(goal, n, rng)
    else:
        points = _in_volume(goal, n, params.fill == "graded", rng)
    if params.jitter:
        points = points + rng.normal(scale=params.jitter * diagonal, size=points.shape)
    if params.outliers and params.fill != "strokes":
        stray = rng.choice(n, size=round(params.outliers * n), replace=False)
        points[stray] = rng.uniform(*_grown(low, high), (len(stray), 3))
    return PointCloud(points, stroke=stroke, name=goal.name)


def _in_volume(goal: Goal, n: int, graded: bool, rng: np.random.Generator) -> Floats:
    """(n, 3) points uniform or graded in a goal's volume, by rejection from its box."""
    low, high = bounds(goal)
    longest = int(np.argmax(high - low))
    found, tried, kept = 0, 0, [np.empty((0, 3))]
    while found < n:
        wanted = 1.05 * (n - found) * (tried + 10) / (found + 1) + 64 if tried else 2 * n + 64
        points = rng.uniform(low, high, (min(int(wanted), BATCH), 3))
        tried += len(points)
        if graded:
            up = (points[:, longest] - low[longest]) / (high - low)[longest]
            points = points[rng.random(len(points)) * GRADING < GRADING - (GRADING - 1) * up]
        kept.append(points[inside(goal, points)])
        found += len(kept[-1])
    return np.concatenate(kept)[:n]


def _grown(low: Floats, high: Floats) -> tuple[Floats, Floats]:
    return low - STRAY_MARGIN * (high - low), high + STRAY_MARGIN * (high - low)


def _check(n: int, params: FillParams, seed: int) -> None:
    if n < 1:
        raise UsageError(f"found n = {n}, a cloud has at least 1 point; give a larger n")
    if seed < 0:
        raise UsageError(f"found seed = {seed}, a seed is 0 or larger")
    if params.fill not in FILLS:
        raise UsageError(f"found fill = {params.fill!r}, expected one of {', '.join(FILLS)}")
    for name in ("jitter", "drift"):
        value = getattr(params, name)
        if not 0 <= value < np.inf:
            raise UsageError(
                f"found {name} = {value:g}, expected a share of the goal's diagonal, 0 or larger"
            )
    if not 0 <= params.outliers <= 1:
        raise UsageError(f"found outliers = {params.outliers:g}, expected a share from 0 to 1")
    if params.drift and params.fill != "strokes":
        raise UsageError(
            f"found drift = {params.drift:g} with fill = {params.fill!r}, but only strokes drift; "
            "use fill = 'strokes', or jitter instead"
        )
