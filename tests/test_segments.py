"""Segments: cuts where the rule of the sections changes and nowhere else; and twists."""

from __future__ import annotations

import numpy as np
import pytest

from sketchloft.cloud import Floats
from sketchloft.dispersion import clump
from sketchloft.exact.model.density import Density
from sketchloft.exact.section.section_contours import plan_view
from sketchloft.exact.section.segment_walls import segment_run
from sketchloft.exact.section.twist import seems_to_turn, sharpest_twist, twist_of, untwisted
from sketchloft.exact.start.segments import SegmentsParams, segments
from sketchloft.exact.start.start import start_along
from sketchloft.sample import GOALS, sample_goal

N = 6000
MANY = 10_000
BIN = 1 / 144
"""Share of the height that a cut is told to."""


def cuts(points: Floats) -> Floats:
    return segments(points, SegmentsParams())


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("stepped-shaft", [0, 2, 7, 9, 12]),
        ("lamp", [0, 1.5, 12, 18]),
        ("three-spheres", [-4, 3.2, 5 + 17.25 / 7, 10.5]),  # where the spheres cross
    ],
)
def test_known_cuts(name: str, known: list[float]) -> None:
    for seed in (1, 2, 3):
        found = cuts(sample_goal(GOALS[name], MANY, seed=seed).points)
        assert found == pytest.approx(known, abs=2.5 * BIN * (known[-1] - known[0]))


def test_first_stacks_are_told_apart() -> None:
    points = np.random.default_rng(1).uniform(-0.5, 0.5, (1500, 3)) * [1, 0.8, 0.6]
    starts = [start_along(points, axis, (), SegmentsParams(), rough=True) for axis in np.eye(3)]
    kept = list(starts)
    kept.remove(starts[2])
    assert kept == starts[:2]


