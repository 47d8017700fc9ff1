"""The gap that a fit leaves inside the walls is what is expected, and is closed; noise leaves none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from sketchloft.cloud import Floats
from sketchloft.exact.fit.inward_gap import without_gap
from sketchloft.exact.fit.sharpen import least_noise, sharpened
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.outline.polygons import Polygon
from sketchloft.stack import Run, Stack
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.profile import LineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

COUNT, SEEDS = 3000, 12
ORIGIN = np.zeros(2)
ELL = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]) / 5 - 0.3
WALLS = {
    "cylinder": Run((Revolved(ORIGIN, LineProfile(0.0, 0.3, None)),)),
    "tube": Run(
        (Revolved(ORIGIN, LineProfile(0.0, 0.4, None)), Revolved(ORIGIN, LineProfile(0.0, 0.2, None))), 1
    ),
    "box": Run((Swept(Rectangle(ORIGIN, 0.6, 0.4, 0.3), 0.0, ORIGIN, ORIGIN),)),
    "L": Run((Swept(Polygon(ELL), 0.0, ORIGIN, ORIGIN),)),
}


def fitted(run: Run, seed: int, noise: float = 0.0) -> tuple[ExactModel, ExactModel]:
    """The model that points were drawn from, and the one that they give back, before its gap is closed."""
    rng = np.random.default_rng(seed)
    box = rng.uniform(-0.5, 0.5, (30 * COUNT, 3))
    depths = [wall.foot(box).distance * run.sign(i) for i, wall in enumerate(run.walls)]
    points: Floats = box[np.max(depths, axis=0) < 0][:COUNT]
    points = points + noise * rng.standard_normal(points.shape)
    stack = Stack(np.array([-0.5, 0.5]), (run,))
    truth = model_of(stack, 0.004, Density(np.log([COUNT / stack_volume(stack)])), 1e-3, 2.0)
    found, _, _ = sharpened(points, truth, tilt=False)
    return truth, found


def lost(truth: ExactModel, found: ExactModel) -> float:
    """Share of the volume that the found model lacks."""
    return 1 - stack_volume(found.stack) / stack_volume(truth.stack)


@pytest.mark.parametrize("name", WALLS)
def test_each_parameter_costs_about_a_point_and_gets_it_back(name: str) -> None:
    before, after = [], []
    for seed in range(SEEDS):
        truth, found = fitted(WALLS[name], seed)
        before.append(lost(truth, found))
        after.append(lost(truth, without_gap(found, least_noise(found, COUNT))))
    expected = truth.parameters / COUNT
    assert 0.5 * expected < np.mean(before) < 1.5 * expected
    assert abs(np.mean(after)) < 0.35 * expected


def test_walls_of_noisy_points_stay_where_they_are() -> None:
    _, found = fitted(WALLS["box"], 1, noise=0.004)
    assert without_gap(found, least_noise(found, COUNT)) is found


def test_the_gap_closes_as_the_noise_gets_small() -> None:
    _, found = fitted(WALLS["box"], 1)
    least = least_noise(found, COUNT)
    volumes = [
        stack_volume(without_gap(replace(found, sigma=share * least), least).stack)
        for share in (2.5, 1.6, 1.0)
    ]
    assert volumes[0] == stack_volume(found.stack) < volumes[1] < volumes[2]
