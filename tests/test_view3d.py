"""Pictures of meshes, points and lines in space."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.image import AxesImage

from meshes import block, soup, sphere
from sketchloft.errors import UsageError
from sketchloft.mesh import Mesh
from sketchloft.report.camera import ABOVE, FRONT, SIDE, Camera, axes, project
from sketchloft.report.normals import corner_normals
from sketchloft.report.occlusion import occlusion
from sketchloft.report.picture import new_figure
from sketchloft.report.raster import rasterise
from sketchloft.report.shading import barycentric
from sketchloft.report.view3d import draw_lines, draw_mesh, draw_points


def picture_of(mesh: Mesh, camera: Camera = FRONT, **options: object) -> np.ndarray:
    """(h, w, 4) pixels, the first row the lowest."""
    ax = new_figure(3, 3).subplots()
    draw_mesh(ax, mesh, camera, pixels=100, **options)  # type: ignore[arg-type]
    image = ax.images[0]
    assert isinstance(image, AxesImage)
    return np.asarray(image.get_array())


def test_camera_axes_are_a_right_handed_frame() -> None:
    frame = axes(Camera((1.0, 2.0, 3.0), (0.0, 1.0, 1.0)))
    assert frame @ frame.T == pytest.approx(np.eye(3))
    assert np.linalg.det(frame) == pytest.approx(1)
    assert frame[2] == pytest.approx(np.array([1, 2, 3]) / np.sqrt(14))


def test_named_views() -> None:
    at = np.array([1.0, 2.0, 3.0])
    assert project(SIDE, at) == pytest.approx([1, 3, -2])
    assert project(ABOVE, at) == pytest.approx([1, 2, 3])
    with pytest.raises(UsageError, match="another up"):
        axes(Camera((0.0, 0.0, 2.0)))


def test_raster_sees_the_nearest() -> None:
    near, far = np.array([[2, 2, 5], [8, 2, 5], [2, 8, 5.0]]), np.array([[0, 0, 1], [20, 0, 1], [0, 20, 1.0]])
    for stack in ([near, far], [far, near]):
        found = rasterise(np.array(stack), 12, 12)
        assert found.depth[3, 3] == 5
        assert found.depth[1, 1] == pytest.approx(1)
        assert np.array_equal(found.triangle[3, 3] == found.triangle[1, 1], False)
    assert rasterise(near[None], 12, 12).triangle[10, 10] == -1


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000))
def test_raster_leaves_no_gap_and_keeps_the_plane(seed: int) -> None:
    """A square cut into triangles at random corners covers every pixel, at the depth of its plane."""
    rng = np.random.default_rng(seed)
    inner, tilt = rng.uniform(0, 40, 2), rng.normal(size=2)
    flat = np.array([[0, 0], [40, 0], [40, 40], [0, 40], inner])
    corners = np.column_stack([flat, flat @ tilt])[[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]]
    found = rasterise(corners, 40, 40)
    assert (found.triangle >= 0).all()
    middles = np.stack(np.meshgrid(np.arange(40), np.arange(40)), axis=2) + 0.5
    assert found.depth == pytest.approx(middles @ tilt, abs=1e-3)
    weights = barycentric(found, corners)
    back = np.einsum("kc,kcd->kd", weights, corners[found.triangle.ravel()])
    assert back[:, :2] == pytest.approx(middles.reshape(-1, 2), abs=1e-3)


def test_raster_in_many_chunks_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    corners = np.random.default_rng(1).uniform(-5, 45, (200, 3, 3))
    whole = rasterise(corners, 40, 40)
    monkeypatch.setattr("sketchloft.report.raster.CHUNK", 50)
    parts = rasterise(corners, 40, 40)
    assert np.array_equal(whole.triangle, parts.triangle)
    assert np.array_equal(whole.depth, parts.depth)


def test_normals_are_smooth_on_a_sphere_and_sharp_on_a_box() -> None:
    ball = sphere(level=4)
    assert corner_normals(ball) == pytest.approx(ball.corners, abs=0.01)
    box = corner_normals(block(1, 2, 3))
    assert np.sort(np.abs(box), axis=2) == pytest.approx(np.tile([0, 0, 1], (12, 3, 1)))
    assert box[:, 0] == pytest.approx(box[:, 2])


def test_occlusion_darkens_the_foot_of_a_step_only() -> None:
    """A plane, and a wall that stands up on it towards the eye."""
    depth = np.zeros((100, 100))
    depth[:, 60:] = 4
    up = np.broadcast_to([0.0, 0.0, 1.0], (100, 100, 3))
    hidden = occlusion(depth, up)[50]
    assert hidden[58] > 0.1
    assert hidden[:40].max() < 0.01
    assert hidden[70:].max() < 0.01
    assert occlusion(np.full((20, 20), -np.inf), up[:20, :20]).max() < 0.01


def test_mesh_covers_its_shadow_and_nothing_else() -> None:
    picture = picture_of(sphere())
    covered = picture[..., 3].sum()
    radius = (picture.shape[1] - 4) / 2  # two empty pixels around
    assert covered == pytest.approx(np.pi * radius**2, rel=0.02)
    assert picture[0, 0, 3] == 0
    assert ((picture >= 0) & (picture <= 1)).all()


def test_light_comes_from_the_upper_left() -> None:
    picture = picture_of(sphere(), lines=0.0)
    n = len(picture)
    upper_left, lower_right = picture[3 * n // 4, n // 4, :3], picture[n // 4, 3 * n // 4, :3]
    assert (upper_left > 1.2 * lower_right).all()


def test_separate_corners_look_the_same() -> None:
    assert picture_of(soup(sphere(level=3))) == pytest.approx(picture_of(sphere(level=3)), abs=1e-6)


def test_values_and_triangle_colours() -> None:
    cube = block(1, 1, 1)
    shown = picture_of(cube, values=cube.vertices[:, 2], cmap="gray", limits=(0, 1), camera=SIDE, lines=0)
    column = shown[10:90, 50, 0]
    assert np.diff(column).min() > 0
    sides = np.where(np.abs(cube.areas)[:, None] > 0, [1.0, 0.0, 0.0], 0.0)
    red = picture_of(cube, colour=sides, camera=SIDE)[50, 50]
    assert red[0] > 0.5 > 4 * red[1]


def test_opacity() -> None:
    assert picture_of(sphere(level=3), opacity=0.3)[..., 3].max() == pytest.approx(0.3)


def test_all_that_is_drawn_lies_within_the_limits() -> None:
    ax = new_figure(3, 3).subplots()
    draw_mesh(ax, block(1, 1, 1), SIDE, pixels=50)
    draw_points(ax, np.array([[5.0, 0, 0], [-3, 0, 0]]), SIDE)
    draw_lines(ax, [np.array([[0, 0, 0], [0, 0, 9.0], [1, 0, 9]])], SIDE)
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    assert -3.6 < left < -3
    assert 5 < right < 5.6
    assert -1 < bottom < 0
    assert 9 < top < 10
    assert ax.get_aspect() == 1


def test_nearer_points_are_drawn_last_and_stronger() -> None:
    ax = new_figure(3, 3).subplots()
    draw_points(ax, np.array([[0.0, -1, 0], [0.0, 1, 0], [0.0, 0, 0]]), SIDE, colour="black", haze=0.5)
    colours = np.asarray(ax.collections[0].get_facecolor())[:, 0]
    assert colours == pytest.approx([0.5, 0.25, 0])


def test_nothing_to_draw_draws_nothing() -> None:
    ax = new_figure(3, 3).subplots()
    draw_points(ax, np.empty((0, 3)), FRONT)
    draw_lines(ax, [], FRONT)
    assert not ax.collections
