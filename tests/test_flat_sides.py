"""Ruled walls: their feet, and sides that are planes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchloft.cloud import Floats
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.search.flat_sides import flat_sides
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.outline.polygons import Polygon
from sketchloft.stack import Run, Stack
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.ruled import Ruled

N = 20_000
SIGMA = 0.004
BESIDE = 0.015
LOW, HIGH = 0.0, 0.8


def hopper(turn: float) -> Ruled:
    """From one rectangle to another of other proportions, turned by an angle."""
    below, above = Rectangle(np.zeros(2), 0.8, 0.4, turn), Rectangle(np.array([0.05, 0.0]), 0.4, 0.35, 0.0)
    return Ruled(Polygon(below.chain()[0]), Polygon(above.chain()[0]), LOW, HIGH)


def drawn(wall: Ruled, seed: int = 0) -> Floats:
    rng = np.random.default_rng(seed)
    points = rng.uniform([-0.5, -0.4, LOW], [0.5, 0.4, HIGH], (5 * N, 3))
    inside = points[wall.foot(points).distance < 0][:N]
    return inside + rng.normal(0, SIGMA, inside.shape)


def model_with(wall: Ruled) -> ExactModel:
    stack = Stack(np.array([LOW, HIGH]), (Run((wall,)),))
    return model_of(stack, SIGMA, Density(np.log([N / stack_volume(stack)])), 1.0, 1.0)


def turned_sides(model: ExactModel) -> Floats:
    """Sine (4,) of the angle between the edges of each side at both ends."""
    wall = model.stack.runs[0].walls[0]
    assert isinstance(wall, Ruled)
    below, above = (np.roll(end.chain()[0], -1, axis=0) - end.chain()[0] for end in (wall.bottom, wall.top))
    lengths = np.linalg.norm(below, axis=1) * np.linalg.norm(above, axis=1)
    sines: Floats = (below[:, 0] * above[:, 1] - below[:, 1] * above[:, 0]) / lengths
    return sines


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_foot_on_a_ruled_wall_is_that_in_the_section(seed: int) -> None:
    """Also next to acute corners, where the nearest sample is on the other edge."""
    rng = np.random.default_rng(seed)
    square = Rectangle(np.zeros(2), 1.0, 1.0, 0.0).chain()[0]
    first, last = (square * sizes + rng.normal(0, 0.02, (4, 2)) for sizes in rng.uniform(0.2, 1.0, (2, 2)))
    wall = Ruled(Polygon(first), Polygon(last), LOW, HIGH)
    for share in rng.uniform(0.0, 1.0, 5):
        flat = rng.uniform(-0.6, 0.6, (100, 2))
        foot = wall.foot(np.column_stack([flat, np.full(100, LOW + share * (HIGH - LOW))]))
        expected = Polygon((1 - share) * first + share * last).foot(flat).distance
        near = np.abs(expected) < BESIDE
        across = foot.distance / np.sqrt(1 - foot.normal[:, 2] ** 2)  # the foot is at the point's height
        np.testing.assert_allclose(across[near], expected[near], atol=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_sides_that_the_points_do_not_warp_are_planes(seed: int) -> None:
    points = drawn(hopper(0.0), seed)
    model = flat_sides(points, model_with(hopper(0.005)), 1.0)
    np.testing.assert_allclose(turned_sides(model), 0, atol=1e-12)


def test_sides_that_are_warped_stay_so() -> None:
    model = model_with(hopper(0.08))
    assert flat_sides(drawn(hopper(0.08)), model, 1.0) is model
