"""The signed normal error of a model against a goal."""

from __future__ import annotations

import json
import math
from dataclasses import astuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from meshes import block, soup, sphere
from sketchloft.closed_mesh import closed_mesh, welded
from sketchloft.errors import ModelError, UsageError
from sketchloft.measurement import measure, vertex_errors
from sketchloft.mesh import Mesh
from sketchloft.signed_distance import signed_distance
from sketchloft.subdivide import subdivide

GOAL = sphere()


@pytest.mark.parametrize("radius", [1.01, 0.99])
def test_concentric_spheres(radius: float) -> None:
    off = radius - 1
    found = measure(sphere(radius), GOAL, n=3000)
    sizes = abs(off), off, abs(off), abs(off)  # rms, mean, p95, max
    assert astuple(found.errors) == pytest.approx(sizes, rel=0.002)
    assert found.back_errors.mean == pytest.approx(-off, rel=0.002)
    assert found.back_errors.rms == pytest.approx(abs(off), rel=0.002)
    assert found.volume_error == pytest.approx(radius**3 - 1)
    assert found.errors_in_thousandths.rms == pytest.approx(abs(off) * 1000 / GOAL.size, rel=0.002)
    assert found.back_errors_in_thousandths.mean == pytest.approx(-off * 1000 / GOAL.size, rel=0.002)


def test_a_model_against_itself_has_no_error() -> None:
    found = measure(GOAL, GOAL, n=2000)
    assert found.errors.max < 1e-12
    assert found.back_errors.max < 1e-12
    assert found.volume_error == 0


def test_box_that_is_too_long() -> None:
    """Only the end face, 1 of 6.4, is off by the whole excess."""
    found = measure(block(1.1, 1, 1), block(1, 1, 1), n=20_000)
    end = np.abs(found.points[:, 0] - 1.1) < 1e-9
    assert end.mean() == pytest.approx(1 / 6.4, abs=0.005)
    assert found.distances[end] == pytest.approx(0.1)
    assert found.errors.max == pytest.approx(0.1)
    assert found.distances.min() > -1e-9
    # The goal's own end lies within the model, as deep as the nearest of its five sides.
    goal_end = found.back_points[:, 0] > 1 - 1e-9
    to_side = 0.5 - np.abs(found.back_points[goal_end, 1:] - 0.5).max(axis=1)
    assert found.back_distances[goal_end] == pytest.approx(-np.minimum(0.1, to_side))
    assert found.volume_error == pytest.approx(0.1)


def test_what_the_model_misses_is_seen_on_the_way_back() -> None:
    whole = block(4, 1, 1)
    found = measure(block(2, 1, 1), whole, n=4000)
    assert found.errors.max == pytest.approx(0.5, rel=0.1)  # the cut face, deepest at its middle
    assert found.back_errors.max == pytest.approx(2, rel=0.01)
    assert found.back_errors.mean > 0


def test_distances_are_exact_at_any_depth() -> None:
    at = np.array([[0.5, 0.5, 0.5], [0.5, 0.5, 0.999], [0.5, 0.5, 1.001], [2, 0.5, 0.5], [2, 2, 2]])
    expected = [-0.5, -0.001, 0.001, 1, math.sqrt(3)]
    assert signed_distance(at, block(1, 1, 1)) == pytest.approx(expected, rel=1e-9)


@settings(max_examples=15, deadline=None)
@given(
    scale=st.floats(1e-3, 1e3),
    shift=st.tuples(*[st.floats(-100, 100)] * 3),
    turn=st.tuples(*[st.floats(-3, 3)] * 3),
)
def test_turned_shifted_and_scaled_together(
    scale: float, shift: tuple[float, float, float], turn: tuple[float, float, float]
) -> None:
    rotation = Rotation.from_rotvec(turn).as_matrix()

    def moved(mesh: Mesh) -> Mesh:
        return Mesh(scale * (mesh.vertices @ rotation.T + shift), mesh.triangles)

    model, goal = block(1.1, 1, 0.95), block(1, 1, 1, (0.01, 0.02, 0))
    plain, turned = measure(model, goal, n=500), measure(moved(model), moved(goal), n=500)
    for field in ("rms", "mean", "p95", "max"):
        for errors in ("errors", "back_errors"):
            expected = getattr(getattr(plain, errors), field)
            assert getattr(getattr(turned, errors), field) / scale == pytest.approx(
                expected, rel=0.1, abs=0.01
            )
    assert turned.volume_error == pytest.approx(plain.volume_error)


