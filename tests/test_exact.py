"""The exact method as a whole: the faces a designer would draw, walls where they belong, and the axioms."""

from __future__ import annotations

import functools
from collections import Counter

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sketchloft import Mesh, Params, PointCloud, measure, reconstruct
from sketchloft.brep.model import Model, NamedSolid
from sketchloft.brep.primitives import fuse
from sketchloft.brep.step_file import write as step_bytes
from sketchloft.brep.tessellate import tessellate
from sketchloft.cloud import Floats
from sketchloft.direction import Axis, DirectionParams
from sketchloft.exact.body import ExactBody
from sketchloft.outline.placed_polygons import RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc
from sketchloft.sample import GOALS, FillParams, sample_goal
from sketchloft.stack import Run, Stack
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.ruled import Ruled

N = 5000
ALONG_Z: Axis = (0.0, 0.0, 1.0)
TURN = Rotation.from_rotvec(np.radians(37) * np.array([1, 2, 3]) / np.sqrt(14)).as_matrix()
NOISY = FillParams(jitter=0.005, outliers=0.01)
FACES = {
    "three-spheres": {"SphericalSurface": 3},
    "sphere": {"SphericalSurface": 1},
    "lamp": {"CylindricalSurface": 1, "ConicalSurface": 1, "Plane": 8},
    "l-shape": {"Plane": 8},
    "cylinder": {"CylindricalSurface": 1, "Plane": 2},
    "cone": {"ConicalSurface": 1, "Plane": 2},
    "box": {"Plane": 6},
    "stepped-shaft": {"CylindricalSurface": 4, "Plane": 5},
}
KINDS = {
    "three-spheres": [["sphere"], ["sphere"], ["sphere"]],
    "lamp": [["cylinder"], ["rectangle"], ["cone"]],
    "stepped-shaft": [["cylinder"]] * 4,
}
AT_10_000 = {"uniform": 0.4, "noisy": 1.5}
"""Largest root mean square error for 10,000 points, in thousandths of the diagonal."""
SLOW = pytest.mark.slow


def built(points: Floats, axis: Axis = ALONG_Z, name: str = "cloud") -> ExactBody:
    (body,) = reconstruct(
        PointCloud.of(points, name=name), Params("exact", direction=DirectionParams(axis))
    ).bodies
    assert isinstance(body, ExactBody), body.instead
    return body


@functools.cache
def cloud(name: str, n: int = N, fill: FillParams | None = None, seed: int = 1) -> Floats:
    return sample_goal(GOALS[name], n, fill, seed=seed).points


@functools.cache
def model(name: str, n: int = N, fill: FillParams | None = None, seed: int = 1) -> ExactBody:
    return built(cloud(name, n, fill, seed), name=name)


@functools.cache
def goal_mesh(name: str) -> Mesh:
    return tessellate(fuse(GOALS[name].parts), 5e-5, 0.1)


def rms(body: ExactBody) -> float:
    """Larger one of both ways, in thousandths of the goal's diagonal."""
    found = measure(tessellate(body.solid, 5e-5, 0.1), goal_mesh(body.name), n=8000)
    return max(found.errors_in_thousandths.rms, found.back_errors_in_thousandths.rms)


def limit(kind: str, n: int) -> float:
    """Errors fall with n, by less than in proportion to it."""
    return AT_10_000[kind] * (10_000 / n) ** 0.75


def kinds(body: ExactBody) -> list[list[str]]:
    return [[wall.kind for wall in run.walls] for run in body.model.stack.runs]


def step_of(body: ExactBody) -> bytes:
    return step_bytes(Model((NamedSolid(body.name, body.solid),)), lambda: ())


def assert_same(one: ExactBody, other: ExactBody, scale: float = 1.0, tolerance: float = 1e-6) -> None:
    """Same walls and breaks, in units of their own, and the same faces."""
    assert kinds(other) == kinds(one)
    assert other.facts.faces == one.facts.faces
    assert other.scale / scale == pytest.approx(one.scale, rel=tolerance)
    assert other.model.stack.breaks == pytest.approx(one.model.stack.breaks, abs=tolerance)
    assert other.model.vector == pytest.approx(one.model.vector, abs=tolerance)
    assert other.facts.volume / scale**3 == pytest.approx(one.facts.volume, rel=tolerance)
    assert other.facts.area / scale**2 == pytest.approx(one.facts.area, rel=tolerance)


# What a designer would draw


@pytest.mark.parametrize("name", FACES)
def test_faces_are_those_that_a_designer_would_draw(name: str) -> None:
    body = model(name)
    assert body.facts.faces == FACES[name]
    assert kinds(body) == KINDS.get(name, kinds(body))
    assert body.facts.volume == pytest.approx(goal_mesh(name).volume, rel=0.01)
    assert body.facts.volume == pytest.approx(stack_volume(body.model.stack) * body.scale**3, rel=1e-6)


