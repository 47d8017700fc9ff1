import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from sketchloft.alpha_shape import alpha_complex
from sketchloft.outer_contour import outer_contour
from sketchloft.ring import ring_area, ring_centre, ring_depth, ring_hull, ring_is_simple, ring_length

TRIANGLE = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]])


def wavy(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.random(30)) * 2 * np.pi
    return (1 + 0.5 * rng.random(30))[:, None] * np.c_[np.cos(angle), np.sin(angle)]


def test_a_triangle() -> None:
    assert ring_area(TRIANGLE) == 6
    assert ring_area(TRIANGLE[::-1]) == -6
    assert ring_length(TRIANGLE) == 12
    assert ring_centre(TRIANGLE) == pytest.approx([4 / 3, 1])
    assert ring_depth(np.array([[1.0, 1.0], [5.0, 0.0]]), TRIANGLE) == pytest.approx([1, -1])


@given(st.integers(0, 1000))
def test_depth_and_centre_are_those_of_shapely(seed: int) -> None:
    ring = wavy(seed)
    polygon = shapely.Polygon(ring)
    points = np.random.default_rng(seed + 1).uniform(-2, 2, (200, 2))
    far = shapely.distance(polygon.exterior, shapely.points(points))
    inside = shapely.contains_xy(polygon, points)
    assert ring_depth(points, ring) == pytest.approx(np.where(inside, far, -far), abs=1e-12)
    assert ring_centre(ring) == pytest.approx(np.array(polygon.centroid.coords[0]))


@given(st.integers(0, 1000))
def test_the_hull_of_a_ring_holds_it_and_keeps_its_turn(seed: int) -> None:
    ring = wavy(seed)
    hull = ring_hull(ring)
    assert ring_area(hull) == pytest.approx(shapely.Polygon(ring).convex_hull.area)
    assert {tuple(p) for p in hull} <= {tuple(p) for p in ring}
    assert ring_depth(ring, hull).min() > -1e-12


def test_a_ring_that_crosses_itself_is_not_simple() -> None:
    assert ring_is_simple(TRIANGLE)
    assert not ring_is_simple(np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]))


def test_the_outer_contour_leaves_holes_and_islands_out() -> None:
    rng = np.random.default_rng(0)
    points = rng.uniform(-1, 1, (4000, 2))
    ring = points[np.linalg.norm(points, axis=1) > 0.5]
    island = rng.uniform(-0.2, 0.2, (200, 2)) + [3, 0]
    found = outer_contour(alpha_complex(np.r_[ring, island]), 0.15)
    assert found is not None
    assert found.left_out == 2
    assert found.area == pytest.approx(4, rel=0.03)
    assert found.filled == pytest.approx(1 - np.pi / 16, abs=0.02)
    assert found.share == pytest.approx(len(ring) / (len(ring) + 200), abs=0.002)
    assert ring_is_simple(found.points)


def test_a_contour_that_touches_itself_is_cut_to_a_simple_ring() -> None:
    # Two rows of triangles that share a corner only through a third part.
    rng = np.random.default_rng(5)
    for seed in range(20):
        points = rng.random((40, 2)) if seed else rng.random((25, 2))
        found = outer_contour(alpha_complex(points), 0.16)
        if found is not None:
            assert ring_is_simple(found.points)
            assert found.area > 0


def test_nothing_stays_where_the_probe_fits_through_everywhere() -> None:
    assert outer_contour(alpha_complex(np.random.default_rng(0).random((50, 2))), 1e-6) is None
