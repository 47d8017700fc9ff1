"""The direction from a ball to what sticks out of it."""

from __future__ import annotations

import numpy as np
import pytest

from scribbles import unit
from sketchloft.cloud import Floats
from sketchloft.exact.start.beside_ball import beside_ball

AXIS = unit(np.array([[0.3, -0.5, 0.8]]))[0]
RADIUS = 0.3


def in_ball(count: int, radius: float, centre: Floats, seed: int) -> Floats:
    rng = np.random.default_rng(seed)
    ways = unit(rng.normal(size=(count, 3)))
    return centre + radius * rng.uniform(0, 1, (count, 1)) ** (1 / 3) * ways


def on_ball(count: int, radius: float, centre: Floats, seed: int) -> Floats:
    return centre + radius * unit(np.random.default_rng(seed).normal(size=(count, 3)))


@pytest.mark.parametrize("knob", [0.1, 0.15, 0.2])
@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_the_axis_of_a_ball_with_a_knob_goes_through_both(knob: float, noise: float) -> None:
    at = RADIUS * AXIS
    points = np.concatenate([in_ball(3000, RADIUS, 0 * at, 1), in_ball(600, knob, at, 2)])
    wall = np.concatenate([on_ball(2000, RADIUS, 0 * at, 3), on_ball(500, knob, at, 4)])
    outside = np.linalg.norm(wall - at, axis=1) >= knob - 1e-9
    outside &= np.linalg.norm(wall, axis=1) >= RADIUS - 1e-9
    wall = wall[outside]
    wall = wall + noise * np.random.default_rng(5).normal(size=wall.shape)
    found = beside_ball(points - points.mean(axis=0), wall - points.mean(axis=0))
    assert found is not None
    assert found @ AXIS > np.cos(np.radians(4))


def test_a_ball_alone_has_no_direction() -> None:
    centre = np.array([0.01, 0.0, -0.02])
    assert beside_ball(in_ball(3000, RADIUS, centre, 1), on_ball(2000, RADIUS, centre, 2)) is None


def test_it_turns_with_the_points() -> None:
    at = RADIUS * AXIS
    points = np.concatenate([in_ball(3000, RADIUS, 0 * at, 1), in_ball(600, 0.15, at, 2)])
    wall = np.concatenate([on_ball(2000, RADIUS, 0 * at, 3), on_ball(300, 0.15, 1.3 * at, 4)])
    turn = np.linalg.qr(np.random.default_rng(6).normal(size=(3, 3)))[0]
    found, turned = beside_ball(points, wall), beside_ball(points @ turn, wall @ turn)
    assert found is not None
    assert turned is not None
    np.testing.assert_allclose(turned, found @ turn, atol=1e-9)