def test_same_seed_same_points_uniform_by_area() -> None:
    first, again, other = (measure(block(3, 1, 1), block(3, 1, 1), n=9000, seed=seed) for seed in (1, 1, 2))
    assert np.array_equal(first.points, again.points)
    assert not np.array_equal(first.points, other.points)
    ends = (np.abs(first.points[:, 0] - 1.5) > 1.5 - 1e-12).mean()
    assert ends == pytest.approx(2 / 14, abs=0.001)
    top = first.points[np.abs(first.points[:, 2] - 1) < 1e-12]
    counts, *_ = np.histogram2d(top[:, 0], top[:, 1], (6, 2), ((0, 3), (0, 1)))
    assert ((counts - counts.mean()) ** 2 / counts.mean()).sum() < 32  # chi squared, p = 0.0008


def test_summary_is_json() -> None:
    summary = json.loads(json.dumps(measure(sphere(1.01), GOAL, n=100).summary))
    assert summary["samples"] == 100
    assert summary["model_to_goal"]["mean"] == pytest.approx(0.01, rel=0.002)
    assert summary["thousandths"]["goal_to_model"]["rms"] == pytest.approx(10 / GOAL.size, rel=0.002)
    assert summary["volume_error"] == pytest.approx(1.01**3 - 1)


def test_triangles_with_their_own_corners_and_inside_out() -> None:
    inside_out = soup(Mesh(GOAL.vertices, GOAL.triangles[:, ::-1]))
    noisy = Mesh(
        inside_out.vertices + np.random.default_rng(0).normal(scale=1e-9, size=inside_out.vertices.shape),
        inside_out.triangles,
    )
    found = measure(soup(sphere(1.01)), noisy, n=500)
    assert found.errors.mean == pytest.approx(0.01, rel=0.002)
    assert found.goal.volume == pytest.approx(GOAL.volume)
    assert len(found.goal.vertices) == len(GOAL.vertices)


def test_welding_keeps_rows_and_drops_unused_vertices() -> None:
    mesh = Mesh(np.concatenate([soup(GOAL).vertices, [[9.0, 9.0, 9.0]]]), soup(GOAL).triangles)
    joined = welded(mesh)
    assert len(joined.vertices) == len(GOAL.vertices)
    assert joined.corners == pytest.approx(GOAL.corners)


@pytest.mark.parametrize(
    ("mesh", "words"),
    [
        (Mesh(GOAL.vertices, GOAL.triangles[1:]), "model: its mesh is not closed, 3 of"),
        (Mesh(GOAL.vertices, GOAL.triangles[:0]), "no triangle"),
        (Mesh(GOAL.vertices * np.nan, GOAL.triangles), "not finite"),
        (Mesh(GOAL.vertices * (1, 1, 0), GOAL.triangles), "encloses no volume"),
        (Mesh(GOAL.vertices, np.concatenate([GOAL.triangles[1:], GOAL.triangles[:1, ::-1]])), "not closed"),
    ],
)
def test_open_and_broken_meshes_are_refused(mesh: Mesh, words: str) -> None:
    with pytest.raises(ModelError, match=words):
        measure(mesh, GOAL)
    with pytest.raises(ModelError, match="goal: "):
        measure(GOAL, mesh)


def test_a_measurement_needs_points() -> None:
    with pytest.raises(UsageError, match="at least 1 point"):
        measure(GOAL, GOAL, n=0)


def test_two_bodies_and_a_cavity_are_closed() -> None:
    outer, inner = block(3, 3, 3), block(1, 1, 1, (1, 1, 1))
    hollow = Mesh(
        np.concatenate([outer.vertices, inner.vertices]),
        np.concatenate([outer.triangles, inner.triangles[:, ::-1] + len(outer.vertices)]),
    )
    assert closed_mesh(hollow, "model").volume == pytest.approx(26)
    assert signed_distance(np.array([[1.5, 1.5, 1.5], [0.5, 1.5, 1.5]]), hollow) == pytest.approx([0.5, -0.5])


@pytest.mark.parametrize("longest", [0.31, 0.07])
def test_subdivision_keeps_the_surface_closed(longest: float) -> None:
    long = block(4, 0.2, 1)
    fine = subdivide(long, longest)
    assert np.linalg.norm(np.diff(fine.corners[:, [0, 1, 2, 0]], axis=1), axis=2).max() <= longest
    assert closed_mesh(fine, "fine").volume == pytest.approx(long.volume)
    assert fine.areas.sum() == pytest.approx(long.areas.sum())
    assert np.array_equal(fine.vertices[:8], long.vertices)
    assert np.abs(signed_distance(fine.vertices, long)).max() < 1e-12
    assert subdivide(fine, longest) is fine


def test_vertex_errors_see_within_large_triangles() -> None:
    found = measure(block(1, 1, 1), sphere(2, (0.5, 0.5, 0.5)), n=100)
    mesh, errors = vertex_errors(found)
    assert len(mesh.vertices) > 5000
    expected = np.linalg.norm(mesh.vertices - 0.5, axis=1) - 2
    assert errors == pytest.approx(expected, abs=0.005)
    assert errors.min() == pytest.approx(-1.5, abs=0.005)
