"""The 3D alpha shape, the octree, and the comparison of slice-and-loft with them."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.image import imread
from scipy import ndimage
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from meshes import block, sphere
from sketchloft.alpha_shape import alpha_complex
from sketchloft.cloud import Floats, PointCloud
from sketchloft.compare import (
    METHODS,
    Comparison,
    ComparisonParams,
    LoftedModel,
    Row,
    compare,
    parse_radii,
    slice_and_loft,
)
from sketchloft.compare.alpha_mesh import alpha_shape_mesh
from sketchloft.compare.octree import Octree, octree_cells
from sketchloft.compare.octree_boundary import boundary_cells, octree_boundary
from sketchloft.compare.surface_facts import SurfaceFacts, surface_facts
from sketchloft.compare.void_cells import voids_inside
from sketchloft.direction import DirectionParams
from sketchloft.errors import CloudError, ModelError, OutputError, StageError, UsageError
from sketchloft.mesh import Mesh
from sketchloft.pipeline import Params
from sketchloft.report.camera import FRONT
from sketchloft.report.comparison import comparison_figure, draw_comparison
from sketchloft.sample import GOALS, sample_goal

BALL = 4 / 3 * math.pi
FEW = ComparisonParams(samples=1500)


def ball(n: int, seed: int = 0, hollow: float = 0.0) -> Floats:
    """Points in the unit ball, none within `hollow` of its centre."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(n, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return np.asarray(points * rng.uniform(hollow**3, 1, (n, 1)) ** (1 / 3))


def grid(n: int) -> Floats:
    """n * n * n points, 1 apart."""
    return np.stack(np.meshgrid(*[np.arange(float(n))] * 3), axis=-1).reshape(-1, 3)


def joined(*meshes: Mesh) -> Mesh:
    """Meshes as one; vertices at the same place become one."""
    corners = np.concatenate([mesh.corners for mesh in meshes]).reshape(-1, 3)
    vertices, index = np.unique(corners, axis=0, return_inverse=True)
    return Mesh(vertices, index.reshape(-1, 3))


# --- surface facts


@pytest.mark.parametrize(
    ("mesh", "facts"),
    [
        (block(1, 2, 3), SurfaceFacts(True, True, 1)),
        (sphere(level=2), SurfaceFacts(True, True, 1)),
        (joined(block(1, 1, 1), block(1, 1, 1, (2, 0, 0))), SurfaceFacts(True, True, 2)),
        (joined(block(1, 1, 1), block(1, 1, 1, (1, 1, 1))), SurfaceFacts(True, False, 2)),  # one corner
        (joined(block(1, 1, 1), block(1, 1, 1, (1, 1, 0))), SurfaceFacts(True, False, 1)),  # one edge
        (Mesh(block(1, 1, 1).vertices, block(1, 1, 1).triangles[1:]), SurfaceFacts(False, False, 1)),
    ],
)
def test_surface_facts(mesh: Mesh, facts: SurfaceFacts) -> None:
    assert surface_facts(mesh.triangles) == facts


def test_a_triangle_that_faces_the_other_way_leaves_the_surface_open() -> None:
    triangles = block(1, 1, 1).triangles.copy()
    triangles[0] = triangles[0, ::-1]
    assert not surface_facts(triangles).closed


# --- 3D alpha shape


def test_alpha_shape_of_a_ball_has_its_volume() -> None:
    shape = alpha_complex(ball(8000))
    for radius in (0.25, 0.5):
        found = alpha_shape_mesh(shape, radius)
        assert found.mesh.volume == pytest.approx(BALL, rel=0.08)
        assert found.mesh.volume < BALL
        assert found.left_out == 0
        assert found.share > 0.99
        assert surface_facts(found.mesh.triangles) == SurfaceFacts(True, True, 1)


def test_infinite_probe_gives_the_convex_hull() -> None:
    points = ball(500) * [3, 1, 0.5]
    hull = ConvexHull(points)
    found = alpha_shape_mesh(alpha_complex(points), math.inf).mesh
    assert found.volume == pytest.approx(hull.volume)
    assert found.areas.sum() == pytest.approx(hull.area)
    assert len(found.triangles) == len(hull.simplices)


