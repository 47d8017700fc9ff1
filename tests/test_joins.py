"""Breaks that follow from the walls beside them: crossings, tangents and poles."""

from __future__ import annotations

import numpy as np
import pytest

from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.joins import crossing, joined, natural_joins
from sketchloft.stack import Run, Stack
from sketchloft.wall.profile import ArcProfile, LineProfile, Profile, SplineProfile
from sketchloft.wall.revolved import Revolved

AXIS = np.array([0.02, -0.01])
BALLS = ((-0.2, 0.25), (0.1, 0.2))
MEET = (BALLS[0][0] + BALLS[1][0]) / 2 + (BALLS[0][1] ** 2 - BALLS[1][1] ** 2) / (
    2 * (BALLS[1][0] - BALLS[0][0])
)
"""Height of the plane in which the two balls' surfaces cross."""


def run(profile: Profile) -> Run:
    return Run((Revolved(AXIS, profile),))


def ball(height: float, radius: float) -> Run:
    return run(ArcProfile(height, None, radius))


def stack_of(breaks: list[float], *runs: Run) -> ExactModel:
    return model_of(Stack(np.array(breaks), runs), 0.004, Density(np.zeros(1)), 1.0, 1.0)


def test_two_spheres_cross_in_a_known_plane() -> None:
    below, above = (ball(*one) for one in BALLS)
    assert crossing(below, above, MEET + 0.03, 0.1) == pytest.approx(MEET, abs=1e-9)
    assert crossing(below, above, MEET + 0.03, 0.02) is None
    radii = [np.sqrt(radius**2 - (MEET - height) ** 2) for height, radius in BALLS]
    assert radii[0] == pytest.approx(radii[1])


def test_a_cone_and_a_cylinder_cross_once() -> None:
    cone, cylinder = run(LineProfile(0.0, 0.3, -0.5)), run(LineProfile(0.0, 0.2, None))
    assert crossing(cone, cylinder, 0.15, 0.2) == pytest.approx(0.2, abs=1e-9)
    assert crossing(cylinder, run(LineProfile(0.0, 0.25, None)), 0.1, 0.5) is None


def test_profiles_cross_only_where_both_are_given() -> None:
    knots = np.r_[[-0.3] * 4, [0.05] * 4]
    short = run(SplineProfile(knots, np.array([0.3, 0.28, 0.25, 0.22])))
    assert crossing(short, run(LineProfile(0.0, 0.1, None)), 0.02, 0.2) is None
    assert crossing(short, run(LineProfile(0.0, 0.24, None)), 0.02, 0.2) == pytest.approx(-0.031, abs=0.01)


def test_breaks_go_where_the_walls_say() -> None:
    rough = stack_of([-0.445, MEET + 0.008, 0.296], *(ball(*one) for one in BALLS))
    model = natural_joins(rough)
    assert model.joins == ("pole", "cross", "pole")
    assert model.stack.breaks == pytest.approx([-0.45, MEET, 0.3], abs=1e-9)
    assert model.parameters == rough.parameters - 3
    lower = model.vector - np.array([0, 0, 0.05, 0, 0, 0, 0.05, 0])
    moved = joined(model.moved(lower, model.stack.breaks))
    assert moved.stack.breaks == pytest.approx(model.stack.breaks - 0.05, abs=1e-9)


def test_a_cylinder_ends_tangent_to_a_dome() -> None:
    model = natural_joins(stack_of([-0.3, 0.105, 0.345], run(LineProfile(0.0, 0.25, None)), ball(0.1, 0.25)))
    assert model.joins == ("step", "tangent", "pole")
    assert model.stack.breaks == pytest.approx([-0.3, 0.1, 0.35])


def test_steps_stay_steps() -> None:
    wide, thin = run(LineProfile(0.0, 0.3, None)), run(LineProfile(0.0, 0.2, None))
    aside = Run((Revolved(AXIS + 0.05, ArcProfile(0.1, None, 0.2)),))
    for model in (
        stack_of([-0.3, 0.0, 0.3], wide, thin),
        stack_of([-0.44, MEET, 0.2], ball(*BALLS[0]), aside),
        stack_of([-0.3, 0.1, 0.2], ball(-0.1, 0.35), thin),
    ):
        found = natural_joins(model)
        assert found.joins[1] == "step"
        assert found.stack.breaks[1] == model.stack.breaks[1]


def test_a_step_stays_where_the_spheres_beside_it_reach() -> None:
    """A break above the ball below it would leave what is on top hanging on nothing."""
    away = Revolved(AXIS + 0.1, ArcProfile(0.1, None, 0.2))
    stack = Stack(np.array([-0.45, 0.07, 0.3]), (ball(*BALLS[0]), Run((away,))))
    model = joined(model_of(stack, 0.004, Density(np.zeros(1)), 1.0, 1.0))
    assert model.stack.breaks == pytest.approx([-0.45, 0.05, 0.3])
    apart = Stack(np.array([-0.45, 0.07, 0.5]), (ball(*BALLS[0]), ball(0.3, 0.2)))
    assert joined(model_of(apart, 0.004, Density(np.zeros(1)), 1.0, 1.0)).stack.breaks[1] == 0.07
