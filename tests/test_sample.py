"""Goals and the clouds that fill or cover them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchloft.errors import UsageError
from sketchloft.sample import FILLS, GOALS, Fill, FillParams, Goal, sample_goal
from sketchloft.sample import primitives as parts
from sketchloft.sample.goals import bounds, inside, on_surface
from sketchloft.sample.primitives import Ball, Frustum, Prism
from sketchloft.sample.surface_samples import area, surface_samples

LENS_4_3 = math.pi * (4 + 3 - 5) ** 2 * (25 + 2 * 5 * 7 - 3 * 1) / (12 * 5)  # two balls that overlap
LENS_3_2 = math.pi * (3 + 2 - 3.5) ** 2 * (3.5**2 + 2 * 3.5 * 5 - 3 * 1) / (12 * 3.5)
VOLUMES = {
    "three-spheres": 4 / 3 * math.pi * (64 + 27 + 8) - LENS_4_3 - LENS_3_2,
    "sphere": 36 * math.pi,
    "l-shape": 64 * 4.0,
    "lamp": math.pi * 25 * 1.5 + 3 * 10.5 + math.pi * 6 / 3 * (36 + 18 + 9),
    "cylinder": 32 * math.pi,
    "box": 168.0,
    "cone": math.pi * 7 / 3 * (16 + 4 + 1),
    "stepped-shaft": math.pi * (9 * 2 + 2.25 * 5 + 6.25 * 2 + 3),
}
TOUCHING = Goal(
    "touching",
    (
        Prism(((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)), 0.0, 1.0),
        Prism(((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)), 1.0, 3.0),
        Prism(((0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (0.0, 2.0)), 0.0, 4.0),
    ),
    "a block 2 x 2 x 4 of parts that share faces",
)


def cloud(goal: Goal, n: int, fill: Fill, seed: int = 0) -> np.ndarray:
    return sample_goal(goal, n, FillParams(fill), seed=seed).points


def test_goals_are_known_by_their_own_names() -> None:
    assert list(GOALS) == list(VOLUMES)
    assert all(name == goal.name and goal.description for name, goal in GOALS.items())


@pytest.mark.parametrize("name", GOALS)
def test_volume_is_the_closed_form(name: str) -> None:
    low, high = bounds(GOALS[name])
    points = np.random.default_rng(1).uniform(low, high, (400_000, 3))
    box = float(np.prod(high - low))
    share = VOLUMES[name] / box
    error = 4 * math.sqrt(share * (1 - share) / len(points))
    assert inside(GOALS[name], points).mean() == pytest.approx(share, abs=error + 1e-12)


@pytest.mark.parametrize("name", GOALS)
def test_box_is_tight(name: str) -> None:
    points = cloud(GOALS[name], 20_000, "surface")
    low, high = bounds(GOALS[name])
    assert (points >= low - 1e-12).all()
    assert (points <= high + 1e-12).all()
    assert np.ptp(points, axis=0) == pytest.approx(high - low, rel=0.02)


def test_inside_by_hand() -> None:
    cone = Frustum((1.0, 0.0, 0.0), 4.0, 0.0, 8.0)
    at = np.array([[1, 0, 7.9], [3, 0, 3.9], [3, 0, 4.1], [1, 0, 8.1], [1, 0, -0.1], [4.9, 0, 0.1]])
    assert parts.inside(cone, at).tolist() == [True, True, False, False, False, True]
    bend = GOALS["l-shape"]
    at = np.array([[1, 9, 2], [9, 1, 2], [5, 5, 2], [4.1, 3.9, 2], [1, 1, 4.1], [-0.1, 1, 1]])
    assert inside(bend, at).tolist() == [True, True, False, True, False, False]
    assert parts.inside(Ball((1.0, 2.0, 3.0), 1.0), np.array([[1, 2, 3.99], [1, 2, 4.01]])).tolist() == [
        True,
        False,
    ]


@pytest.mark.parametrize(
    "part",
    [
        Ball((1.0, 2.0, 3.0), 2.0),
        Frustum((1.0, 2.0, 3.0), 3.0, 1.0, 2.0),
        Frustum((1.0, 2.0, 3.0), 0.0, 2.0, 5.0),
        Frustum((1.0, 2.0, 3.0), 2.0, 2.0, 5.0),
        Prism(((0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)), -1.0, 2.0),
    ],
)
def test_surface_points_lie_on_the_surface_with_normals_outwards(part: parts.Part) -> None:
    points, normals = surface_samples(part, 5000, np.random.default_rng(2))
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1)
    assert parts.inside(part, points - 1e-9 * normals).mean() > 0.999  # rounding at the very edges
    assert not parts.inside(part, points + 1e-9 * normals).any()


def test_area_and_density_on_a_cone() -> None:
    cone = Frustum((0.0, 0.0, 0.0), 3.0, 0.0, 4.0)
    assert area(cone) == pytest.approx(math.pi * (9 + 15))
    points, normals = surface_samples(cone, 40_000, np.random.default_rng(3))
    on_side = normals[:, 2] > 0
    assert on_side.mean() == pytest.approx(15 / 24, abs=0.01)
    # The side below half height holds 3/4 of the side's area, the inner half disc 1/4 of the base's.
    assert (points[on_side, 2] < 2).mean() == pytest.approx(0.75, abs=0.01)
    assert (np.hypot(*points[~on_side, :2].T) < 1.5).mean() == pytest.approx(0.25, abs=0.012)


@pytest.mark.parametrize("goal", [*GOALS.values(), TOUCHING], ids=lambda goal: goal.name)
def test_union_surface_has_no_hidden_points(goal: Goal) -> None:
    points = on_surface(goal, 4000, np.random.default_rng(4))
    around = np.random.default_rng(5).normal(size=(60, 3))
    around *= 1e-4 / np.linalg.norm(around, axis=1, keepdims=True)
    seen = np.array([inside(goal, points + step) for step in around])
    assert not seen.all(axis=0).any()
    assert seen.any(axis=0).all()


@pytest.mark.parametrize(
    ("name", "low", "high", "piece", "whole"),
    [
        # The necks of the spheres lie at z = 3.2 and 7.4643; a zone of height h has area 2 pi r h.
        ("three-spheres", -4.0, 3.2, 2 * 4 * 7.2, 2 * (4 * 7.2 + 3 * 4.2642857 + 2 * 3.0357143)),
        ("l-shape", 3.999, 4.001, 64 / math.pi, (2 * 64 + 4 * 40) / math.pi),
        (
            "lamp",
            1.501,
            11.999,
            7 * 10.498 / math.pi,
            2 * 25 + 15 + 45 + 9 * math.hypot(6, 3) + 67.5 / math.pi,
        ),
        ("stepped-shaft", 6.999, 7.001, 6.25 - 2.25, 2 * 9 + 2 * (6.25 - 2.25) + 12 + 15 + 10 + 6),
    ],
)
def test_union_surface_is_uniform_by_area(
    name: str, low: float, high: float, piece: float, whole: float
) -> None:
    z = on_surface(GOALS[name], 40_000, np.random.default_rng(6))[:, 2]
    assert ((z > low) & (z < high)).mean() == pytest.approx(piece / whole, abs=0.008)


def test_shared_faces_count_once() -> None:
    points = on_surface(TOUCHING, 40_000, np.random.default_rng(7))
    faces = [np.abs(points[:, i] - level) < 1e-9 for i in range(3) for level in (0.0, (2.0, 2.0, 4.0)[i])]
    shares = [face.mean() for face in faces]
    assert shares == pytest.approx([8 / 40] * 4 + [4 / 40] * 2, abs=0.01)
    side = points[np.abs(points[:, 1]) < 1e-9]
    assert (side[:, 0] < 1).mean() == pytest.approx(0.5, abs=0.02)
    assert (side[:, 2] < 1).mean() == pytest.approx(0.25, abs=0.02)


@pytest.mark.parametrize("fill", FILLS)
@pytest.mark.parametrize("n", [1, 59, 61, 1000])
def test_exactly_n_points(fill: Fill, n: int) -> None:
    made = sample_goal(GOALS["lamp"], n, FillParams(fill, jitter=0.01, outliers=0.1))
    assert made.points.shape == (n, 3)
    assert made.name == "lamp"
    assert (made.stroke is not None) == (fill == "strokes")
    assert made.stroke is None or len(made.stroke) == n


@pytest.mark.parametrize("fill", FILLS)
def test_same_seed_same_cloud(fill: Fill) -> None:
    first, again, other = (cloud(GOALS["three-spheres"], 500, fill, seed) for seed in (7, 7, 8))
    assert np.array_equal(first, again)
    assert not np.isin(first, other).any()


@pytest.mark.parametrize("name", GOALS)
@pytest.mark.parametrize("fill", ["uniform", "graded", "strokes"])
def test_fills_stay_inside(name: str, fill: Fill) -> None:
    assert inside(GOALS[name], cloud(GOALS[name], 3000, fill)).all()


def test_uniform_fill_is_uniform() -> None:
    z = cloud(GOALS["cylinder"], 40_000, "uniform")[:, 2]
    counts, _ = np.histogram(z, 8, (0, 8))
    assert ((counts - 5000) ** 2 / 5000).sum() < 25  # chi squared, 7 degrees of freedom, p = 0.0008


def test_graded_fill_thins_out_six_to_one() -> None:
    z = cloud(GOALS["cylinder"], 200_000, "graded")[:, 2]
    counts, edges = np.histogram(z, 16, (0, 8))
    slope, start = np.polyfit((edges[1:] + edges[:-1]) / 2, counts, 1)
    assert start / (start + 8 * slope) == pytest.approx(6, rel=0.06)


def test_strokes_are_connected_walks() -> None:
    goal = GOALS["three-spheres"]
    made = sample_goal(goal, 6000, FillParams("strokes"))
    low, high = bounds(goal)
    assert made.stroke is not None
    assert np.array_equal(np.unique(made.stroke, return_counts=True)[1], np.full(100, 60))
    steps = np.linalg.norm(np.diff(made.points, axis=0), axis=1)[np.diff(made.stroke) == 0]
    step = 0.01 * np.linalg.norm(high - low)
    moved = steps > 0
    assert moved.mean() > 0.98
    assert steps[moved] == pytest.approx(step)


def test_drift_is_slow_and_of_the_given_size() -> None:
    goal = GOALS["box"]
    plain = cloud(goal, 30_000, "strokes", seed=3)
    low, high = bounds(goal)
    drifted = sample_goal(goal, 30_000, FillParams("strokes", drift=0.02), seed=3)
    off = (drifted.points - plain) / np.linalg.norm(high - low)
    assert off.std() == pytest.approx(0.02, rel=0.1)
    assert drifted.stroke is not None
    along = np.diff(off, axis=0)[np.diff(drifted.stroke) == 0]
    assert along.std() < 0.1 * off.std()


def test_jitter_is_white_and_of_the_given_size() -> None:
    goal = GOALS["cone"]
    low, high = bounds(goal)
    noisy = sample_goal(goal, 20_000, FillParams(jitter=0.005), seed=3).points
    off = (noisy - cloud(goal, 20_000, "uniform", seed=3)) / np.linalg.norm(high - low)
    assert off.std(axis=0) == pytest.approx(0.005, rel=0.05)
    assert abs(off.mean()) < 1e-4


def test_outliers_are_thrown_into_the_grown_box() -> None:
    goal = GOALS["sphere"]
    made = sample_goal(goal, 20_000, FillParams("surface", outliers=0.1), seed=3).points
    stray = np.abs(np.linalg.norm(made, axis=1) - 3) > 1e-9
    assert stray.sum() == 2000
    assert np.abs(made[stray]).max() == pytest.approx(3.6, rel=0.01)


def test_whole_strokes_stray() -> None:
    made = sample_goal(GOALS["sphere"], 6000, FillParams("strokes", outliers=0.05), seed=3)
    second = np.diff(made.points.reshape(100, 60, 3), n=2, axis=1)
    assert (np.abs(second).max(axis=(1, 2)) < 1e-9).sum() == 5


@settings(max_examples=25, deadline=None)
@given(scale=st.floats(1e-3, 1e3), x=st.floats(-1e3, 1e3))
def test_goals_move_and_scale(scale: float, x: float) -> None:
    """A goal of any size anywhere is filled alike: the same seed gives the moved and scaled cloud."""
    plain = Goal("unit", (Ball((0.0, 0.0, 0.0), 1.0), Frustum((0.0, 0.0, 0.5), 0.4, 0.2, 1.0)), "")
    moved = Goal(
        "moved",
        (Ball((x, 0.0, 0.0), scale), Frustum((x, 0.0, 0.5 * scale), 0.4 * scale, 0.2 * scale, scale)),
        "",
    )
    expected = cloud(plain, 200, "uniform") * scale + (x, 0, 0)
    assert cloud(moved, 200, "uniform") == pytest.approx(expected, abs=1e-9 * (scale + abs(x)))


@pytest.mark.parametrize(
    ("n", "params", "word"),
    [
        (0, FillParams(), "at least 1"),
        (10, FillParams(jitter=-1), "jitter"),
        (10, FillParams(jitter=math.nan), "jitter"),
        (10, FillParams(outliers=1.5), "outliers"),
        (10, FillParams(drift=0.1), "only strokes drift"),
        (10, FillParams("solid"), "uniform, graded, strokes, surface"),  # type: ignore[arg-type]
    ],
)
def test_bad_parameters_are_refused(n: int, params: FillParams, word: str) -> None:
    with pytest.raises(UsageError, match=word):
        sample_goal(GOALS["sphere"], n, params)