@pytest.mark.parametrize("name", FACES)
def test_walls_are_where_they_belong(name: str) -> None:
    assert rms(model(name)) < limit("uniform", N)


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape", "stepped-shaft"])
def test_noise_and_strays_do_not_move_walls(name: str) -> None:
    body = model(name, fill=NOISY)
    assert body.facts.faces == FACES[name]
    assert rms(body) < limit("noisy", N)
    assert body.model.sigma * body.scale == pytest.approx(0.005 * goal_mesh(name).size, rel=0.2)


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape"])
@pytest.mark.parametrize(("n", "seeds"), [(2000, 3), (10_000, 2), (50_000, 1)])
def test_errors_fall_with_the_number_of_points(name: str, n: int, seeds: int) -> None:
    if name == "lamp" and n < 5000:
        pytest.skip("its stand holds some hundred points then: too few for a section")
    for seed in range(1, seeds + 1):
        body = model(name, n, seed=seed)
        assert body.facts.faces == FACES[name]
        assert rms(body) < limit("uniform", n)


def test_known_dimensions_come_out() -> None:
    body = model("lamp")
    base, stand, shade = (run.walls[0] for run in body.model.stack.runs)
    assert base.vector[2] * body.scale == pytest.approx(5, abs=0.02)
    assert sorted(stand.vector[2:4] * body.scale) == pytest.approx([1.5, 2], abs=0.02)
    assert shade.vector[3] == pytest.approx(-0.5, abs=0.01)
    assert np.diff(body.model.stack.breaks) * body.scale == pytest.approx([1.5, 10.5, 6], abs=0.03)


# Free sections


@pytest.mark.parametrize(("tips", "height"), [(5, 0.8), (6, 0.5)])
def test_a_wavy_outline_has_poles_where_it_needs_them(tips: int, height: float) -> None:
    def radius(xy: Floats) -> Floats:
        return 3 + height * np.cos(tips * np.arctan2(xy[:, 1], xy[:, 0]))

    box = np.random.default_rng(9).uniform([-4, -4, 0], [4, 4, 4], (6 * N, 3))
    body = built(box[np.hypot(*box[:, :2].T) < radius(box)][:N])
    assert kinds(body) == [["spline"]]
    assert body.facts.faces == {"SurfaceOfLinearExtrusion": 1, "Plane": 2}
    around = tessellate(body.solid, 5e-5, 0.1).vertices[:, :2]
    assert np.sqrt(np.mean((np.hypot(*around.T) - radius(around)) ** 2)) < 0.03


# Sections that change


def test_a_square_that_becomes_round_is_one_ruled_wall() -> None:
    square = RegularPolygon(np.zeros(2), 4.0, 0.3, 4)
    rounded = LineArc(
        RegularPolygon(np.zeros(2), 2.0, 0.3, 4).chain()[0], np.full(4, np.tan(np.pi / 8)), np.ones(4, bool)
    )
    wall = Ruled(square, rounded, 0.0, 8.0)
    box = np.random.default_rng(7).uniform([-4, -4, 0], [4, 4, 8], (6 * N, 3))
    body = built(box[wall.foot(box).distance < 0][:N])
    assert kinds(body) == [["ruled"]]
    assert body.facts.faces == {"BSplineSurface": 4, "Plane": 2}
    solid = Stack(np.array([0.0, 8.0]), (Run((wall,)),))
    assert body.facts.volume == pytest.approx(stack_volume(solid), rel=0.01)
    corners = np.linalg.norm(tessellate(body.solid, 5e-5, 0.1).vertices[:, :2], axis=1)
    assert corners.max() == pytest.approx(4.0, abs=0.02)


def test_a_rounded_box_has_its_fillets() -> None:
    outline = RoundedRectangle(np.zeros(2), 6.0, 4.0, 0.2, 0.8)
    wall = Filleted(outline, None, "both", 0.0, 5.0)
    box = np.random.default_rng(8).uniform([-4, -4, 0], [4, 4, 5], (6 * N, 3))
    body = built(box[wall.foot(box).distance < 0][:N])
    assert kinds(body) == [["filleted prism"]]
    assert body.facts.faces == {"CylindricalSurface": 12, "Plane": 6, "SphericalSurface": 8}
    found = body.model.stack.runs[0].walls[0]
    assert isinstance(found, Filleted)
    assert body.scale * found.radius == pytest.approx(0.8, abs=0.05)


# Sections with holes, and sections that split


def test_a_tube_keeps_its_hole() -> None:
    points = np.random.default_rng(5).uniform(-3, 3, (6 * N, 3)) * [1, 1, 2]
    far = np.hypot(points[:, 0], points[:, 1])
    body = built(points[(far < 3) & (far > 1.5)][:N])
    assert Counter(body.facts.faces) == {"CylindricalSurface": 2, "Plane": 2}
    assert kinds(body) == [["cylinder", "cylinder"]]
    assert body.model.stack.runs[0].holes == 1
    assert body.facts.volume == pytest.approx(np.pi * (3**2 - 1.5**2) * 12, rel=0.01)


