"""The level set of the blurred density, and how many points go together."""

from __future__ import annotations

import numpy as np
import pytest

from sketchloft.cloud import Floats
from sketchloft.dispersion import dispersion, thinned
from sketchloft.exact.section.level_set import level_set, on_grid
from sketchloft.exact.section.section_contours import contours
from sketchloft.exact.start.seen import SEARCH_POINTS
from sketchloft.ring import ring_area
from sketchloft.sample import GOALS, Fill, FillParams, sample_goal

BALL = 4 / 3 * np.pi


def ball(n: int, seed: int = 0) -> Floats:
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(n, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return np.asarray(points * rng.random((n, 1)) ** (1 / 3))


def cloud(name: str, n: int, fill: Fill) -> Floats:
    """About 1 across."""
    points = sample_goal(GOALS[name], n, FillParams(fill=fill), seed=2).points
    return np.asarray(points / np.linalg.norm(np.ptp(points, axis=0)))


@pytest.mark.parametrize("n", [20_000, 100_000])
def test_half_the_density_inside_bounds_the_volume_of_a_ball(n: int) -> None:
    for seed in range(3):
        grid = level_set(ball(n, seed))
        assert grid.inside.sum() * grid.cell**3 == pytest.approx(BALL, rel=0.03)


@pytest.mark.parametrize("n", [2000, 5000, 10_000, 100_000])
def test_the_wall_is_less_than_a_fifth_of_the_spacing_off(n: int) -> None:
    for seed in range(3):
        grid = level_set(ball(n, seed))
        radius = np.cbrt(grid.inside.sum() * grid.cell**3 / BALL)
        assert radius == pytest.approx(1, abs=0.2 * np.cbrt(BALL / n))


def test_a_disc_has_its_area() -> None:
    points = np.random.default_rng(1).uniform(-1, 1, (12_000, 2))
    grid = level_set(points[np.hypot(*points.T) < 1])
    assert grid.inside.sum() * grid.cell**2 == pytest.approx(np.pi, rel=0.03)


@pytest.mark.parametrize("n", [3000, SEARCH_POINTS])
def test_the_grid_reaches_around_tips(n: int) -> None:
    """Pointed ends hold few points, but the section must not be cut off there."""
    for seed in range(3):
        x, y = np.random.default_rng(seed).uniform(-1, 1, (2, 3 * n))
        points = np.column_stack([x, y])[np.abs(x) + np.abs(y) < 1][:n]
        grid = level_set(points)
        rim = np.concatenate([grid.level[0], grid.level[-1], grid.level[:, 0], grid.level[:, -1]])
        assert rim.max() < 0.5
        outer, holes, _ = contours(points)
        assert (len(outer), len(holes)) == (1, 0)
        assert ring_area(outer[0]) == pytest.approx(2, rel=0.03)


def test_a_section_of_a_few_strokes_has_an_outline() -> None:
    """However few its points are, the largest piece is no speck beside a larger one."""
    points = np.random.default_rng(2).uniform(-1, 1, (170, 2)) * [1, 0.75]
    outer, holes, _ = contours(points, 10.8)
    assert (len(outer), len(holes)) == (1, 0)
    assert ring_area(outer[0]) == pytest.approx(3, rel=0.25)


def test_where_points_lie_six_times_denser_the_wall_is_no_further_out() -> None:
    points = ball(100_000)
    shares = (3.5 + 2.5 * points[:, 2]) / 6
    points = points[np.random.default_rng(3).random(len(points)) < shares]
    grid = level_set(points)
    assert grid.inside.sum() * grid.cell**3 == pytest.approx(BALL, rel=0.04)
    at = grid.origin + grid.cell * np.argwhere(grid.inside)
    assert at[:, 2].mean() == pytest.approx(0, abs=0.03)


def test_strays_and_small_islands_are_outside() -> None:
    rng = np.random.default_rng(4)
    island = 0.05 * rng.standard_normal((100, 3)) + [2, 0, 0]
    points = np.concatenate([ball(10_000), rng.uniform(-1.5, 1.5, (100, 3)), island])
    grid = level_set(points)
    assert grid.inside.sum() * grid.cell**3 == pytest.approx(BALL, rel=0.04)
    kept = on_grid(grid, points, 2 * grid.blur)
    far = np.linalg.norm(points, axis=1)
    assert kept[:10_000].all()
    assert not kept[far > 1 + 4 * grid.blur].any()
    assert not kept[-100:].any()


def test_the_level_set_moves_and_grows_with_the_points() -> None:
    points = ball(5000)
    one, other = level_set(points), level_set(1000 * points + [3e4, 0, -1e4])
    assert other.cell == pytest.approx(1000 * one.cell)
    assert other.origin == pytest.approx(1000 * one.origin + [3e4, 0, -1e4])
    assert abs(int(other.inside.sum()) - int(one.inside.sum())) < 1e-3 * one.inside.sum()


@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape", "cylinder"])
def test_independent_points_go_one_by_one(name: str) -> None:
    points = cloud(name, 10_000, "uniform")
    assert dispersion(points) == 1


@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape", "stepped-shaft"])
def test_points_of_strokes_go_together(name: str) -> None:
    points = cloud(name, 10_000, "strokes")
    assert dispersion(points) > 5


@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape", "stepped-shaft"])
def test_one_point_in_three_of_strokes_has_fewer_beside_it(name: str) -> None:
    points = cloud(name, 10_000, "strokes")
    sample = np.random.default_rng(0).permutation(points)[::3]
    assert dispersion(sample) == pytest.approx(thinned(dispersion(points), 3), rel=0.4)


def test_a_density_that_changes_slowly_is_no_dispersion() -> None:
    points = cloud("cylinder", 10_000, "graded")
    assert dispersion(points) == 1
