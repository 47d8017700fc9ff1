"""Which walls are worth having: turns of the direction, flush sides, misfits, and what no wall may do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scribbles import SCRIBBLED
from sketchloft import Params, PointCloud, reconstruct
from sketchloft.cloud import Floats
from sketchloft.direction import Axis, DirectionParams
from sketchloft.exact.body import ExactBody
from sketchloft.exact.changes.cap_misfit import cap_misfit
from sketchloft.exact.changes.change import Change
from sketchloft.exact.changes.evidence import improved
from sketchloft.exact.changes.misfit import misfit
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.likelihood import value_of
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.soundness import detached, sound
from sketchloft.exact.search.flush import flush
from sketchloft.exact.search.upright import upright
from sketchloft.exact.section.recognise_section import recognise_section
from sketchloft.outline.circle import Circle
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon
from sketchloft.outline.polygons import Polygon
from sketchloft.outline.rectilinear import rectilinear_of
from sketchloft.outline.star import Star
from sketchloft.robust_size import middle_and_size
from sketchloft.sample import GOALS, sample_goal
from sketchloft.stack import Run, Stack, Wall, section_boundary
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.profile import ArcProfile, LineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

AXIS = np.zeros(2)
N = 10_000


def prism(width: float, depth: float, x: float = 0.0, y: float = 0.0) -> Swept:
    return Swept(Rectangle(np.array([x, y]), width, depth, 0.0), 0.0, AXIS, AXIS)


def stack_of(breaks: list[float], *walls: Wall) -> Stack:
    return Stack(np.array(breaks), tuple(Run((wall,)) for wall in walls))


def drawn(stack: Stack, count: int = N, seed: int = 0) -> Floats:
    """Points spread evenly in a stack of single walls and their holes, about 1 across."""
    rng = np.random.default_rng(seed)
    low, high = stack.breaks[[0, -1]]
    kept: list[Floats] = []
    while sum(map(len, kept)) < count:
        points = rng.uniform([-0.6, -0.6, low], [0.6, 0.6, high], (4 * count, 3))
        inside = np.zeros(len(points), dtype=bool)
        for run, bottom, top in stack.slabs():
            here = (points[:, 2] >= bottom) & (points[:, 2] < top)
            inside[here] = run.walls[0].foot(points[here]).distance < 0
            for hole in run.walls[len(run.walls) - run.holes :] if run.holes else ():
                inside[here] &= hole.foot(points[here]).distance > 0
        kept.append(points[inside])
    return np.concatenate(kept)[:count]


def model_at(stack: Stack, sigma: float = 0.004, count: int = N) -> ExactModel:
    return model_of(stack, sigma, Density(np.log([count / stack_volume(stack)])), 1.0, 1.0)


def body_of(points: Floats, axis: Axis = "auto") -> ExactBody:
    (body,) = reconstruct(PointCloud.of(points), Params("exact", direction=DirectionParams(axis))).bodies
    assert isinstance(body, ExactBody), body.instead
    return body


# Size


def test_the_size_of_a_box_is_its_diagonal_however_it_is_turned() -> None:
    points = np.random.default_rng(1).uniform(-0.5, 0.5, (50_000, 3)) * [3, 2, 1]
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    middle, size = middle_and_size(points)
    assert size == pytest.approx(np.sqrt(14), rel=0.03)
    turned_middle, turned_size = middle_and_size(points @ turn)
    assert turned_size == pytest.approx(size, rel=1e-12)
    assert turned_middle == pytest.approx(middle @ turn, abs=1e-12)


def test_strays_do_not_change_the_size() -> None:
    points = np.random.default_rng(1).uniform(-0.5, 0.5, (10_000, 3))
    points[:50] *= 20
    assert middle_and_size(points)[1] == pytest.approx(np.sqrt(3), rel=0.03)


# Misfit


@pytest.mark.parametrize("sigma", [0.001, 0.004])
def test_the_right_walls_leave_nothing_and_wrong_ones_do(sigma: float) -> None:
    def ellipse(more: float) -> Stack:
        return stack_of([-0.3, 0.3], Swept(Ellipse(AXIS, 0.4 + more, 0.3 - more, 0.2), 0.0, AXIS, AXIS))

    points = drawn(ellipse(0))
    found = [misfit(points, model_at(ellipse(more), sigma), range(1), 1.0) for more in (0, 0.005, 0.01, 0.02)]
    assert abs(found[0]) < 25
    assert found[0] < found[1] < found[2] < found[3]
    assert found[3] > 50


def test_walls_that_come_together_have_nothing_against_each_other() -> None:
    """At the top and the bottom of a ring points lie beside both of its halves."""
    halves = (Revolved(AXIS, ArcProfile(0.0, 0.35, 0.1, side)) for side in (1, -1))
    ring = Stack(np.array([-0.1, 0.1]), (Run(tuple(halves), 1),))
    assert misfit(drawn(ring), model_at(ring), range(1), 1.0) < 10


def test_faces_across_the_axis_have_a_misfit_where_a_roof_is() -> None:
    box, tower = prism(0.8, 0.5), prism(0.3, 0.2)
    steps = stack_of([-0.3, 0.0, 0.3], box, tower)
    assert cap_misfit(drawn(steps), model_at(steps), 1.0) < 10
    points = drawn(stack_of([-0.3, 0.3], box))
    roof = points[points[:, 2] < 0.3 - 0.1 * np.abs(points[:, 0]) / 0.4]
    flat = [cap_misfit(roof, model_at(stack_of([-0.3, 0.3 - lower], box)), 1.0) for lower in (0.03, 0.05)]
    assert min(flat) > 20
    overhang = stack_of([-0.3, 0.0, 0.3], box, prism(0.6, 0.4))
    assert cap_misfit(drawn(steps), model_at(overhang), 1.0) > 20


# Flush sides


def test_sides_that_differ_by_chance_are_put_into_one_plane() -> None:
    truth = stack_of([-0.3, 0.0, 0.3], prism(0.8, 0.5), prism(0.3, 0.5, -0.25))
    points = drawn(truth)
    found = stack_of([-0.3, 0.0, 0.3], prism(0.8, 0.5), prism(0.3004, 0.4996, -0.2499, 0.0001))
    joined = flush(points, model_at(found, 2e-4), 1.0)
    lower, upper = (
        run.walls[0].outline.boundary(64).points.min(axis=0)
        for run in joined.stack.runs
        if isinstance(run.walls[0], Swept)
    )
    assert upper == pytest.approx(lower, abs=1e-3)
    corners = [run.walls[0].outline.chain()[0] for run in joined.stack.runs]  # type: ignore[union-attr]
    assert corners[0][:, 1].min() == pytest.approx(corners[1][:, 1].min(), abs=1e-15)
    assert corners[0][:, 0].min() == pytest.approx(corners[1][:, 0].min(), abs=1e-15)


def test_a_true_step_stays() -> None:
    truth = stack_of([-0.3, 0.0, 0.3], prism(0.8, 0.5), prism(0.79, 0.49))
    model = model_at(truth, 2e-4)
    assert flush(drawn(truth), model, 1.0) is model


def test_an_l_from_either_side_has_eight_planes() -> None:
    points = sample_goal(GOALS["l-shape"], N, seed=3).points
    for axis in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        assert body_of(points, axis).facts.faces == {"Plane": 8}


# Upright walls


@pytest.mark.slow
def test_a_search_that_takes_every_change_comes_to_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """It goes back to what it left once: a change is not always judged as the one back is."""
    taken: list[ExactModel] = []

    def take(points: Floats, model: ExactModel, change: Change, together: float) -> ExactModel:
        del points, model, together
        taken.append(change.model)
        assert len(taken) < 1000
        return change.model

    monkeypatch.setattr("sketchloft.exact.changes.evidence.tried", take)
    stack = stack_of([-0.2, 0.0, 0.2], prism(0.5, 0.4), prism(0.3, 0.2))
    improved(drawn(stack, 1500), model_at(stack, count=1500), 1.0, lofts=False)
    assert len(taken) > 3


def test_a_cylinder_seen_askew_stands_straight() -> None:
    cylinder = Revolved(AXIS, LineProfile(0.0, 0.3, None))
    points = drawn(stack_of([-0.4, 0.4], cylinder))
    lean = 0.03
    turn = np.array([[np.cos(lean), 0, np.sin(lean)], [0, 1, 0], [-np.sin(lean), 0, np.cos(lean)]])
    slanted = Swept(Circle(AXIS, 0.3), 0.0, AXIS, np.array([np.tan(lean), 0.0]), 0.0, 0.0, ("drift",))
    askew = points @ turn.T
    model, rotation = upright(askew, model_at(stack_of([-0.4, 0.4], slanted)), 1.0)
    assert [wall.kind for run in model.stack.runs for wall in run.walls] == ["cylinder"]
    assert (askew @ rotation)[:, :2] == pytest.approx(points[:, :2], abs=0.004)


def test_a_slanted_prism_stays_slanted() -> None:
    slanted = replace(prism(0.4, 0.3), drift=np.array([0.25, 0.1]), free=("drift",))
    stack = stack_of([-0.3, 0.3], slanted)
    model = model_at(stack)
    assert upright(drawn(stack), model, 1.0)[0] is model


# What no wall may do


def test_a_hole_must_leave_something_of_its_section() -> None:
    outer, hole = (Revolved(AXIS, LineProfile(0.0, radius, None)) for radius in (0.3, 0.299))
    ring = Stack(np.array([-0.3, 0.3]), (Run((outer, hole), 1),))
    assert not sound(model_at(ring))
    wide = replace(hole, profile=LineProfile(0.0, 0.2, None))
    assert sound(model_at(Stack(ring.breaks, (Run((outer, wide), 1),))))


def test_a_sphere_must_reach_the_run_beside_it() -> None:
    cylinder = Revolved(AXIS, LineProfile(0.0, 0.1, None))
    for top, count in ((0.2, 0), (0.4, 1)):
        ball = Revolved(AXIS, ArcProfile(0.0, None, 0.3))
        assert detached(model_at(stack_of([-0.3, top, 0.6], ball, cylinder))) == count


def test_a_hole_and_a_flat_end_must_earn_their_place() -> None:
    ball = Revolved(AXIS, ArcProfile(0.0, None, 0.3))
    for low, flat in ((-0.29, False), (-0.22, True)):
        cut = model_at(stack_of([low, 0.3], ball))
        found = improved(drawn(stack_of([low if flat else -0.3, 0.3], ball)), cut, 1.0)
        assert (found.joins[0] == "step") == flat
    outer, hole = (Revolved(AXIS, LineProfile(0.0, radius, None)) for radius in (0.3, 0.06))
    pierced = Stack(np.array([-0.3, 0.3]), (Run((outer, hole), 1),))
    for true, holes in ((stack_of([-0.3, 0.3], outer), 0), (pierced, 1)):
        assert improved(drawn(true), model_at(pierced), 1.0).stack.runs[0].holes == holes


# Sections


def test_a_star_has_two_radii() -> None:
    star = Star(np.zeros(2), 0.4, 0.18, 0.2, 5)
    stack = stack_of([-0.15, 0.15], Swept(star, 0.0, np.zeros(2), np.zeros(2)))
    free = stack_of([-0.15, 0.15], Swept(Polygon(star.chain()[0]), 0.0, np.zeros(2), np.zeros(2)))
    found = improved(drawn(stack), model_at(free), 1.0).stack.runs[0].walls[0]
    assert isinstance(found, Swept)
    assert isinstance(found.outline, Star)
    assert (found.outline.radius, found.outline.inner_radius) == pytest.approx((0.4, 0.18), abs=0.006)


@pytest.mark.parametrize(("lean", "kind"), [(0.0, "rectilinear polygon"), (0.07, "polygon")])
def test_corners_are_right_ones_only_where_they_are(lean: float, kind: str) -> None:
    ell = np.array([[0, 0], [0.6, 0], [0.6, 0.2], [0.2, 0.2], [0.2, 0.6], [0, 0.6]]) - 0.25
    true = Polygon(ell + lean * np.column_stack([ell[:, 1], np.zeros(6)]))
    right = rectilinear_of(true.vertices)
    assert right is not None
    points = drawn(stack_of([-0.15, 0.15], Swept(true, 0.0, AXIS, AXIS)))
    for start in (true, right):
        found = improved(points, model_at(stack_of([-0.15, 0.15], Swept(start, 0.0, AXIS, AXIS))), 1.0)
        wall = found.stack.runs[0].walls[0]
        assert wall.kind == kind
        assert isinstance(wall, Swept)
        assert np.abs(true.foot(wall.outline.boundary(60).points).distance).max() < 0.004


@pytest.mark.parametrize("aside", [[0.03, 0.0], [-0.01, 0.02]])
def test_a_roof_grows_about_its_own_middle(aside: list[float]) -> None:
    """Wherever the first look at the points sees that."""
    square = Rectangle(AXIS, 0.6, 0.5, 0.0)
    house = Swept(square, 0.0, AXIS, AXIS)
    roof = Swept(square, 0.1, AXIS, AXIS, -2.0, 0.0, ("taper",))
    points = drawn(stack_of([-0.3, 0.1, 0.4], house, roof))
    seen = replace(roof, pivot=np.array(aside)).about_centre()
    found, _, _ = climb(points, model_at(stack_of([-0.3, 0.1, 0.4], house, seen)), 12)
    wall = found.stack.runs[1].walls[0]
    assert np.abs(section_boundary(wall, 0.35, 80).centre).max() < 0.001
    fixed = model_at(stack_of([-0.3, 0.1, 0.4], house, replace(roof, pivot=np.array(aside))))
    drifting, _, _ = climb(points, fixed, 12)
    assert value_of(points, found) > value_of(points, drifting) + 5


@pytest.mark.parametrize("seed", range(3))
def test_a_hexagon_is_no_circle(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-0.3, 0.3, (20_000, 2))
    turn = np.arange(6) * np.pi / 3 + 0.1
    points = points[(points @ [np.cos(turn), np.sin(turn)] < 0.25).all(axis=1)][:4000]
    shape = recognise_section(points, 1.0)
    assert shape is not None
    assert shape.outlines[0].kind in ("regular polygon", "polygon")
    assert len(shape.outlines[0].edges()) == 6


@pytest.mark.parametrize("seed", range(3))
def test_a_circle_is_no_hexagon(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-0.3, 0.3, (6000, 2))
    shape = recognise_section(points[np.hypot(*points.T) < 0.3][:1500], 1.0)
    assert shape is not None
    assert shape.outlines[0].kind == "circle"


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    "hole",
    [
        Circle(np.array([0.05, 0.02]), 0.2),
        Ellipse(np.array([0.05, 0.02]), 0.25, 0.15, 0.4),
        Rectangle(np.array([0.05, 0.02]), 0.4, 0.25, 0.3),
        RegularPolygon(np.array([0.05, 0.02]), 0.22, 0.2, 6),
    ],
    ids=lambda hole: hole.kind,
)
def test_a_hole_has_the_outline_that_was_cut(hole: Outline, seed: int) -> None:
    points = np.random.default_rng(seed).uniform([-0.5, -0.35], [0.5, 0.35], (6000, 2))
    shape = recognise_section(points[hole.foot(points).distance > 0], 1.0)
    assert shape is not None
    assert shape.holes == 1
    assert [outline.kind for outline in shape.outlines] == ["rectangle", hole.kind]
    assert np.abs(hole.foot(shape.outlines[1].boundary(80).points).distance).max() < 0.006


# Domes and strokes, from the cloud to the solid


def test_an_ellipsoid_is_one_face() -> None:
    points = np.random.default_rng(4).uniform(-1, 1, (4 * N, 3))
    body = body_of((points[np.linalg.norm(points, axis=1) < 1] * [3, 2, 1.5])[:N])
    assert body.facts.faces == {"BSplineSurface": 1}
    assert body.facts.volume == pytest.approx(4 / 3 * np.pi * 9, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [11, 12])
def test_a_tall_slab_that_becomes_round_is_seen_from_its_end(seed: int) -> None:
    """Seen from its side it can be cut into three polygons, which the points have something against."""
    ruled = Ruled(Rectangle(AXIS, 0.66, 0.33, 0.0), DividedCircle(AXIS, 0.165, np.pi / 4, -0.1), -0.44, 0.44)
    body = body_of(drawn(stack_of([-0.44, 0.44], ruled), seed=seed))
    assert [wall.kind for run in body.model.stack.runs for wall in run.walls] == ["ruled"]
    assert np.abs(body.vector[2]) == pytest.approx(1, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_triangle_that_turns_is_seen_along_its_axis(seed: int) -> None:
    """Seen from the side its sections are smoother than those of the still heights along it."""
    points = np.random.default_rng(seed).uniform(-1, 1, (16 * N, 3)) * [3, 3, 4.5]
    spokes = points[:, :2] @ [1, 1j] * np.exp(-1j * np.pi / 18 * points[:, 2])
    ways = np.exp(-2j * np.pi * np.arange(3) / 3)
    points = points[((spokes[:, None] * ways).real < 1.5).all(axis=1)][:N]
    body = body_of(points)
    assert [wall.kind for run in body.model.stack.runs for wall in run.walls] == ["twisted regular polygon"]
    assert body.facts.volume == pytest.approx(1.5**2 * 3 * np.sqrt(3) * 9, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "faces", "least"),
    [
        ("box", {"Plane": 6}, 4),
        ("cone", {"ConicalSurface": 1, "Plane": 2}, 4),
        ("three-spheres", {"SphericalSurface": 3}, 3),
        ("stepped-shaft", {"CylindricalSurface": 4, "Plane": 5}, 2),
    ],
)
def test_scribbles_give_the_same_faces(name: str, faces: dict[str, int], least: int) -> None:
    """At least as often as said: a few strokes of four scribbles leave some sections open to doubt."""
    bodies = [body_of(sample_goal(GOALS[name], N, SCRIBBLED, seed=seed).points) for seed in range(1, 5)]
    assert sum(body.facts.faces == faces for body in bodies) >= least
