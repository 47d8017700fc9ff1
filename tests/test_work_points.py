import numpy as np
import pytest

from sketchloft.errors import StageError
from sketchloft.work_points import follow_slope, work_points


def test_points_go_to_the_nearest_plane_and_keep_their_place_on_it() -> None:
    points = np.random.default_rng(0).random((1000, 3)) * [1, 1, 4]
    heights = np.array([0.0, 1.0, 4.0])
    worked = work_points(points, heights)
    assert [len(one.points) for one in worked] == [
        (points[:, 2] < 0.5).sum(),
        ((points[:, 2] >= 0.5) & (points[:, 2] < 2.5)).sum(),
        (points[:, 2] >= 2.5).sum(),
    ]
    assert [one.height for one in worked] == [0, 1, 4]
    gathered = np.concatenate([one.points for one in worked])
    assert sorted(map(tuple, gathered)) == sorted(map(tuple, points[:, :2]))


def test_a_slice_left_empty_is_named() -> None:
    points = np.random.default_rng(0).random((1000, 3))
    with pytest.raises(StageError, match="work points, slice 2: found 0 points near height 5") as caught:
        work_points(points, np.array([0.0, 1.0, 5.0]))
    assert caught.value.slice_index == 2
    assert caught.value.exit_code == 5


def test_along_the_slope_a_cone_is_worked_without_becoming_wider() -> None:
    rng = np.random.default_rng(0)
    height = rng.random(20_000)
    radius = (2 - height) * np.sqrt(rng.random(20_000))
    angle = 2 * np.pi * rng.random(20_000)
    points = np.c_[radius * np.cos(angle) + 3 * height, radius * np.sin(angle), height]
    heights = np.linspace(0, 1, 5)
    centres, areas = np.c_[3 * heights, 0 * heights], np.pi * (2 - heights) ** 2
    parallel = work_points(points, heights)
    along = work_points(follow_slope(points, heights, centres, areas), heights)
    for k in (1, 2, 3):
        wall = 2 - heights[k]
        reach = [np.linalg.norm(one[k].points - centres[k], axis=1).max() for one in (parallel, along)]
        assert reach[0] > wall + 0.1  # the widest part of the slice
        assert wall - 0.05 < reach[1] < wall + 0.1


def test_a_step_is_no_slope() -> None:
    points = np.random.default_rng(0).random((1000, 3)) * [1, 1, 2] - [0.5, 0.5, 0]
    heights = np.array([0.0, 0.5, 0.99, 1.01, 1.5, 2.0])
    areas = np.array([1.0, 1.0, 1.0, 9.0, 9.0, 9.0])
    moved = follow_slope(points, heights, np.zeros((6, 2)), areas)
    assert moved == pytest.approx(points)