def test_smaller_probes_enclose_less() -> None:
    shape = alpha_complex(ball(2000, seed=3))
    volumes = [alpha_shape_mesh(shape, radius).mesh.volume for radius in (0.15, 0.2, 0.3, 0.6, 2, math.inf)]
    assert volumes == sorted(volumes)
    assert volumes[0] < 0.9 * volumes[-1]


def test_cavity_is_kept_as_a_shell_of_its_own() -> None:
    found = alpha_shape_mesh(alpha_complex(ball(8000, hollow=0.6)), 0.3).mesh
    assert surface_facts(found.triangles).shells == 2
    assert found.volume == pytest.approx(BALL * (1 - 0.6**3), rel=0.08)


def test_only_the_largest_piece() -> None:
    points = np.concatenate([ball(2000), 0.5 * ball(500) + [5, 0, 0]])
    found = alpha_shape_mesh(alpha_complex(points), 0.4)
    assert found.left_out == 1
    assert found.share == pytest.approx(0.8)
    assert np.linalg.norm(found.mesh.vertices, axis=1).max() <= 1


def test_grid_has_no_slits() -> None:
    """Many points on one ball make flat simplices, whose own radius says nothing."""
    turned = Rotation.from_rotvec([0.3, 0.5, -0.2]).apply(grid(6))
    for points in (grid(6), turned, turned.astype(np.float32).astype(float)):
        for radius in (0.9, math.inf):
            found = alpha_shape_mesh(alpha_complex(points), radius).mesh
            assert found.volume == pytest.approx(125)
            assert surface_facts(found.triangles) == SurfaceFacts(True, True, 1)


def test_probe_so_small_that_nothing_stays() -> None:
    with pytest.raises(StageError, match=r"radius 1e-06 leaves nothing of the 300 points; use .* 0\.\d+ say"):
        alpha_shape_mesh(alpha_complex(ball(300)), 1e-6)


# --- octree


def test_octree_of_a_dense_box() -> None:
    octree = octree_cells(grid(32), 3)
    assert len(octree.cells) == 8**3
    assert (octree.counts == 4**3).all()
    assert octree.edge == pytest.approx(31 / 8)
    assert octree.origin == pytest.approx([0, 0, 0])
    assert boundary_cells(octree).sum() == 8**3 - 6**3
    assert voids_inside(octree) == 0
    boundary = octree_boundary(octree)
    assert len(boundary.triangles) == 2 * 6 * 8**2
    assert boundary.volume == pytest.approx(31**3)
    assert surface_facts(boundary.triangles) == SurfaceFacts(True, True, 1)


def test_sparse_cloud_has_voids_inside() -> None:
    """The fault for which the paper dropped the octree."""
    dense, sparse = ball(50_000), ball(4000)
    assert voids_inside(octree_cells(dense, 4)) == 0
    octree = octree_cells(sparse, 4)
    assert voids_inside(octree) > 20
    assert surface_facts(octree_boundary(octree).triangles).shells > 5


def test_low_density_in_one_half_alone_brings_voids() -> None:
    points = np.random.default_rng(1).random((40_000, 3))
    thinned = np.concatenate([points[points[:, 0] < 0.5], points[points[:, 0] >= 0.5][::5]])
    even, uneven = octree_cells(points, 4), octree_cells(thinned, 4)
    assert voids_inside(even) <= 1  # expected: 4096 exp(-9.8) = 0.2
    assert voids_inside(uneven) > 100