def test_with_few_points_no_cut_of_a_lamp_is_lost() -> None:
    """Where a section holds few points there may be more cuts; the evidence takes them out."""
    for seed in (1, 2, 3):
        found = cuts(sample_goal(GOALS["lamp"], N // 2, seed=seed).points)
        away = np.abs(found[:, None] - np.array([0, 1.5, 12, 18])).min(axis=0)
        assert away.max() < 0.5


@pytest.mark.parametrize("name", ["cylinder", "box", "cone", "sphere", "l-shape"])
def test_no_cut_where_one_rule_holds(name: str) -> None:
    for seed in (1, 2, 3):
        points = sample_goal(GOALS[name], N, seed=seed).points
        assert cuts(points) == pytest.approx([points[:, 2].min(), points[:, 2].max()])


def test_cuts_move_and_grow_with_the_points() -> None:
    points = sample_goal(GOALS["stepped-shaft"], N, seed=1).points
    moved = cuts(1e-3 * points + [5, -7, 2])
    assert moved == pytest.approx(1e-3 * cuts(points) + 2, abs=1e-9)


def test_a_drift_is_no_cut_but_a_kink_is() -> None:
    rng = np.random.default_rng(2)
    points = rng.uniform(-1, 1, (N, 3)) * [0.3, 0.2, 1]
    slanted = points + np.outer(points[:, 2], [0.4, 0.1, 0])
    assert len(cuts(slanted)) == 2
    bent = points + np.outer(np.maximum(points[:, 2] - 0.2, 0), [0.8, 0, 0])
    assert cuts(bent) == pytest.approx([-1, 0.2, 1], abs=0.1)


def bar(twist: float, corners: int, seed: int = 3) -> Floats:
    """A bar with a regular polygon, or for two corners a flat rectangle, for a section that turns."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-0.3, 0.3, (6 * N, 3)) * [1, 1, 1.5]
    if corners == 2:
        points = points[np.abs(points[:, 1]) < 0.12]
    elif corners:
        angle = 2 * np.pi * np.arange(corners) / corners
        across = np.column_stack([np.cos(angle), np.sin(angle)])
        points = points[(points[:, :2] @ across.T).max(axis=1) < 0.25]
    else:
        points = points[np.hypot(points[:, 0], points[:, 1]) < 0.28]
    points = points[:N]
    spokes = (points[:, :2] @ [1, 1j]) * np.exp(1j * twist * points[:, 2])
    return np.column_stack([spokes.real + 0.05, spokes.imag - 0.02, points[:, 2]])


def found_twist(points: Floats) -> float:
    plan = plan_view(points)
    return twist_of(plan, points[:, 2] - plan.height)


@pytest.mark.parametrize(
    ("corners", "twist"), [(2, 0.8), (2, 1.6), (2, -2.4), (3, 1.2), (3, -2.0), (4, -1.2), (4, 2.4)]
)
def test_a_known_twist_is_found(corners: int, twist: float) -> None:
    """Per height; the bar is 0.9 high, so its ends are turned against each other by 40 to 120 degrees."""
    assert found_twist(bar(twist, corners)) == pytest.approx(twist, abs=0.1)


def test_all_points_tell_of_a_stout_bar_that_it_turns() -> None:
    """Its sides are 3 to 2, so that its moments stand out less, and its ends are turned by 60 degrees."""
    points = np.random.default_rng(4).uniform(-0.3, 0.3, (9000, 3)) * [1, 2 / 3, 1.1]
    twist = np.pi / 3 / 0.66
    spokes = (points[:, :2] @ [1, 1j]) * np.exp(1j * twist * points[:, 2])
    turned = np.column_stack([spokes.real, spokes.imag, points[:, 2]])
    assert found_twist(turned) == pytest.approx(twist, abs=0.15)


@pytest.mark.parametrize("corners", [0, 2, 3, 4, 6])
def test_what_does_not_turn_has_no_twist(corners: int) -> None:
    for seed in (3, 4, 5):
        assert found_twist(bar(0.0, corners, seed)) == 0


@pytest.mark.parametrize("corners", [2, 3, 4])
def test_a_turn_shows_at_a_glance_and_only_where_there_is_one(corners: int) -> None:
    for twist in (0.0, 1.6):
        points = bar(twist, corners, 3)
        plan = plan_view(points)
        assert seems_to_turn(plan, points[:, 2] - plan.height) == bool(twist)


@pytest.mark.parametrize("twist", [1.0, -1.8])
def test_where_a_bar_is_filled_unevenly_its_outline_tells_how_far_it_turns(twist: float) -> None:
    """Half of its quarters are left half empty, below others than above: its moments turn otherwise."""
    points = bar(0.0, 2)
    crossed = points[:, 2] * (points[:, 0] - 0.05) * (points[:, 1] + 0.02) > 0
    points = points[~crossed | (np.arange(N) % 2 == 0)] - [0.05, -0.02, 0]
    spokes = (points[:, :2] @ [1, 1j]) * np.exp(1j * twist * points[:, 2])
    turned = np.column_stack([spokes.real, spokes.imag, points[:, 2]])
    plan = plan_view(turned)
    heights = turned[:, 2] - plan.height
    assert sharpest_twist(plan, heights) == pytest.approx(twist, abs=0.1)
    assert abs(twist_of(plan, heights) - twist) > 0.2


@pytest.mark.parametrize("corners", [0, 2, 4])
def test_no_turn_makes_a_straight_or_round_bar_sharper(corners: int) -> None:
    points = bar(0.0, corners)
    plan = plan_view(points)
    assert sharpest_twist(plan, points[:, 2] - plan.height) == 0


def test_a_round_bar_has_no_twist_however_it_is_turned() -> None:
    assert found_twist(bar(1.5, 0)) == 0


def test_untwisted_points_fill_one_section() -> None:
    points = bar(1.2, 2)
    plan = plan_view(points)
    heights = points[:, 2] - plan.height
    flat = untwisted(plan, heights, 1.2).points
    turned = np.linalg.eigvalsh(np.cov(flat.T))
    assert np.sqrt(12 * turned) == pytest.approx([0.24, 0.6], rel=0.03)


@pytest.mark.parametrize("twist", [0.0, 1.6])
def test_a_segment_that_shows_no_turn_has_that_of_the_whole_where_it_fits(twist: float) -> None:
    """Points of strokes say so little that a short segment seems to go straight up."""
    points, together = bar(twist, 4), 12.0
    part = points[np.abs(points[:, 2]) < 0.12]
    plan = plan_view(part, clump(together))
    assert twist_of(plan, part[:, 2] - plan.height, clump(together)) == 0
    density = Density(np.array([np.log(len(part) / 0.06), 0.0, 0.0, 0.0]))
    for turn in (0.0, 1.6):
        run = segment_run(part, (-0.12, 0.12), 0.006, together, density, turn=turn)
        assert run is not None
        (wall,) = run.walls
        assert wall.kind.startswith("twisted") == (turn == twist != 0)
