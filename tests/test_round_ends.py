"""Round ends and rings: what is one thing has one axis and one radius from the start."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from scribbles import scribbled
from sketchloft import Params, PointCloud, reconstruct
from sketchloft.cloud import Floats
from sketchloft.exact.body import ExactBody
from sketchloft.exact.changes.rings import rings
from sketchloft.exact.changes.round_ends import round_ends
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.surgery import with_wall
from sketchloft.exact.search.as_capsule import as_capsule
from sketchloft.outline.circle import Circle
from sketchloft.outline.placed_polygons import RoundedRectangle
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.profile import ArcProfile, LineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.swept import Swept

N = 10_000
ORIGIN = np.zeros(2)
RADIUS, LENGTH = 2.0, 6.0
"""Of a capsule, the length between the centres of its ends."""
SLOW = pytest.mark.slow


def in_capsule(points: Floats) -> np.ndarray:
    away = points.copy()
    away[:, 2] -= np.clip(away[:, 2], 0, LENGTH)
    return np.linalg.norm(away, axis=1) < RADIUS


def kinds(model: ExactModel) -> list[list[str]]:
    return [[wall.kind for wall in run.walls] for run in model.stack.runs]


def of(stack: Stack, sigma: float = 0.004) -> ExactModel:
    return model_of(stack, sigma, Density(np.zeros(1)), 1.0, 1.0)


def found(points: Floats) -> ExactBody:
    (body,) = reconstruct(PointCloud.of(points), Params("exact")).bodies
    assert isinstance(body, ExactBody), body.instead
    return body


@SLOW
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_scribbled_capsule_has_round_ends(seed: int) -> None:
    low, high = np.array([-RADIUS] * 3), np.array([RADIUS, RADIUS, LENGTH + RADIUS])
    body = found(scribbled(in_capsule, low, high, N, seed))
    assert kinds(body.model) == [["sphere"], ["cylinder"], ["sphere"]]
    assert body.facts.faces == {"CylindricalSurface": 1, "SphericalSurface": 2}
    true = np.pi * RADIUS**2 * LENGTH + 4 / 3 * np.pi * RADIUS**3
    assert body.facts.volume == pytest.approx(true, rel=0.04)
    assert abs(body.vector[2]) > np.cos(np.radians(2))


@SLOW
@pytest.mark.parametrize("seed", [1, 4])
def test_a_noisy_ring_is_one_torus(seed: int) -> None:
    rng = np.random.default_rng(seed)
    box = rng.uniform([-5.5, -5.5, -1.5], [5.5, 5.5, 1.5], (6 * N, 3))
    points = box[(np.hypot(box[:, 0], box[:, 1]) - 4) ** 2 + box[:, 2] ** 2 < 1.5**2][:N]
    body = found(points + 0.08 * rng.standard_normal(points.shape))
    assert body.facts.faces == {"ToroidalSurface": 1}
    assert body.facts.volume == pytest.approx(2 * np.pi**2 * 4 * 1.5**2, rel=0.02)


def test_a_cylinder_may_end_with_half_spheres_at_no_price() -> None:
    cylinder = of(Stack(np.array([-0.4, 0.4]), (Run((Revolved(ORIGIN, LineProfile(0.0, 0.2, None)),)),)))
    both, below, above = (change.model for change in round_ends(cylinder))
    assert kinds(both) == [["sphere"], ["cylinder"], ["sphere"]]
    assert both.joins == ("pole", "tangent", "tangent", "pole")
    beyond = 0.2 / 6  # a flat end that is fitted to a dome is that much lower
    expected = [-0.4 - beyond, -0.2 - beyond, 0.2 + beyond, 0.4 + beyond]
    assert both.stack.breaks == pytest.approx(expected)
    assert both.parameters == cylinder.parameters
    assert kinds(below) == [["sphere"], ["cylinder"]]
    assert kinds(above) == [["cylinder"], ["sphere"]]


def test_what_is_too_short_or_not_at_an_end_has_no_round_ends() -> None:
    flat, long = Revolved(ORIGIN, LineProfile(0.0, 0.3, None)), Revolved(ORIGIN, LineProfile(0.0, 0.1, None))
    square = Swept(RoundedRectangle(ORIGIN, 0.6, 0.6, 0.0, 0.1), 0.0, ORIGIN, ORIGIN)
    stack = Stack(np.array([-0.3, 0.0, 0.3, 0.5]), (Run((flat,)), Run((long,)), Run((square,))))
    assert [*round_ends(of(stack))] == []
    below = Stack(stack.breaks[1:], stack.runs[1:])
    assert [kinds(change.model) for change in round_ends(of(below))] == [
        [["sphere"], ["cylinder"], ["rounded rectangle"]]
    ]


@pytest.mark.parametrize("side", [-1, 1])
def test_what_bulges_beyond_a_cylinder_may_be_half_a_sphere_of_its_radius(side: int) -> None:
    """By itself, a dome found in slices is too far from one, with a break that has to move, too."""
    dome = Swept(Circle(ORIGIN, 0.19), 0.0, ORIGIN, ORIGIN, 0.0, 0.0, ("taper", "bow"), 0.3)
    runs = Run((Revolved(ORIGIN, LineProfile(0.0, 0.2, None)),)), Run((dome,))
    stack = Stack(np.array([-0.4, 0.25, 0.38]) * side, runs)
    stack = stack if side > 0 else Stack(stack.breaks[::-1], runs[::-1])
    models = [change.model for change in round_ends(of(stack)) if len(change.model.stack.runs) == 2]
    (model,) = models
    assert kinds(model) == ([["cylinder"], ["sphere"]] if side > 0 else [["sphere"], ["cylinder"]])
    assert np.sort(side * model.stack.breaks) == pytest.approx([-0.4, 0.18, 0.38])
    assert model.joins[1] == "tangent"


def test_ties_outlast_a_change_elsewhere_and_no_other() -> None:
    cylinder = of(Stack(np.array([-0.4, 0.4]), (Run((Revolved(ORIGIN, LineProfile(0.0, 0.2, None)),)),)))
    both = next(round_ends(cylinder)).model
    wider = both.moved(both.vector + np.array([0, 0, 0, 0.01, 0][: both.size]), both.stack.breaks)
    again = with_wall(wider, 2, 0, wider.stack.runs[2].walls[0])
    assert again.size == both.size
    other = with_wall(wider, 2, 0, Revolved(ORIGIN, ArcProfile(0.2, None, 0.25)))
    assert other.size == both.size + 3


def test_a_ring_of_three_runs_is_taken_for_one_torus_first() -> None:
    breaks = np.array([-0.15, -0.08, 0.08, 0.15])
    torus = [Revolved(ORIGIN, ArcProfile(0.0, 0.4, 0.15, side)) for side in (1, -1)]
    runs = []
    for low, high in pairwise(breaks.tolist()):
        radii = [np.sqrt(wall.area(np.array([(low + high) / 2]))[0] / np.pi) for wall in torus]
        walls: list[Wall] = [Swept(Circle(ORIGIN, r), (low + high) / 2, ORIGIN, ORIGIN) for r in radii]
        runs.append(Run(tuple(walls), 1))
    model = next(rings(of(Stack(breaks, tuple(runs))))).model
    (run,) = model.stack.runs
    assert run.torus is not None
    assert (run.torus.offset, run.torus.radius) == pytest.approx((0.4, 0.15), rel=0.15)
    assert model.size == 5
    assert model.joins == ("pole", "pole")
    assert [*rings(model)] == []


@pytest.mark.parametrize("long", [0, 1, 2])
def test_a_bar_rounded_all_around_is_a_capsule(long: int) -> None:
    rng = np.random.default_rng(7)
    box = rng.uniform([-0.2, -0.2, -0.5], [0.2, 0.2, 0.5], (2 * N, 3))
    points = box[in_capsule(box * 10 + [0, 0, LENGTH / 2])]
    sizes = np.roll([0.4, 0.4, 1.0], long + 1)
    seen = np.roll(points, long + 1, axis=1)
    outline = RoundedRectangle(ORIGIN, float(sizes[0]), float(sizes[1]), 0.0, 0.19)
    wall = Filleted(outline, None, "both", -sizes[2] / 2, sizes[2] / 2)
    bar = of(Stack(np.array([wall.low, wall.high]), (Run((wall,)),)))
    model, turn = as_capsule(seen, bar, 1.0)
    assert kinds(model) == [["sphere"], ["cylinder"], ["sphere"]]
    assert abs(turn[long, 2]) == 1
    assert np.linalg.det(turn) == pytest.approx(1)
    assert model.stack.breaks == pytest.approx([-0.5, -0.3, 0.3, 0.5], abs=0.005)


def test_a_bar_with_flats_stays_one() -> None:
    wall = Filleted(RoundedRectangle(ORIGIN, 0.5, 0.4, 0.0, 0.19), None, "both", -0.5, 0.5)
    bar = of(Stack(np.array([-0.5, 0.5]), (Run((wall,)),)))
    model, turn = as_capsule(np.zeros((0, 3)), bar, 1.0)
    assert model is bar
    assert (turn == np.eye(3)).all()
