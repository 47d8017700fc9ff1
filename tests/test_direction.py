from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sketchloft.cloud import PointCloud, clean
from sketchloft.direction import DirectionParams, parse_axis, slicing_direction
from sketchloft.errors import UsageError
from sketchloft.frame import frame_along
from sketchloft.sample import GOALS, sample_goal

TURN = Rotation.from_rotvec(np.radians(37) * np.array([1, 2, 3]) / np.sqrt(14)).as_matrix()
TALL = ["three-spheres", "l-shape", "lamp", "cylinder", "cone", "stepped-shaft"]


def found(points: np.ndarray) -> np.ndarray:
    return slicing_direction(clean(PointCloud.of(points)).points, DirectionParams()).vector


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", TALL)
def test_the_axis_of_a_goal_is_found(name: str, seed: int) -> None:
    assert np.abs(found(sample_goal(GOALS[name], 10_000, seed=seed).points)) == pytest.approx([0, 0, 1])


@pytest.mark.parametrize("name", TALL)
def test_other_names_of_the_axes_change_nothing(name: str) -> None:
    points = sample_goal(GOALS[name], 10_000, seed=4).points[:, [2, 0, 1]]
    assert np.abs(found(points)) == pytest.approx([1, 0, 0])


@pytest.mark.parametrize("name", ["l-shape", "lamp", "cylinder"])
def test_a_turned_goal_is_sliced_along_its_own_axis(name: str) -> None:
    vector = found(sample_goal(GOALS[name], 10_000, seed=5).points @ TURN.T)
    assert np.degrees(np.arccos(abs(vector @ TURN[:, 2]))) < 2


def test_a_given_vector_wins_and_is_made_a_unit() -> None:
    direction = slicing_direction(np.eye(3), DirectionParams(axis=(0, 3, 4)))
    assert direction.vector == pytest.approx([0, 0.6, 0.8])
    assert len(direction.candidates) == 0


def test_what_was_compared_is_kept() -> None:
    points = clean(sample_goal(GOALS["l-shape"], 5000, seed=1)).points
    direction = slicing_direction(points, DirectionParams())
    assert direction.candidates.shape == (6, 3)
    assert direction.targets[2] < direction.targets[:2].min()


@pytest.mark.parametrize(
    ("text", "axis"),
    [
        ("auto", "auto"),
        ("X", (1, 0, 0)),
        (" z ", (0, 0, 1)),
        ("0,0.2,1", (0, 0.2, 1)),
        ("1e3,-2,0", (1e3, -2, 0)),
    ],
)
def test_axes_are_read(text: str, axis: Any) -> None:
    assert parse_axis(text) == axis


@pytest.mark.parametrize("text", ["q", "1,2", "1,2,3,4", "0,0,0", "nan,0,1", "inf,0,0", ""])
def test_wrong_axes_are_refused(text: str) -> None:
    with pytest.raises(UsageError, match="axis: found"):
        parse_axis(text)


def test_the_frame_is_right_handed_and_turns_with_the_points() -> None:
    points = np.random.default_rng(0).normal(size=(500, 3)) * [3, 2, 1]
    points -= points.mean(axis=0)
    frame = frame_along(np.array([0.0, 0.0, 1.0]), points)
    turned = frame_along(TURN[:, 2], points @ TURN.T)
    assert np.linalg.det(frame.axes) == pytest.approx(1)
    assert frame.direction == pytest.approx([0, 0, 1])
    assert frame.to_world(frame.to_local(points)) == pytest.approx(points)
    assert turned.to_local(points @ TURN.T) == pytest.approx(frame.to_local(points))
