"""Fit: all parameters of all runs at once, by likelihood on the raw points."""

from __future__ import annotations

from dataclasses import replace
from typing import Unpack

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.fit.fit_density import FEWEST
from sketchloft.exact.fit.likelihood import Derivatives, Evaluation, evaluate, evaluated, rising
from sketchloft.exact.fit.motion import LAST, Bools, Motion, free_parameters
from sketchloft.exact.fit.tilt import tilted
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.exact.model.joins import joined

__all__ = ["climb", "climbed", "promise"]

TINY = 1e-12
LEAST = 1e-5
"""Smallest sigma, where none is given."""
ENOUGH = 0.05
"""Gain of the last step, where none is given."""
LARGEST = 0.5, 1.0
"""Largest steps of the last two."""
DAMPING = 1e-3
"""Damping of the first step."""
FAR_ENOUGH = 0.75
"""Share of a step that the best one has at least, for there to be less damping."""
SHORTEST = 0.01
"""Share of a step that the next one is cut down to at most."""
EASED = 0.1
"""Damping at least after a step that led to no model at all, and below which a small gain is the last."""
TRUST = 10.0
"""How far a wall may move, in noise deviations, for its slopes to tell what that gains."""
STRIDE = 3.0
"""How far a single parameter may move a wall in one step, in noise deviations."""


def climb(
    points: Floats, model: ExactModel, steps: int, *, caps: bool = True, **motion: Unpack[Motion]
) -> tuple[ExactModel, Floats, Floats]:
    """Climb the likelihood from a model by damped Newton steps with the scores' outer products.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
    steps : int
        At most this many.
    caps : bool
        Whether the first and last break are walls; without, they are not moved.
    **motion : Motion

    Returns
    -------
    ExactModel
    (n, 3) float array
        The points, turned where the tilt is free.
    (3, 3) float array
        The rotation: new points = old points @ rotation.
    """
    end, turn = climbed(evaluate(points, joined(model), caps=caps), steps, **motion)
    return end.model, points @ turn if motion.get("tilt") else points, turn


def climbed(now: Evaluation, steps: int, **motion: Unpack[Motion]) -> tuple[Evaluation, Floats]:
    """Climb on from where a model was evaluated, as `climb`; the end, and the rotation of the points.

    Parameters
    ----------
    now : Evaluation
        Of a model whose breaks are joined.
    steps : int
    **motion : Motion
    """
    damping, turn = DAMPING, np.eye(3)
    limits = motion.get("least", LEAST), motion.get("most", np.inf)
    for _ in range(steps if np.isfinite(now.value) else 0):
        free = free_parameters(now.model, motion)
        if not now.caps:
            free[[now.model.size, -LAST - 1]] = False
        moved, slopes = None, now.derivatives(free)
        moving = free & ~_held(now.model, slopes.score, limits)
        for _ in range(6):
            step = _step(slopes, moving, damping, now.model.sigma)
            candidate, rotation = _moved(now.model, step, limits)
            turned = rising(now.points @ rotation) if motion.get("tilt") else now.points
            then = evaluated(turned, candidate, caps=now.caps)
            gain = then.value - now.value
            damping = _damping(damping, float(slopes.score @ step), gain)
            if gain > 0:
                moved = then
                break
        if moved is None:
            break
        now, turn = moved, turn @ rotation
        # Much damping gains little, however much there is to gain.
        if gain < motion.get("enough", ENOUGH) and damping < EASED:
            break
    return now, turn


def promise(now: Evaluation, runs: range, *, noise: bool = False) -> float:
    """Log likelihood that the walls of some runs would gain by moving, as its slopes say (score test).

    Parameters
    ----------
    now : Evaluation
    runs : range
    noise : bool
        As for `climb`.
    """
    if not np.isfinite(now.value):
        return 0.0
    model = now.model
    free = free_parameters(model, {"runs": runs, "noise": noise})
    index = np.flatnonzero(free)
    found = now.derivatives(free)
    information = found.information[np.ix_(index, index)]
    score, reach = found.score[index], found.reach[index].copy()
    reach[index == len(free) - 2] = model.sigma  # what a unit of its logarithm adds to the noise
    step = np.linalg.solve(information + np.diag(_floor(information, reach, model.sigma)), score)
    farthest = float(np.abs(step * reach).max(initial=0.0)) / (TRUST * model.sigma)
    share = 1 / max(farthest, 1.0)
    return float(score @ step) * (share - share**2 / 2)


def _step(now: Derivatives, free: Bools, damping: float, sigma: float) -> Floats:
    step = np.zeros(len(now.score))
    index = np.flatnonzero(free)
    information = now.information[np.ix_(index, index)]
    diagonal, floor = np.diag(information), _floor(information, now.reach[index], sigma)
    information = information + np.diag(damping * diagonal + floor * max(damping, 1e-3))
    raw = np.linalg.solve(information + 1e-12 * np.eye(len(index)), now.score[index])
    limit = STRIDE * sigma / np.maximum(now.reach[index], TINY)
    for place, largest in zip((len(free) - 2, len(free) - 1), LARGEST, strict=True):
        limit[index == place] = largest
    step[index] = np.minimum(np.maximum(raw, -limit), limit)
    if float(now.score @ step) <= 0:
        # What is cut down one by one leads elsewhere than upwards, where some move with others only.
        step[index] = raw * min(1.0, float((limit / np.maximum(np.abs(raw), TINY)).min(initial=1.0)))
    return step


def _held(model: ExactModel, score: Floats, limits: tuple[float, float]) -> Bools:
    """Which parameters their limits keep from going where slopes lead: the noise, and the strays at least."""
    held, (low, high) = np.zeros(len(score), dtype=bool), limits
    held[-2] = model.sigma >= high if score[-2] > 0 else model.sigma <= low
    held[-1] = score[-1] < 0 and model.stray * model.space <= FEWEST
    return held


def _floor(information: Floats, reach: Floats, sigma: float) -> Floats:
    """Information (p,) that parameters have without points, lest one that these say nothing of run away."""
    most = float(np.diag(information).max(initial=0.0))
    floor: Floats = 1e-9 * max(most, 1.0) + (0.1 * reach / sigma) ** 2
    return floor


def _damping(damping: float, slope: float, gain: float) -> float:
    """Damping of the next step, from how far along the last one a parabola would be highest.

    References
    ----------
    J. E. Dennis, R. B. Schnabel, Numerical methods for unconstrained optimization and nonlinear equations,
    SIAM (1996), section 6.3.2: backtracking by a parabola through two values and a slope.
    """
    if not np.isfinite(gain):
        return max(10 * damping, EASED)
    best = slope / (2 * (slope - gain)) if gain < slope else np.inf
    return damping / 10 if best > FAR_ENOUGH else max((1 + damping) / max(best, SHORTEST) - 1, 2 * damping)


def _moved(model: ExactModel, step: Floats, limits: tuple[float, float]) -> tuple[ExactModel, Floats]:
    walls = model.size
    breaks = np.maximum.accumulate(model.stack.breaks + step[walls:-LAST])
    candidate = model.moved(model.vector + step[:walls], breaks)
    x, y, wider, more = step[-LAST:].tolist()
    sigma = float(np.clip(model.sigma * np.exp(wider), *limits))
    stray = max(model.stray * float(np.exp(more)), FEWEST / model.space)
    return joined(replace(candidate, sigma=sigma, stray=stray)), tilted(x, y)
