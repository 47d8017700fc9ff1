"""When a change of a model pays, and what is not tried at all."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from sketchloft.cloud import Floats
from sketchloft.exact.changes import free_profiles
from sketchloft.exact.changes.change import Change, Key
from sketchloft.exact.changes.free_profiles import splined
from sketchloft.exact.changes.free_trial import BEYOND
from sketchloft.exact.changes.merges import merges
from sketchloft.exact.changes.profile_start import respanned
from sketchloft.exact.changes.run_changes import swaps
from sketchloft.exact.changes.trial import tried
from sketchloft.exact.changes.worth import LEANING, PER_RUN, worth, worth_of
from sketchloft.exact.fit.climb import climb, promise
from sketchloft.exact.fit.likelihood import evaluate
from sketchloft.exact.fit.schwarz import price
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.joins import natural_joins
from sketchloft.exact.model.surgery import with_wall
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import start_along
from sketchloft.outline.circle import Circle
from sketchloft.sample import GOALS, FillParams, sample_goal
from sketchloft.stack import Run, Stack, Wall
from sketchloft.surface import even_knots
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at
from sketchloft.wall.swept import Swept

COUNT = 6000
SIGMA = 0.005
ORIGIN = np.zeros(2)


def frustum(slope: float, seed: int = 5) -> Floats:
    """Points drawn evenly in a cone of radius 0.3 in the middle of its height 0.6, with noise."""
    rng = np.random.default_rng(seed)
    box = rng.uniform(-0.5, 0.5, (8 * COUNT, 3)) * [1, 1, 0.6]
    inner = box[np.hypot(box[:, 0], box[:, 1]) < 0.3 + slope * box[:, 2]][:COUNT]
    return inner + SIGMA * rng.standard_normal(inner.shape)


def model_with(wall: Wall, ends: tuple[float, float] = (-0.3, 0.3)) -> ExactModel:
    density = Density(np.log([COUNT / float(wall.area(np.linspace(*ends, 99)).mean() * (ends[1] - ends[0]))]))
    return model_of(Stack(np.array(ends), (Run((wall,)),)), SIGMA, density, 1.0, 1.0)


def cylinder(radius: float = 0.3) -> Revolved:
    return Revolved(ORIGIN, LineProfile(0.0, radius, None))


def cone(slope: float = 0.0) -> Revolved:
    return Revolved(ORIGIN, LineProfile(0.0, 0.3, slope))


def sphere() -> Revolved:
    return Revolved(ORIGIN, ArcProfile(0.0, None, 0.42))


def torus() -> Revolved:
    return Revolved(ORIGIN, ArcProfile(0.0, -0.5, 0.9))


@pytest.mark.parametrize("off", [-0.004, -0.001, 0.002, 0.004])
def test_slopes_promise_about_what_a_small_movement_gains(off: float) -> None:
    points, model = frustum(0.0), model_with(cylinder(0.3 + off))
    best, _, _ = climb(points, model, 20)
    gain = worth(points, best, 1, COUNT) - worth(points, model, 1, COUNT)
    assert gain / BEYOND < promise(evaluate(points, model), range(1)) < 3 * gain
    assert promise(evaluate(points, best), range(1)) == pytest.approx(0, abs=0.05)


@pytest.mark.parametrize(("slope", "pays"), [(0.0, False), (0.03, True)])
def test_a_taper_is_taken_up_where_there_is_one(slope: float, pays: bool) -> None:
    points = frustum(slope)
    model, _, _ = climb(points, model_with(cylinder()), 20)
    change = Change(with_wall(model, 0, 0, cone()), range(1))
    assert (tried(points, model, change, 1) is not None) == pays


def test_a_chain_that_needs_no_free_profile_is_not_looked_at_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    points, failed = frustum(0.0), set[Key]()
    model, _, _ = climb(points, model_with(cylinder()), 20)
    assert splined(points, model, 1, failed=failed) is model
    assert len(failed) == 1
    monkeypatch.setattr(free_profiles, "misfit", pytest.fail)
    assert splined(points, model, 1, failed=failed) is model


def test_what_a_model_would_gain_anyhow_is_not_to_the_credit_of_a_change() -> None:
    """Else a model that is not fitted yet is left for any other that is nearer by chance, and back again."""
    points = frustum(0.0)
    unfitted = with_wall(model_with(cylinder()), 0, 0, cylinder(0.298))
    nearer = with_wall(unfitted, 0, 0, cone())
    assert worth(points, nearer, 1, COUNT) > worth(points, unfitted, 1, COUNT)
    assert tried(points, unfitted, Change(nearer, range(1)), 1) is None


def test_a_sphere_has_no_direction_to_pay_for() -> None:
    """So it is told from a spheroid, whose two more parameters the price forgot, among clouds of a sphere."""
    points = frustum(0.0)
    ball = Revolved(ORIGIN, ArcProfile(0.0, None, 0.3))
    flat = model_with(ball, (-0.2, 0.2))
    whole = natural_joins(model_with(ball, (-0.2999999, 0.2999999)))
    assert whole.joins == ("pole", "pole")

    def price(model: ExactModel) -> float:
        return worth(points[:1], replace(model, sigma=1e-3), 1, COUNT) - worth(
            points[:1], replace(model, sigma=1e-3), 1, 3
        )

    per_parameter = 0.5 * np.log(COUNT / 3)
    assert price(flat) == pytest.approx(-per_parameter * (flat.parameters + 2 + 2))
    assert price(whole) == pytest.approx(-per_parameter * (whole.parameters + 2))


@pytest.mark.parametrize("vector", [[1.0, 2.0, 3.0], [-3.0, 1.0, 0.5]])
def test_strays_come_from_the_same_place_along_any_direction(vector: list[float]) -> None:
    """Else ends of searches along different directions are not to be compared."""
    points = sample_goal(GOALS["cylinder"], 3000, FillParams(outliers=0.01), seed=4).points
    unit = (points - points.mean(axis=0)) / np.ptp(points, axis=0).max()
    along = [start_along(unit, np.array(v), (), SegmentsParams()) for v in ([0, 0, 1.0], vector)]
    assert along[0].first.space == pytest.approx(along[1].first.space, rel=1e-4)


@pytest.mark.parametrize("middle", [0.2, 0.35])
def test_a_run_between_two_alike_ones_is_tried_as_part_of_them(middle: float) -> None:
    """Each alone left to it pays little: where a stroke has put it in the way, both are one."""
    lower, upper = cylinder(0.301), cylinder(0.299)
    breaks = np.array([-0.3, 0.0, 0.02, 0.3])
    density = Density(np.array([np.log(COUNT / 0.17)]))
    runs = (Run((lower,)), Run((cylinder(middle),)), Run((upper,)))
    model = model_of(Stack(breaks, runs), SIGMA, density, 1.0, 1.0)
    (bridged,) = [change for change in merges(model) if len(change.model.stack.runs) == 1]
    points = frustum(0.0)
    found = tried(points, model, bridged, 1)
    assert found is not None
    assert found.vector[2] == pytest.approx(0.3, abs=0.002)


def test_a_run_between_two_kinds_is_not() -> None:
    breaks = np.array([-0.3, 0.0, 0.02, 0.3])
    density = Density(np.array([np.log(COUNT / 0.17)]))
    runs = (Run((cylinder(),)), Run((cylinder(0.2),)), Run((cone(0.1),)))
    model = model_of(Stack(breaks, runs), SIGMA, density, 1.0, 1.0)
    assert all(len(change.model.stack.runs) == 2 for change in merges(model))


@pytest.mark.parametrize(
    "wall",
    [
        Revolved(ORIGIN, ArcProfile(-1.0, -9.7, float(np.hypot(10.0, 1.0)))),
        Swept(Circle(ORIGIN, 0.3), 0.0, np.array([0.01, 0.0]), ORIGIN, 1 / 3, 0.0, ("taper",)),
    ],
)
def test_what_hardly_bulges_or_leans_is_a_cone(wall: Wall) -> None:
    for seed in range(3):
        points = frustum(0.1, seed)
        model, _, _ = climb(points, model_with(wall), 20)
        cones = [change for change in swaps(model) if change.model.stack.walls[0].kind == "cone"]
        assert any(tried(points, model, change, 1) is not None for change in cones)


def test_a_profile_of_more_spans_starts_as_the_one_of_fewer_is() -> None:
    ends = (-0.5, 0.5)
    radii = 0.3 + 0.1 * np.sin(np.arange(10.0))
    bent = Revolved(ORIGIN, SplineProfile(even_knots(-0.56, 0.56, 7), radii))
    finer = respanned(bent, ends, 14)
    assert finer.vector.size == 2 + 17
    z = np.linspace(*ends, 200)
    assert radius_at(finer.profile, z)[0] == pytest.approx(radius_at(bent.profile, z)[0], abs=1e-4)


@pytest.mark.parametrize(("profile", "ways"), [(cylinder(), 0), (cone(), 1), (sphere(), 0), (torus(), 2)])
def test_what_is_drawn_less_often_must_gain_more(profile: Revolved, ways: int) -> None:
    """What strokes fill tells a cone from a zone of a torus hardly."""
    model = model_with(profile)
    parameters = model.parameters + PER_RUN + 2  # and the direction
    seen = evaluate(frustum(0.0), model)
    expected = seen.value - price(parameters, COUNT, 1) - LEANING * ways
    assert worth_of(seen, 1, COUNT) == pytest.approx(expected)
