"""Exact fit: the noise lowered step by step until the points say what it is, all parameters free."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.exact.expected import empty_shell
from sketchloft.exact.fit import climb, fit_density
from sketchloft.exact.likelihood import beside_walls, value_of
from sketchloft.exact.model import ExactModel, thicker

__all__ = ["least_noise", "sharpened"]

Bools = NDArray[np.bool_]

FLOOR = 5e-5
"""Smallest noise, as a share of the cloud's size."""
SHELLS = 1.0
"""Noise at least, in expected empty shells V / (n S) of all parameters together: below that a free wall
would follow single points."""
BESIDE = 6.0
MOST_BESIDE = 25_000
"""Points beside the walls that are looked at: the sharper the noise, the nearer they are, so that in the
end all that tell where a wall is are among them."""
ENOUGH = 0.02
"""Gain of a step, in log likelihood, that is not worth another."""
STEPS = (3, 6)
"""Steps of a fit at one noise, after each of which the strays are looked at anew."""
MOST_POINTS = 12_000
"""Points that the density is fitted to."""


def least_noise(model: ExactModel, count: int) -> float:
    """Noise that is fitted to so many points at least."""
    return max(FLOOR, SHELLS * model.size * empty_shell(model, count))


def sharpened(points: Floats, model: ExactModel, *, tilt: bool) -> tuple[ExactModel, Floats, Floats]:
    """Lower the noise as long as the likelihood rises, then free it.

    Returns
    -------
    ExactModel
    (n, 3) float array
        The points, turned where the tilt is free.
    (3, 3) float array
        The rotation: new points = old points @ rotation.
    """
    floor = least_noise(model, len(points))
    turn, sigma = np.eye(3), model.sigma
    sample, every = _thinned(points, MOST_POINTS)
    band, judged = points, _Judged(points, 1, points[:0], 0.0)
    while True:
        before = model
        model, turned = replace(model, sigma=sigma), turn
        beside = beside_walls(band @ turn, model, BESIDE * sigma)
        band, near = band[beside], _judged(points, band, beside)
        for steps in STEPS:
            # Which points are strays depends on the noise, and where the walls are on both.
            model = thicker(fit_density(sample @ turned, thicker(model, 1 / every), 2), every)
            model, _, rotation = climb(
                near.points @ turned,
                thicker(model, 1 / near.every),
                steps,
                tilt=tilt,
                strays=True,
                enough=ENOUGH,
            )
            model, turned = thicker(model, near.every), turned @ rotation
        if sigma < before.sigma and _value(judged, model, turned) <= _value(judged, before, turn):
            model = before
            break
        turn, judged = turned, near
        if sigma <= floor:
            break
        sigma = max(sigma / 2, floor)
    last, of = _thinned(points[beside_walls(points @ turn, model, BESIDE * 1.5 * model.sigma)], MOST_BESIDE)
    for steps in STEPS:
        model = thicker(fit_density(sample @ turn, thicker(model, 1 / every), 2), every)
        model, _, rotation = climb(
            last @ turn,
            thicker(model, 1 / of),
            steps,
            tilt=tilt,
            noise=True,
            strays=True,
            least=floor,
            enough=ENOUGH,
        )
        model, turn = thicker(model, of), turn @ rotation
    return model, points @ turn, turn


def _thinned(points: Floats, most: int) -> tuple[Floats, int]:
    """Every so many points, and how many."""
    every = len(points) // most + 1
    return points[::every], every


@dataclass(frozen=True)
class _Judged:
    """Every so many of the points beside the walls, and some inside that each stand for a number."""

    points: Floats
    every: int
    inside: Floats
    each: float


def _judged(points: Floats, band: Floats, beside: Bools) -> _Judged:
    near, every = _thinned(band[beside], MOST_BESIDE)
    inside, _ = _thinned(band[~beside], MOST_POINTS)
    missing = len(points) - int(beside.sum())
    return _Judged(near, every, inside, missing / every / max(len(inside), 1))


def _value(judged: _Judged, model: ExactModel, turn: Floats) -> float:
    """Log likelihood of points, turned."""
    thin = thicker(model, 1 / judged.every)
    inside = np.log(thin.density.at(judged.inside @ turn) + thin.stray)
    return value_of(judged.points @ turn, thin) + judged.each * float(inside.sum())
