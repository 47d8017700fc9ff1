import numpy as np
import pytest

from sketchloft.bodies import BodiesParams, parse_bodies, separate_bodies
from sketchloft.cloud import PointCloud, clean
from sketchloft.errors import StageError, UsageError
from sketchloft.sample import GOALS, Fill, FillParams, sample_goal


def canonical(*parts: np.ndarray) -> np.ndarray:
    return clean(PointCloud.of(np.concatenate(parts))).points


def ball(n: int, centre: list[float], seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(n, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    return centre + direction * rng.random(n)[:, None] ** (1 / 3)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("fill", ["uniform", "graded", "strokes", "surface"])
def test_a_lamp_stays_one_body(seed: int, fill: Fill) -> None:
    cloud = sample_goal(GOALS["lamp"], 20_000, FillParams(fill=fill), seed=seed)
    assert len(separate_bodies(clean(cloud).points, BodiesParams())) == 1


@pytest.mark.parametrize("name", GOALS)
@pytest.mark.parametrize("n", [500, 2000])
def test_no_goal_falls_apart(name: str, n: int) -> None:
    cloud = sample_goal(GOALS[name], n, seed=7)
    assert len(separate_bodies(clean(cloud).points, BodiesParams())) == 1


@pytest.mark.parametrize("seed", range(5))
def test_three_solids_well_apart_become_three(seed: int) -> None:
    points = canonical(
        ball(3000, [0, 0, 0], seed), ball(1000, [4, 0, 0], seed + 9), ball(2000, [0, 5, 1], seed + 5)
    )
    found = separate_bodies(points, BodiesParams())
    assert [len(part) for part in found] == [3000, 2000, 1000]
    assert sorted(np.concatenate(found)) == list(range(6000))


def test_two_long_rods_side_by_side_are_two() -> None:
    rng = np.random.default_rng(0)
    rod = rng.random((4000, 3)) * [1, 1, 30]
    assert [
        len(part) for part in separate_bodies(canonical(rod, rod[:3000] + [3.5, 0, 0]), BodiesParams())
    ] == [
        4000,
        3000,
    ]


def test_stray_points_are_no_bodies() -> None:
    rng = np.random.default_rng(0)
    points = canonical(ball(5000, [0, 0, 0], 1), rng.uniform(-3, 3, (50, 3)))
    assert len(separate_bodies(points, BodiesParams())) == 1


def test_a_number_given_by_hand_wins() -> None:
    points = canonical(ball(3000, [0, 0, 0], 1))
    assert len(separate_bodies(points, BodiesParams(bodies=4))) == 4


def test_a_large_cloud_is_assigned_whole() -> None:
    points = canonical(ball(30_000, [0, 0, 0], 1), ball(20_000, [5, 0, 0], 2))
    assert [len(part) for part in separate_bodies(points, BodiesParams())] == [30_000, 20_000]


def test_bodies_that_get_no_points_are_an_error() -> None:
    points = np.repeat(np.eye(3), 2, axis=0) + 1e-9 * np.arange(6)[:, None]
    with pytest.raises(StageError, match="ask for fewer bodies"):
        separate_bodies(points, BodiesParams(bodies=10))


@pytest.mark.parametrize("text", ["0", "11", "many", "-1", "1.5"])
def test_a_wrong_number_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match=r"expected auto or a number from 1 to 10"):
        parse_bodies(text)


def test_right_numbers_are_read() -> None:
    assert parse_bodies("auto") == "auto"
    assert parse_bodies("3") == 3