def test_a_funnel_as_thin_as_a_tenth_of_its_width_keeps_its_hole() -> None:
    points = np.random.default_rng(5).uniform([-4, -4, 0], [4, 4, 5], (16 * N, 3))
    far, rim = np.hypot(points[:, 0], points[:, 1]), 1.2 + 2.8 * points[:, 2] / 5
    body = built(points[(far < rim) & (far > rim - 0.5)][:N])
    assert body.facts.faces == {"ConicalSurface": 2, "Plane": 2}
    assert body.model.stack.runs[0].holes == 1
    assert body.facts.volume == pytest.approx(np.pi * 5 * 0.5 * (1.2 + 4 - 0.5), rel=0.02)


@SLOW
def test_a_drop_that_was_seen_as_one_is_no_ellipse_in_the_end() -> None:
    """At the noise that blurs the evidence it would be one."""
    rng = np.random.default_rng(1)
    points = rng.uniform([-3, -4.5, 0], [3, 2.3, 4], (80 * N, 3))
    x, y = points[:, :2].T
    angle = np.arctan2(y / 1.3, x)
    radius = 2.5 * (1 - 0.35 * np.sin(angle))
    inside = np.hypot(x, y / 1.3) < radius
    kept = rng.uniform(size=len(points)) < 1 / 6 + 5 / 6 * (y + 4.5) / 6.8  # six times as many at one end
    body = built(points[inside & kept][: 2 * N])
    assert kinds(body) != [["ellipse"]]
    assert body.facts.volume == pytest.approx(4 * 1.3 * np.pi * 2.5**2 * (1 + 0.35**2 / 2), rel=0.005)


@pytest.mark.parametrize("fill", [FillParams(), NOISY], ids=["even", "noisy"])
def test_a_ring_is_one_torus(fill: FillParams) -> None:
    rng = np.random.default_rng(8)
    box = rng.uniform([-7, -7, -2], [7, 7, 2], (20 * N, 3))
    points = box[(np.hypot(*box[:, :2].T) - 5) ** 2 + box[:, 2] ** 2 < 1.5**2][: 2 * N]
    points = points + 18.6 * fill.jitter * rng.standard_normal(points.shape)
    body = built(points @ TURN + [1e3, 0, 0], axis="auto")
    assert body.facts.faces == {"ToroidalSurface": 1}
    assert body.facts.volume == pytest.approx(2 * np.pi**2 * 5 * 1.5**2, rel=0.02)
    assert abs(float(body.vector @ TURN[2])) > np.cos(np.radians(0.3))


def test_a_u_on_its_side_splits_in_two_legs() -> None:
    points = np.random.default_rng(6).uniform([-5, -1.5, 0], [5, 1.5, 8], (4 * N, 3))
    body = built(points[(points[:, 2] < 3) | (np.abs(points[:, 0]) > 2)][:N])
    assert body.facts.faces == {"Plane": 10}
    assert kinds(body) == [["polygon"], ["polygon", "polygon"]]
    assert body.facts.volume == pytest.approx(3 * (10 * 3 + 2 * 3 * 5), rel=0.01)


# The axioms


def test_the_same_cloud_gives_the_same_bytes() -> None:
    again = built(cloud("three-spheres"), name="three-spheres")
    assert step_of(again) == step_of(model("three-spheres"))


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape"])
def test_the_order_of_the_points_does_not_matter(name: str) -> None:
    shuffled = np.random.default_rng(0).permutation(cloud(name))
    assert_same(model(name), built(shuffled))


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape"])
@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_the_unit_does_not_matter(name: str, scale: float) -> None:
    assert_same(model(name), built(scale * cloud(name)), scale)


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape"])
def test_the_origin_does_not_matter(name: str) -> None:
    size = goal_mesh(name).size
    shift = 1e4 * size * np.array([1.0, -1, 1]) / np.sqrt(3)
    body = built(cloud(name) + shift)
    assert_same(model(name), body)
    middle, expected = body.facts.bounds.mean(axis=0), model(name).facts.bounds.mean(axis=0)
    assert middle - shift == pytest.approx(expected, abs=1e-6 * size)


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape", "stepped-shaft"])
def test_a_turned_cloud_with_its_axis_turned_along(name: str) -> None:
    x, y, z = TURN[:, 2].tolist()
    body = built(cloud(name) @ TURN.T, (x, y, z))
    assert body.facts.faces == FACES[name]
    assert body.facts.volume == pytest.approx(model(name).facts.volume, rel=1e-3)
    assert body.facts.area == pytest.approx(model(name).facts.area, rel=1e-3)
    assert body.frame.direction == pytest.approx(TURN[:, 2], abs=1e-12)


@SLOW
@pytest.mark.parametrize("name", ["three-spheres", "lamp", "l-shape", "stepped-shaft"])
def test_the_direction_of_a_turned_and_shifted_cloud_is_found(name: str) -> None:
    body = built(cloud(name) @ TURN.T + 1e4, "auto")
    assert body.facts.faces == FACES[name]
    assert body.facts.volume == pytest.approx(goal_mesh(name).volume, rel=0.01)
    assert abs(float(body.frame.direction @ TURN[:, 2])) > np.cos(np.radians(0.5))
    assert body.candidates
