"""The cloud: what is dropped, what is refused, and that the order does not hang on the file."""

from __future__ import annotations

from typing import Any

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from sketchloft.cloud import MAX_COORDINATE, MIN_POINTS, UNITS, Floats, PointCloud, clean
from sketchloft.errors import CloudError

AWAY = np.array([10.0, -200.0, 300.0])


@pytest.fixture
def ball() -> Floats:
    points = np.random.default_rng(7).normal(size=(500, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True) * np.linspace(1, 5, 500)[:, None]


def cleaned(points: Floats) -> Floats:
    return clean(PointCloud.of(points)).points


def test_of_turns_lists_into_an_array() -> None:
    cloud = PointCloud.of([[1, 2, 3], [4, 5, 6]], unit="m", name="two")
    assert (len(cloud), cloud.unit, cloud.name, cloud.stroke) == (2, "m", "two", None)
    assert cloud.points.dtype == np.float64
    assert UNITS == ("mm", "cm", "m", "in")


@pytest.mark.parametrize(
    "points", [[1, 2, 3], [[1, 2]], [[[1, 2, 3]]], [], [["a", "b", "c"]], [[1, 2, 3], [4, 5]]]
)
def test_of_refuses_other_shapes(points: list[Any]) -> None:
    with pytest.raises(CloudError, match="row x, y, z per point"):
        PointCloud.of(points)


def test_the_centre_and_the_size_are_those_of_the_points(ball: Floats) -> None:
    result = clean(PointCloud.of(ball + AWAY))
    np.testing.assert_allclose(result.centre, ball.mean(axis=0) + AWAY, rtol=1e-13)
    np.testing.assert_allclose(result.points.mean(axis=0), 0, atol=1e-13)
    assert result.size == pytest.approx(float(np.linalg.norm(np.ptp(ball, axis=0))))
    assert len(result) == result.n_read == 500


def test_points_that_are_not_finite_are_dropped_and_counted(ball: Floats) -> None:
    bad = np.array([[np.nan, 0, 0], [0, np.inf, 0], [0, 0, -np.inf], [np.nan] * 3])
    result = clean(PointCloud.of(np.vstack([ball[:250], bad, ball[250:]])))
    assert (result.n_read, result.n_not_finite, result.n_repeated) == (504, 4, 0)
    np.testing.assert_array_equal(result.points, cleaned(ball))


def test_repeated_points_are_dropped_and_counted(ball: Floats) -> None:
    result = clean(PointCloud.of(np.vstack([ball, ball[::2], ball[:10]])))
    assert (result.n_read, result.n_not_finite, result.n_repeated) == (760, 0, 260)
    np.testing.assert_array_equal(result.points, cleaned(ball))


def test_the_two_zeros_are_one_place(ball: Floats) -> None:
    zeros = np.array([[0.0, 1.0, -0.0], [-0.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    assert clean(PointCloud.of(np.vstack([ball, zeros]))).n_repeated == 2


def test_ties_in_z_are_told_apart() -> None:
    grid = np.stack(np.meshgrid(*[np.arange(5.0)] * 3), axis=-1).reshape(-1, 3)
    result = clean(PointCloud.of(np.vstack([grid, grid[::-1]])))
    assert (len(result), result.n_repeated) == (125, 125)
    np.testing.assert_array_equal(np.unique(result.points + result.centre, axis=0), np.unique(grid, axis=0))


@given(st.randoms(use_true_random=False))
@settings(max_examples=20, deadline=None)
def test_a_shuffled_cloud_is_the_same_to_the_last_bit(random: object) -> None:
    grid = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)  # full of ties
    order = list(range(len(grid)))
    random.shuffle(order)  # type: ignore[attr-defined]
    np.testing.assert_array_equal(cleaned(grid[order]), cleaned(grid))


def test_a_moved_turned_or_scaled_cloud_has_the_same_order(ball: Floats) -> None:
    before = cleaned(ball)
    assert (np.diff(np.linalg.norm(before, axis=1)) >= 0).all()
    np.testing.assert_allclose(cleaned(ball + AWAY), before, atol=1e-12)
    np.testing.assert_allclose(cleaned(ball * 25.4), before * 25.4, atol=1e-12)
    turn = Rotation.from_euler("xyz", [0.3, 1.1, -2.0])
    np.testing.assert_allclose(cleaned(turn.apply(ball)), turn.apply(before), atol=1e-12)


def test_the_input_is_left_alone(ball: Floats) -> None:
    given_points = ball.copy()
    cleaned(given_points)
    np.testing.assert_array_equal(given_points, ball)


@pytest.mark.parametrize("n", [0, 1, 3, MIN_POINTS - 1])
def test_too_few_points_say_how_many_are_needed(ball: Floats, n: int) -> None:
    with pytest.raises(CloudError, match=rf"found {n} distinct points.*need at least {MIN_POINTS}"):
        cleaned(ball[:n])


def test_what_was_left_out_is_named_where_too_few_are_left(ball: Floats) -> None:
    points = np.vstack([ball[:10], ball[:5], [[np.nan, 0, 0]]])
    with pytest.raises(CloudError, match=r"\(16 read, 1 not finite, 5 repeated\)"):
        cleaned(points)


def test_equal_points_are_refused() -> None:
    with pytest.raises(CloudError, match="found 1 distinct points"):
        cleaned(np.full((1000, 3), 2.5))
    with pytest.raises(CloudError, match="all in one place"):
        clean(PointCloud.of(np.full((1000, 3), 2.5)), min_points=1)


@pytest.mark.parametrize("offset", [0.0, 1e3, 1e6])
def test_points_on_a_line_are_refused(offset: float) -> None:
    line = np.linspace(0, 1, 200)[:, None] * [1.0, 2.0, -3.0] + offset
    with pytest.raises(CloudError, match="straight line"):
        cleaned(line)


@pytest.mark.parametrize("offset", [0.0, 1e3])
def test_points_on_a_plane_are_refused(ball: Floats, offset: float) -> None:
    flat = ball * [1, 1, 0] @ Rotation.from_euler("xyz", [0.3, 1.1, -2.0]).as_matrix().T + offset
    with pytest.raises(CloudError, match="lie on a plane"):
        cleaned(flat)


def test_a_thin_slab_is_no_plane(ball: Floats) -> None:
    assert len(cleaned(ball * [1, 1, 1e-3])) == 500


def test_a_cloud_far_from_the_origin_is_refused_with_its_centre(ball: Floats) -> None:
    with pytest.raises(
        CloudError, match=r"lies 1e\+09 from the origin.*subtract its centre \(1e\+09, 1e\+09, 1e\+09\)"
    ):
        cleaned(ball + 1e9)


def test_a_large_cloud_may_lie_far_from_the_origin(ball: Floats) -> None:
    np.testing.assert_allclose(cleaned(ball * 1e6 + 1e9), cleaned(ball) * 1e6, atol=1e-6)


@pytest.mark.parametrize("scale", [1e300, 1e101])
def test_coordinates_that_overflow_are_refused(ball: Floats, scale: float) -> None:
    with pytest.raises(CloudError, match="found a coordinate of"):
        cleaned(ball * scale)


@pytest.mark.parametrize("scale", [1e-90, 1e-6, 1.0, 1e6, 1e90])
def test_no_scale_is_assumed(ball: Floats, scale: float) -> None:
    np.testing.assert_allclose(cleaned(ball * scale) / scale, cleaned(ball), atol=1e-12)


@given(hnp.arrays(np.float64, st.tuples(st.integers(0, 80), st.just(3)), elements=st.floats(width=64)))
@settings(max_examples=100, deadline=None)
def test_any_array_is_cleaned_or_refused(points: Floats) -> None:
    try:
        result = clean(PointCloud.of(points), min_points=4)
    except CloudError:
        return
    assert len(result) + result.n_not_finite + result.n_repeated == result.n_read
    assert np.isfinite(result.points).all()
    assert result.size < 4 * MAX_COORDINATE
