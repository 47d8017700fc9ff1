import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull, QhullError

from sketchloft.alpha_shape import alpha_complex, boundary_facets, circumradii, components
from sketchloft.probe_radius import small_probe_radius


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_probe_of_infinite_radius_finds_the_convex_hull(dimension: int) -> None:
    points = np.random.default_rng(0).random((300, dimension))
    shape = alpha_complex(points)
    facets = boundary_facets(shape, shape.inside(np.inf))
    hull = ConvexHull(points)
    assert set(np.unique(facets)) == set(hull.vertices)
    assert shape.volumes.sum() == pytest.approx(hull.volume)


def test_facets_look_outwards_in_the_plane_and_in_space() -> None:
    rng = np.random.default_rng(1)
    flat = alpha_complex(rng.random((200, 2)))
    a, b = np.moveaxis(flat.points[boundary_facets(flat, flat.inside(0.2))], 1, 0)
    area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2
    assert area == pytest.approx(flat.volumes[flat.inside(0.2)].sum())
    solid = alpha_complex(rng.random((500, 3)))
    a, b, c = np.moveaxis(solid.points[boundary_facets(solid, solid.inside(0.3))], 1, 0)
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    assert volume == pytest.approx(solid.volumes[solid.inside(0.3)].sum())


def test_the_circumradius_of_known_simplices() -> None:
    right_angled = np.array([[[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]])
    assert circumradii(right_angled) == pytest.approx([2.5])
    corner = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]])
    assert circumradii(corner) == pytest.approx([np.sqrt(3) / 2])
    on_a_line = np.array([[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]])
    assert np.isinf(circumradii(on_a_line)).all()


def test_components_are_numbered_by_falling_volume() -> None:
    rng = np.random.default_rng(2)
    points = np.r_[rng.random((100, 2)) + [5, 0], 3 * rng.random((400, 2)) - [4, 0]]
    shape = alpha_complex(points)
    kept = shape.inside(0.5)
    label = components(shape, kept)
    assert label.max() == 1
    volumes = [shape.volumes[kept[label == i]].sum() for i in range(2)]
    assert volumes[0] > 4 * volumes[1]


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000), st.floats(1e-3, 1e3), st.floats(0, 6))
def test_the_alpha_shape_turns_and_scales_with_its_points(seed: int, scale: float, angle: float) -> None:
    points = np.random.default_rng(seed).random((60, 2))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    one, other = alpha_complex(points), alpha_complex(scale * points @ turn.T)
    finite = np.isfinite(one.radii)
    assert np.sort(one.radii[finite]) * scale == pytest.approx(np.sort(other.radii)[: finite.sum()], rel=1e-6)


def test_points_on_a_line_have_no_triangulation() -> None:
    with pytest.raises(QhullError):
        alpha_complex(np.outer(np.arange(10.0), [1.0, 2.0]))


@pytest.mark.parametrize(("dimension", "n"), [(2, 500), (2, 5000), (3, 3000)])
def test_the_small_probe_radius_seldom_falls_into_the_cloud(dimension: int, n: int) -> None:
    holes = 0
    for seed in range(5):
        shape = alpha_complex(np.random.default_rng(seed).random((n, dimension)))
        middle = np.abs(shape.points[shape.simplices].mean(axis=1) - 0.5).max(axis=1) < 0.35
        holes += int((shape.radii[middle] > small_probe_radius(shape)).sum())
    assert holes <= 2  # a tenth of a simplex each, on average


def test_the_small_probe_radius_goes_with_the_spacing() -> None:
    radii = [
        small_probe_radius(alpha_complex(np.random.default_rng(3).random((n, 2)))) for n in (400, 1600, 6400)
    ]
    assert radii[0] / radii[1] == pytest.approx(2, rel=0.15)
    assert radii[1] / radii[2] == pytest.approx(2, rel=0.15)
