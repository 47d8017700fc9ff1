"""Exact fit: the noise lowered step by step until the points say what it is, all parameters free."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.expected import empty_shell
from sketchloft.exact.fit.fit_density import fit_density
from sketchloft.exact.fit.likelihood import beside_walls, value_of
from sketchloft.exact.model.exact_model import ExactModel, thicker

__all__ = ["Judged", "judged", "least_noise", "sharpened"]

Bools = NDArray[np.bool_]
Thinned = tuple[Floats, int]

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
    sample = _thinned(points, MOST_POINTS)
    band, last = points, Judged(points, 1, points[:0], 0.0)
    while True:
        before = model
        model = replace(model, sigma=sigma)
        beside = beside_walls(band @ turn, model, BESIDE * sigma)
        band, near = band[beside], judged(points, band, beside)
        model, turned = _fitted((near.points, near.every), sample, model, turn, tilt=tilt)
        if sigma < before.sigma and last.value(model, turned) <= last.value(before, turn):
            model = before
            break
        turn, last = turned, near
        if sigma <= floor:
            break
        sigma = max(sigma / 2, floor)
    telling = points[beside_walls(points @ turn, model, BESIDE * 1.5 * model.sigma)]
    model, turn = _fitted(_thinned(telling, MOST_BESIDE), sample, model, turn, tilt=tilt, least=floor)
    return model, points @ turn, turn


def _fitted(
    near: Thinned, sample: Thinned, model: ExactModel, turn: Floats, *, tilt: bool, least: float | None = None
) -> tuple[ExactModel, Floats]:
    """Fit to the points near the walls, at one noise or at one that is free and no less; the rotation."""
    (beside, each), (points, every) = near, sample
    for steps in STEPS:
        # Which points are strays depends on the noise, and where the walls are on both.
        model = thicker(fit_density(points @ turn, thicker(model, 1 / every), 2), every)
        model, _, rotation = climb(
            beside @ turn,
            thicker(model, 1 / each),
            steps,
            tilt=tilt,
            noise=least is not None,
            strays=True,
            least=least or 0.0,
            enough=ENOUGH,
        )
        model, turn = thicker(model, each), turn @ rotation
    return model, turn


def _thinned(points: Floats, most: int) -> Thinned:
    """Every so many points, and how many."""
    every = len(points) // most + 1
    return points[::every], every


@dataclass(frozen=True)
class Judged:
    """What models of about the same walls are judged by: points beside these, and some that are inside.

    Parameters
    ----------
    points : (n, 3) float array
        Every so many of those beside the walls.
    every : int
    inside : (m, 3) float array
    each : float
        How many of them each of those inside stands for.
    """

    points: Floats
    every: int
    inside: Floats
    each: float

    def value(self, model: ExactModel, turn: Floats) -> float:
        """Log likelihood of the points, turned."""
        thin = thicker(model, 1 / self.every)
        inside = np.log(thin.density.at(self.inside @ turn) + thin.stray)
        return value_of(self.points @ turn, thin) + self.each * float(inside.sum())


def judged(points: Floats, band: Floats, beside: Bools) -> Judged:
    """What models are judged by, of a band (n, 3) of all points where it lies beside the walls."""
    near, every = _thinned(band[beside], MOST_BESIDE)
    inside, _ = _thinned(band[~beside], MOST_POINTS)
    missing = len(points) - int(beside.sum())
    return Judged(near, every, inside, missing / every / max(len(inside), 1))