def test_voids_by_hand() -> None:
    cells = np.argwhere(np.ones((5, 5, 5)))
    solid = Octree(np.zeros(3), 1.0, 3, cells, np.ones(len(cells), dtype=np.intp))

    def without(*places: tuple[int, int, int]) -> Octree:
        kept = ~(cells[:, None] == np.array(places)).all(axis=2).any(axis=1)
        return dataclasses.replace(solid, cells=cells[kept], counts=solid.counts[kept])

    assert voids_inside(solid) == 0
    assert voids_inside(without((2, 2, 2))) == 1
    assert voids_inside(without((1, 2, 2), (2, 2, 2), (3, 2, 2), (3, 3, 2))) == 4
    assert voids_inside(without((1, 1, 1), (3, 3, 3))) == 2
    assert voids_inside(without((0, 2, 2), (1, 2, 2), (2, 2, 2), (2, 2, 3))) == 0  # open at one side
    assert voids_inside(without((0, 2, 2), (1, 3, 2))) == 1  # across an edge there is no way


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), n=st.integers(20, 2500), depth=st.integers(1, 5))
def test_octree_against_a_dense_array(seed: int, n: int, depth: int) -> None:
    rng = np.random.default_rng(seed)
    octree = octree_cells(rng.random((n, 3)) * rng.uniform(0.3, 1, 3), depth)
    full = np.zeros((2**depth + 2,) * 3, dtype=bool)
    full[tuple(octree.cells.T + 1)] = True
    void, _ = ndimage.label(~full)
    assert voids_inside(octree) == np.count_nonzero(void[~full] != void[0, 0, 0])
    assert boundary_cells(octree).sum() == full.sum() - ndimage.binary_erosion(full).sum()
    assert octree.counts.sum() == n
    boundary = octree_boundary(octree)
    assert surface_facts(boundary.triangles).closed
    assert boundary.volume == pytest.approx(full.sum() * octree.edge**3)


@pytest.mark.parametrize("n", [500, 3000, 20_000, 100_000])
def test_depth_follows_the_number_of_points(n: int) -> None:
    octree = octree_cells(ball(n))
    assert 6 / math.sqrt(8) < octree.counts.mean() < 6 * math.sqrt(8)


def test_a_point_far_away_does_not_cost_memory() -> None:
    points = np.concatenate([ball(3000), [[5e3, 0, 0]]])
    octree = octree_cells(points)
    assert octree.depth > 12
    assert octree.counts.mean() > 2
    assert len(octree_boundary(octree).triangles) < 12 * len(octree.cells)
    assert voids_inside(octree) < len(octree.cells)


def test_octree_follows_shuffled_scaled_and_shifted_points() -> None:
    points = ball(3000).round(6)
    plain = octree_cells(points)
    for factor, shift in ((1.0, 0.0), (4.0, 0.0), (1.0, 64.0)):
        moved = octree_cells(np.random.default_rng(2).permutation(factor * points + shift))
        assert np.array_equal(moved.cells, plain.cells)
        assert np.array_equal(moved.counts, plain.counts)
        assert moved.edge == pytest.approx(factor * plain.edge)


def test_octree_says_what_is_wrong() -> None:
    with pytest.raises(CloudError, match="5 equal points"):
        octree_cells(np.ones((5, 3)))
    for depth in (0, 21):
        with pytest.raises(UsageError, match=f"found {depth}, expected 1 to 20"):
            octree_cells(grid(3), depth)


# --- comparison


def round_loft(radius: float) -> LoftedModel:
    """Stands for the pipeline: a ball, and nothing if the probe is small."""
    if radius < 0.1:
        raise StageError("nothing is left", stage="edge points", slice_index=3)
    return LoftedModel(sphere(level=4), 3)


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    return compare(
        PointCloud.of(ball(3000)), (0.01, 0.4, math.inf), round_loft, goal=sphere(level=4), params=FEW
    )


