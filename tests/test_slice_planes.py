import numpy as np
import pytest

from sketchloft.cloud import clean
from sketchloft.errors import StageError, UsageError
from sketchloft.sample import GOALS, FillParams, sample_goal
from sketchloft.slice_planes import (
    SlicePlanes,
    SlicePlanesParams,
    parse_per_slice,
    slice_planes,
    surface_points,
)


def planes(
    name: str, n: int = 10_000, seed: int = 1, params: SlicePlanesParams | None = None
) -> tuple[np.ndarray, np.ndarray, SlicePlanes]:
    cloud = clean(sample_goal(GOALS[name], n, seed=seed))
    found = slice_planes(cloud.points, params or SlicePlanesParams())
    return found.heights + cloud.centre[2], found.key_heights + cloud.centre[2], found


@pytest.mark.parametrize("seed", range(5))
def test_the_extrema_of_three_spheres(seed: int) -> None:
    heights, keys, _ = planes("three-spheres", seed=seed)
    # Widest at 0 and 5; necks where the spheres meet, at 3.2 and 7.2 (the last is hardly a neck).
    assert keys[0] == pytest.approx(-4, abs=0.15)
    assert keys[-1] == pytest.approx(10.5, abs=0.15)
    for extremum in (0, 3.2, 5):
        assert np.abs(keys - extremum).min() < 0.5
    assert (np.diff(heights) > 0).all()
    assert np.isin(keys, heights).all()


@pytest.mark.parametrize("name", ["l-shape", "cylinder", "box"])
@pytest.mark.parametrize("seed", range(3))
def test_an_extruded_body_is_sliced_evenly(name: str, seed: int) -> None:
    heights, keys, _ = planes(name, seed=seed)
    assert len(keys) == 2
    assert np.diff(heights) == pytest.approx(np.diff(heights).mean())
    assert len(heights) == 21


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("name", "steps"), [("lamp", [1.5, 12]), ("stepped-shaft", [2, 7, 9])])
def test_steps_are_bracketed_by_two_planes(name: str, steps: list[float], seed: int) -> None:
    heights, _, _ = planes(name, seed=seed)
    gaps = np.diff(heights)
    close = (heights[1:] + heights[:-1])[gaps < 0.2 * np.median(gaps)] / 2
    assert close == pytest.approx(steps, abs=0.03)


def test_about_so_many_points_a_slice_as_asked_for() -> None:
    heights, _, _ = planes("cylinder", params=SlicePlanesParams(per_slice=1000))
    assert len(heights) == 11


def test_slices_get_thinner_as_fast_as_contours_get_finer() -> None:
    counts = [len(planes("cylinder", n)[0]) - 1 for n in (1250, 10_000, 80_000)]
    assert counts == [10, 20, 40]


def test_the_central_axis_by_either_rule() -> None:
    for rule in ("mean", "least-squares"):
        _, _, found = planes("cylinder", params=SlicePlanesParams(central_axis=rule))
        assert found.axis_distance.axis == pytest.approx([0, 0], abs=0.05)


def test_surface_points_lie_near_the_surface_and_leave_stray_points_out() -> None:
    cloud = clean(sample_goal(GOALS["sphere"], 10_000, FillParams(outliers=0.01), seed=2))
    radius = np.linalg.norm(surface_points(cloud.points) + cloud.centre, axis=1)
    assert np.quantile(radius, 0.02) > 2.6
    assert np.quantile(radius, 0.98) < 3.1


def test_a_sphere_drawn_on_its_surface_gets_planes_towards_its_tips() -> None:
    cloud = clean(sample_goal(GOALS["sphere"], 3000, FillParams(fill="surface"), seed=1))
    gaps = np.diff(slice_planes(cloud.points, SlicePlanesParams()).heights)
    assert gaps[0] < 0.6 * gaps[len(gaps) // 2]
    assert gaps[-1] < 0.6 * gaps[len(gaps) // 2]


def test_too_few_points_for_two_slices() -> None:
    with pytest.raises(StageError, match="slice planes: found 6000 points per slice"):
        planes("cylinder", params=SlicePlanesParams(per_slice=6000))


@pytest.mark.parametrize("text", ["3", "many", "-500", "1.5"])
def test_a_wrong_number_per_slice_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match="per slice: found"):
        parse_per_slice(text)


def test_right_numbers_per_slice_are_read() -> None:
    assert parse_per_slice("auto") == "auto"
    assert parse_per_slice("300") == 300
