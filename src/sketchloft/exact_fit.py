"""Exact fit: the noise lowered step by step until the points say what it is, all parameters free."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact_model import ExactModel
from sketchloft.fit import climb, fit_density
from sketchloft.likelihood import beside_walls, mass_nodes, value_of, wall_nodes

__all__ = ["sharpened"]

FLOOR = 5e-5
"""Smallest noise, as a share of the cloud's size."""
SHELLS = 1.0
"""Noise at least, in expected empty shells V / (n S) of all parameters together: below that a free wall
would follow single points."""
BESIDE = 6.0


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
    turn, floor = np.eye(3), max(FLOOR, SHELLS * _shell(points, model))
    best: tuple[float, ExactModel, Floats] | None = None
    sigma = model.sigma
    rising = True
    while rising:
        model = replace(model, sigma=sigma)
        model = fit_density(points, model, 1)
        near = beside_walls(points, model, BESIDE * sigma)
        model, _, rotation = climb(points[near], model, 6, tilt=tilt)
        points, turn = points @ rotation, turn @ rotation
        value = value_of(points, model)
        rising = best is None or value > best[0]
        if rising:
            best = value, model, turn
            if sigma <= floor:
                break
            sigma = max(sigma / 2, floor)
    if best is None:
        return model, points, turn
    model = best[1]
    points = points @ turn.T @ best[2]
    near = beside_walls(points, model, BESIDE * 1.5 * model.sigma)
    model, _, rotation = climb(points[near], model, 8, tilt=tilt, noise=True, least=floor)
    return model, points @ rotation, best[2] @ rotation


def _shell(points: Floats, model: ExactModel) -> float:
    """Expected empty shell of the model's parameters, V / (n S) each."""
    _, volumes = mass_nodes(model)
    surface = sum(float(areas.sum()) for _, _, _, _, areas, _ in wall_nodes(model))
    return model.size * float(volumes.sum()) / (len(points) * surface)