def test_table(comparison: Comparison) -> None:
    assert [(row.method, row.probe_radius) for row in comparison.rows] == [
        *((METHODS[0], radius) for radius in (0.01, 0.4, math.inf)),
        *((METHODS[1], radius) for radius in (0.01, 0.4, math.inf)),
        ("octree", None),
    ]
    for row, mesh in zip(comparison.rows, comparison.meshes, strict=True):
        assert row.seconds > 0
        if row.probe_radius == 0.01:
            continue
        assert mesh is not None
        assert row.surface is not None
        assert row.surface.closed
        assert row.triangles == len(mesh.triangles)
        assert row.volume == pytest.approx(mesh.volume)
        assert (row.voids_inside is None) == (row.method != "octree")
    lofted, hull, octree = (comparison.rows[i] for i in (1, 5, 6))
    assert lofted.faces == 3
    assert lofted.rms_thousandths == pytest.approx(0, abs=1e-6)
    assert lofted.volume_error == pytest.approx(0, abs=1e-9)
    assert hull.errors is not None
    assert hull.missed is not None
    assert hull.errors.mean < 0 < hull.missed.mean  # a hull lies within a ball, so the ball sticks out
    assert hull.faces == hull.triangles
    assert octree.faces is not None
    assert octree.triangles == 2 * octree.faces
    assert octree.remark.startswith("depth 3, ")


def test_radius_that_leaves_nothing_is_a_row_too(comparison: Comparison) -> None:
    for i, why in ((0, "edge points, slice 3: nothing is left"), (3, "leaves nothing of the 3000 points")):
        row = comparison.rows[i]
        assert why in row.remark
        assert comparison.meshes[i] is None
        empty = Row(row.method, 0.01, row.seconds, row.remark)
        assert row == empty


def test_table_as_json(comparison: Comparison) -> None:
    table = json.loads(json.dumps(comparison.summary, allow_nan=False))
    assert table["points"] == 3000
    assert [row["probe_radius"] for row in table["rows"]] == [0.01, 0.4, "inf", 0.01, 0.4, "inf", None]
    assert table["rows"][4]["surface"] == {"closed": True, "manifold": True, "shells": 1}
    assert table["rows"][4]["errors"]["rms"] > 0
    assert table["rows"][0]["volume"] is None


def test_without_a_goal() -> None:
    found = compare(PointCloud.of(ball(300)), [1], round_loft, params=FEW)
    assert found.goal is None
    assert found.summary["goal"] is None
    assert all(row.errors is None and row.missed is None for row in found.rows)
    assert all(row.volume is not None and row.volume > 2 for row in found.rows)


def test_a_model_that_is_not_closed_is_shown_but_not_measured() -> None:
    half = Mesh(sphere(level=2).vertices, sphere(level=2).triangles[::2])
    found = compare(
        PointCloud.of(ball(300)), [1], lambda _: LoftedModel(half, 1), goal=sphere(level=3), params=FEW
    )
    row = found.rows[0]
    assert row.errors is None
    assert row.surface is not None
    assert not row.surface.closed
    assert row.remark.startswith("model: its mesh is not closed")
    assert found.meshes[0] is half


def figures(comparison: Comparison) -> Floats:
    return np.array(
        [(row.faces, row.volume, row.rms_thousandths) for row in comparison.rows if row.faces is not None]
    )


def test_shuffled_and_shifted_cloud_gives_the_same_table(comparison: Comparison) -> None:
    assert comparison.goal is not None
    shift = np.array([100.0, -50, 7])
    points = np.random.default_rng(5).permutation(ball(3000)) + shift

    def loft(radius: float) -> LoftedModel:
        model = round_loft(radius)
        return LoftedModel(Mesh(model.mesh.vertices + shift, model.mesh.triangles), model.faces)

    goal = Mesh(comparison.goal.vertices + shift, comparison.goal.triangles)
    moved = compare(PointCloud.of(points), comparison.radii, loft, goal=goal, params=FEW)
    assert figures(moved) == pytest.approx(figures(comparison), rel=1e-6, abs=1e-9)
    shuffled = PointCloud.of(points[::-1])
    again = compare(shuffled, comparison.radii, loft, goal=goal, params=FEW)
    assert np.array_equal(figures(again), figures(moved))


