"""Exact fit: the noise lowered step by step until the points say what it is, all parameters free."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact.expected import mass_nodes, wall_nodes
from sketchloft.exact.fit import climb, fit_density
from sketchloft.exact.likelihood import beside_walls, value_of
from sketchloft.exact.model import ExactModel

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
    floor = max(FLOOR, SHELLS * _shell(points, model))
    best, highest = (model, points, np.eye(3)), -np.inf
    turn, sigma = np.eye(3), model.sigma
    while True:
        model = fit_density(points, replace(model, sigma=sigma), 1)
        near = points[beside_walls(points, model, BESIDE * sigma)]
        model, _, rotation = climb(near, model, 6, tilt=tilt)
        points, turn = points @ rotation, turn @ rotation
        value = value_of(points, model)
        if value <= highest:
            break
        best, highest = (model, points, turn), value
        if sigma <= floor:
            break
        sigma = max(sigma / 2, floor)
    model, points, turn = best
    near = points[beside_walls(points, model, BESIDE * 1.5 * model.sigma)]
    model, _, rotation = climb(near, model, 8, tilt=tilt, noise=True, least=floor)
    return model, points @ rotation, turn @ rotation


def _shell(points: Floats, model: ExactModel) -> float:
    """Expected empty shell of the model's parameters, V / (n S) each."""
    nodes = wall_nodes(model)
    _, volumes = mass_nodes(model, nodes)
    surface = sum(float(node.spread.areas.sum()) for node in nodes)
    return model.size * float(volumes.sum()) / (len(points) * surface)