def test_what_is_wrong_with_the_question_is_an_error() -> None:
    cloud = PointCloud.of(ball(300))
    with pytest.raises(UsageError, match="at least one, all positive or inf"):
        compare(cloud, [], round_loft)
    with pytest.raises(UsageError, match=r"found \[0.5, nan\]"):
        compare(cloud, [0.5, math.nan], round_loft)
    with pytest.raises(ModelError, match="goal: its mesh is not closed"):
        compare(cloud, [1], round_loft, goal=Mesh(sphere().vertices, sphere().triangles[1:]))
    with pytest.raises(CloudError, match="need at least 60"):
        compare(PointCloud.of(ball(30)), [1], round_loft)
    with pytest.raises(UsageError, match="octree depth"):
        compare(cloud, [1], round_loft, params=ComparisonParams(octree_depth=99))


def test_progress_names_method_and_radius() -> None:
    said: list[str] = []
    compare(PointCloud.of(ball(300)), [0.5, math.inf], round_loft, progress=said.append)
    assert said == [
        "slice and loft, probe radius 0.5",
        "slice and loft, probe radius inf",
        "3D alpha shape, probe radius 0.5",
        "3D alpha shape, probe radius inf",
        "octree",
    ]


def test_slice_and_loft_is_the_papers_method_whatever_is_asked_for() -> None:
    cloud = sample_goal(GOALS["cylinder"], 1500, seed=1)
    along = DirectionParams((0, 0, 1))
    default, paper = (
        slice_and_loft(cloud, Params(method, direction=along))(1.5) for method in ("exact", "paper")
    )
    assert default.faces == paper.faces > 3
    assert np.array_equal(default.mesh.vertices, paper.mesh.vertices)
    assert default.mesh.volume == pytest.approx(32 * np.pi, rel=0.1)


def test_parse_radii() -> None:
    assert parse_radii("0.5, 1,inf") == (0.5, 1, math.inf)
    for text in ("", "0.5,,1", "auto", "0", "1,-2", "nan"):
        with pytest.raises(UsageError, match="radii: found"):
            parse_radii(text)


# --- picture


@pytest.fixture
def _coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sketchloft.report.comparison.PIXELS", 120)


@pytest.mark.usefixtures("_coarse")
def test_picture(comparison: Comparison, tmp_path: Path) -> None:
    draw_comparison(comparison, tmp_path / "one.png", title="ball")
    draw_comparison(comparison, tmp_path / "two.png", title="ball")
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()
    picture = imread(tmp_path / "one.png")[..., :3]
    assert picture.shape[1] > 1000
    blue, sand, green = (
        np.count_nonzero((np.argmax(picture, axis=2) == channel) & (np.ptp(picture, axis=2) > 0.1))
        for channel in (2, 0, 1)
    )
    assert min(blue, sand, green) > 5000
    with pytest.raises(OutputError, match=r"choose \.png"):
        draw_comparison(comparison, tmp_path / "one.svg")


@pytest.mark.usefixtures("_coarse")
def test_words_in_the_picture(comparison: Comparison) -> None:
    figure = comparison_figure(comparison, unit="cm", title="ball", camera=FRONT)
    words = [text.get_text() for ax in figure.get_axes() for text in (ax.title, *ax.texts)]
    words += [text.get_text() for text in figure.texts]
    for expected in ("slice and loft", "3D alpha shape", "octree", "cloud", "goal", "3,000 points"):
        assert words.count(expected) == 1
    assert words.count("no model") == 2
    assert words.count("probe radius 0.4 cm") == 1
    assert words.count("probe radius ∞") == 1
    row = comparison.rows[4]
    assert row.errors is not None
    assert any(word.startswith(f"rms {row.errors.rms:#.3g} cm") for word in words)
    scales = {(*ax.get_xlim(), *ax.get_ylim()) for ax in figure.get_axes() if ax.images}
    assert len(scales) == 1


@pytest.mark.usefixtures("_coarse")
@pytest.mark.parametrize("radii", [[1], [0.5, 0.6, 0.7, 0.8, 1]])
def test_any_number_of_columns_with_or_without_goal(radii: list[float]) -> None:
    found = compare(PointCloud.of(ball(300)), radii, round_loft)
    figure = comparison_figure(found, unit="mm", title="", camera=FRONT)
    assert sum(bool(ax.images) for ax in figure.get_axes()) == 2 * len(radii) + 1
