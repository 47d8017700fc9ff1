from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from sketchloft.outline.candidates import spline_of
from sketchloft.outline.chain import chain_area, chain_boundary
from sketchloft.outline.chain_foot import chain_foot, seen_from_within
from sketchloft.outline.circle import Circle
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.fitted_loop import fitted_loop
from sketchloft.outline.outline import Arc, Boundary, Closed, Outline, Segment
from sketchloft.outline.pieces import line_arc_pieces
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rectilinear import RectilinearPolygon, rectilinear_of, with_a_step_less
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import SplineLoop, spline_loop
from sketchloft.outline.stadium import Stadium, stadium_like
from sketchloft.outline.star import Star, star_in, star_of
from sketchloft.periodic_cubic import curve_at, locate, pieces
from sketchloft.ring import ring_area, ring_depth
from sketchloft.shapes.spline import ClosedSpline, resampled

CENTRE = np.array([0.3, -0.2])
ELL = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]) - 0.8
STAIRS = np.array([-1.0, 1.4, 1.0, 0.7, 0.4, 0.0, -0.3, -0.8])
BULGES = np.array([0.0, 0.3, 0.0, -0.5, 0.2, -0.2])


def on_rays(radii: np.ndarray) -> np.ndarray:
    angle = 2 * np.pi * np.arange(len(radii)) / len(radii)
    return radii[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def clover() -> SplineLoop:
    return spline_loop(on_rays(1 + 0.2 * np.cos(3 * 2 * np.pi * np.arange(20) / 20)))


OUTLINES: dict[str, Outline] = {
    "circle": Circle(CENTRE, 1.1),
    "ellipse": Ellipse(CENTRE, 1.2, 0.5, 0.7),
    "ellipse, axes swapped": Ellipse(CENTRE, 0.5, 1.2, 0.7),
    "rectangle": Rectangle(CENTRE, 2.0, 1.0, 0.4),
    "rounded rectangle": RoundedRectangle(CENTRE, 1.0, 2.0, 0.4, 0.2),
    "rounded rectangle, a stadium": RoundedRectangle(CENTRE, 2.0, 1.0, 0.4, 0.5),
    "stadium": Stadium(CENTRE, 1.0, 0.5, 0.4),
    "regular polygon": RegularPolygon(CENTRE, 1.0, 0.3, 5),
    "star": Star(CENTRE, 1.0, 0.45, 0.3, 5),
    "circle of four even arcs": DividedCircle(CENTRE, 1.1, 0.3, 0.0),
    "circle of four arcs": DividedCircle(CENTRE, 1.1, 0.3, 0.2),
    "polygon": Polygon(ELL),
    "rectilinear polygon": RectilinearPolygon(STAIRS, 0.3),
    "rounded polygon": RoundedPolygon(ELL, 0.2),
    "line-arc": LineArc(ELL, BULGES, np.array([False, True, False, True, True, True])),
    "two arcs": LineArc(np.array([[-1.0, 0.0], [1.0, 0.0]]), np.array([0.4, 1.8]), np.ones(2, bool)),
    "lens": LineArc(np.array([[-1.0, 0.0], [1.0, 0.0]]), np.array([0.4, -0.1]), np.ones(2, bool)),
    "long star": Polygon(on_rays(np.tile([1.0, 1.3], 20))),
    "spline": clover(),
}
each = pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES.keys())


def around(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-2, 2, (count, 2))


def dense(outline: Outline) -> Boundary:
    return outline.boundary(8000)


def differences(outline: Outline, points: np.ndarray, step: float) -> np.ndarray:
    """One-sided derivative of the distance by the parameters."""
    moved = [outline.moved(outline.vector + step * e).foot(points) for e in np.eye(len(outline.vector))]
    columns = [(foot.distance - outline.foot(points).distance) / step for foot in moved]
    return np.stack(columns, axis=1)


@each
def test_the_distance_is_that_from_the_nearest_point_of_the_boundary(outline: Outline) -> None:
    points, ring = around(500), dense(outline).points
    found = outline.foot(points).distance
    near, _ = cKDTree(ring).query(points)
    assert np.abs(found) == pytest.approx(near, abs=2e-3)
    assert (np.abs(found) < near + 1e-9).all()
    clear = near > 5e-3
    np.testing.assert_array_equal(np.sign(found)[clear], -np.sign(ring_depth(points, ring))[clear])


@each
def test_the_boundary_lies_on_the_outline_and_its_normals_are_the_feets(outline: Outline) -> None:
    boundary = outline.boundary(200)
    foot = outline.foot(boundary.points)
    assert np.abs(foot.distance).max() < 1e-12
    np.testing.assert_allclose(foot.normal, boundary.normals, atol=1e-9)
    off = outline.foot(boundary.points + 1e-4 * boundary.normals)
    np.testing.assert_allclose(off.distance, 1e-4, atol=1e-12)
    np.testing.assert_allclose(off.curvature, foot.curvature, atol=1e-5)


@each
def test_area_and_perimeter_are_those_of_a_dense_boundary(outline: Outline) -> None:
    boundary = dense(outline)
    assert outline.area == pytest.approx(ring_area(boundary.points), rel=1e-5)
    along = np.linalg.norm(np.roll(boundary.points, -1, axis=0) - boundary.points, axis=1)
    assert boundary.lengths.sum() == pytest.approx(along.sum(), rel=1e-3)
    assert outline.boundary(100).lengths.sum() == pytest.approx(boundary.lengths.sum(), rel=1e-5)
    # Gauss: the area is the flux of (x, y) / 2, and no constant field has any.
    flux = np.einsum("ij,ij,i->", boundary.points, boundary.normals, boundary.lengths) / 2
    assert flux == pytest.approx(outline.area, rel=1e-9)
    np.testing.assert_allclose(boundary.lengths @ boundary.normals, 0, atol=1e-9)


@each
def test_the_gradients_are_the_derivatives_of_the_distance(outline: Outline) -> None:
    points = around(400)
    foot = outline.foot(points)
    step = 1e-6
    forward, back = differences(outline, points, step), differences(outline, points, -step)
    if isinstance(outline, RoundedRectangle) and outline.radius == outline.height / 2:
        back[:, 3], forward[:, 5] = forward[:, 3], back[:, 5]  # beyond these ends of the range it is clamped
    wrong = np.abs((forward + back) / 2 - foot.gradient).max(axis=1)
    assert np.quantile(wrong, 0.98) < 2e-6  # but for points whose foot jumps
    shifts = [step * axis for axis in np.eye(2)]
    columns = [(outline.foot(points + s).distance - outline.foot(points - s).distance) for s in shifts]
    wrong = np.abs(np.stack(columns, axis=1) / (2 * step) - foot.normal).max(axis=1)
    assert np.quantile(wrong, 0.98) < 1e-6
    np.testing.assert_allclose(np.linalg.norm(foot.normal, axis=1), 1, atol=1e-12)


@each
def test_moved_takes_what_vector_gives(outline: Outline) -> None:
    vector = outline.vector
    np.testing.assert_array_equal(outline.moved(vector).vector, vector)
    other = vector + 0.01 * np.sin(np.arange(len(vector)))
    moved = outline.moved(other)
    assert moved.kind == outline.kind
    np.testing.assert_allclose(moved.vector, other, atol=0.02)
    np.testing.assert_array_equal(outline.vector, vector)
    assert outline.foot(np.zeros((0, 2))).gradient.shape == (0, len(vector))


@each
def test_the_edges_close_up_and_lie_on_the_outline(outline: Outline) -> None:
    edges = outline.edges()
    if isinstance(edges[0], Closed):
        assert len(edges) == 1
        assert edges[0].kind == outline.kind
        return
    bounded = [edge for edge in edges if isinstance(edge, Segment | Arc)]
    for edge, following in zip(bounded, bounded[1:] + bounded[:1], strict=True):
        np.testing.assert_array_equal(edge.end, following.start)
        middle = edge.middle if isinstance(edge, Arc) else (edge.start + edge.end) / 2
        assert np.abs(outline.foot(np.stack([edge.start, middle])).distance).max() < 1e-12


def test_known_areas_and_edges() -> None:
    stadium = OUTLINES["rounded rectangle, a stadium"]
    assert stadium.area == pytest.approx(1 + np.pi / 4, rel=1e-12)
    assert [type(edge) for edge in stadium.edges()] == [Arc, Segment, Arc, Arc, Segment, Arc]
    slot = Stadium(CENTRE, 1.0, 0.5, 0.4)
    assert slot.area == pytest.approx(stadium.area, rel=1e-12)
    assert [type(edge) for edge in slot.edges()] == [Segment, Arc, Segment, Arc]
    np.testing.assert_allclose(
        slot.foot(around(200)).distance, stadium.foot(around(200)).distance, atol=1e-12
    )
    np.testing.assert_allclose(stadium_like(slot.rounded).vector, slot.vector, atol=1e-12)
    assert OUTLINES["polygon"].area == pytest.approx(3, rel=1e-12)
    # Five convex corners lose what the one that is not convex gains.
    assert OUTLINES["rounded polygon"].area == pytest.approx(3 - 4 * 0.04 * (1 - np.pi / 4), rel=1e-12)
    half = np.array([[-1.0, 0.0], [1.0, 0.0]])
    assert chain_area(half, np.ones(2)) == pytest.approx(np.pi, rel=1e-12)
    sharp = RoundedRectangle(CENTRE, 2.0, 1.0, 0.4, 0.0)
    assert [type(edge) for edge in sharp.edges()] == 4 * [Segment]
    rectangle = OUTLINES["rectangle"].foot(around(200))
    np.testing.assert_allclose(sharp.foot(around(200)).distance, rectangle.distance, atol=1e-12)
    assert RoundedRectangle(CENTRE, 2.0, 1.0, 0.0, 9.0).area == pytest.approx(stadium.area)
    assert RoundedPolygon(ELL, 9.0).moved(np.r_[ELL.ravel(), 9.0]).radius == pytest.approx(0.5)
    (edge,) = OUTLINES["ellipse, axes swapped"].edges()
    assert isinstance(edge, Closed)
    np.testing.assert_allclose(edge.poles[1:], [[1.2, 0.5], [-np.sin(0.7), np.cos(0.7)]])


def test_the_spline_is_the_closed_spline_of_its_poles() -> None:
    loop = clover()
    u = np.arange(97) / 97
    points = ClosedSpline(loop.poles).evaluate(u)
    at, _, _ = curve_at(pieces(loop.poles), *locate(u, len(loop.poles)))
    np.testing.assert_allclose(points, at.T, atol=1e-12)
    assert np.abs(loop.foot(points).distance).max() < 1e-12
    outside = loop.moved(loop.vector + 0.05).foot(loop.boundary(100).points).distance
    assert (outside < -0.03).all()


def test_poles_go_where_waves_need_them() -> None:
    angles = np.arange(2000) / 2000 * 2 * np.pi
    wave = (3 + 0.8 * np.cos(5 * angles))[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for count in (16, 24, 30):
        even, fitted = (
            np.sqrt(np.mean(loop.foot(wave).distance ** 2))
            for loop in (spline_of(wave, count), fitted_loop(wave, count))
        )
        assert fitted < even / 2
    assert fitted < 0.005


def test_the_centres_of_round_things_have_finite_feet() -> None:
    for outline in (Circle(CENTRE, 1.0), Ellipse(CENTRE, 1.5, 1.0, 0.3), Ellipse(CENTRE, 1.0, 1.0, 0.0)):
        foot = outline.foot(CENTRE[None])
        assert foot.distance == pytest.approx(-1)
        assert np.linalg.norm(foot.normal) == pytest.approx(1)
        assert np.isfinite(foot.gradient).all()


def test_bulges_next_to_nothing_are_as_good_as_lines() -> None:
    points = around(200)
    straight = chain_foot(points, *seen_from_within(ELL, np.zeros(6)))
    for bulge in (1e-14, -1e-9):
        bent = chain_foot(points, *seen_from_within(ELL, np.full(6, bulge)))
        np.testing.assert_allclose(bent.distance, straight.distance, atol=1e-8)
        np.testing.assert_allclose(bent.gradient, straight.gradient, atol=1e-7)
    for low, high in ((0.02999, 0.03001), (-0.03001, -0.02999)):  # where the area goes over to its series
        areas = [chain_area(ELL, np.full(6, bulge)) for bulge in (low, high)]
        assert areas[1] - areas[0] == pytest.approx(2e-5 * 12 / 3, rel=1e-2)


@settings(max_examples=60, deadline=None)
@given(st.floats(0.02, 1.0), st.floats(0, 2 * np.pi), st.floats(-1, 2))
def test_the_foot_on_an_ellipse_is_exact(ratio: float, angle: float, offset: float) -> None:
    ellipse = Ellipse(np.zeros(2), 1.0, ratio, 0.0)
    at = np.array([np.cos(angle), ratio * np.sin(angle)])
    normal = np.array([ratio * np.cos(angle), np.sin(angle)])
    normal /= np.linalg.norm(normal)
    # Inwards, the foot stays the nearest up to the first centre of curvature, on the major axis at worst.
    distance = offset if offset > 0 else offset * 0.9 * ratio**2
    foot = ellipse.foot((at + distance * normal)[None])
    assert foot.distance[0] == pytest.approx(distance, rel=1e-10, abs=1e-14)
    np.testing.assert_allclose(foot.normal[0], normal, atol=1e-7)


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.5, 1.5), st.floats(-0.15, 0.6)), min_size=3, max_size=12),
    st.integers(0, 99),
)
def test_inside_and_outside_of_any_chain(corners: list[tuple[float, float]], seed: int) -> None:
    radii, bulges = np.array(corners).T
    vertices = on_rays(radii)
    ring = chain_boundary(vertices, bulges, 3000).points
    from shapely import LinearRing

    if not LinearRing(ring).is_simple:
        return
    points = around(100, seed)
    foot = chain_foot(points, *seen_from_within(vertices, bulges))
    expected = -ring_depth(points, ring)
    assert np.abs(foot.distance - expected).max() < 5e-3
    feet = points - foot.distance[:, None] * foot.normal
    assert np.abs(chain_foot(feet, *seen_from_within(vertices, bulges)).distance).max() < 1e-9


def test_a_star_is_found_from_its_corners_and_an_l_is_none() -> None:
    star = Star(CENTRE, 1.0, 0.45, 0.3, 5)
    for first in (0, 1, 4):
        found = star_of(np.roll(star.chain()[0], -first, axis=0))
        assert found is not None
        assert found.chain()[0][0] == pytest.approx(star.chain()[0][first + first % 2], abs=1e-9)
        assert (found.radius, found.inner_radius) == pytest.approx((1.0, 0.45))
        seen = star_in(resampled(found.chain()[0], 300))
        assert seen is not None
        assert seen.tips == star.tips
        assert seen.vector == pytest.approx([*CENTRE, 1.0, 0.45, seen.angle], abs=0.02)
        assert np.cos(star.tips * (seen.angle - star.angle)) == pytest.approx(1, abs=0.01)
    assert star_in(resampled(RegularPolygon(CENTRE, 1.0, 0.3, 5).chain()[0], 300)) is None
    corners = np.array([[0, 0], [1, 0], [1, 0.4], [0.4, 0.4], [0.4, 1], [0, 1]])
    assert star_of(corners) is None


@pytest.mark.parametrize("angle", [0.0, 0.3, 0.7, 2.0, -3.0])
def test_right_corners_are_found_in_a_polygon_that_has_them_about(angle: float) -> None:
    stairs = RectilinearPolygon(STAIRS, angle)
    corners = stairs.chain()[0]
    for first in (0, 1, 4):
        found = rectilinear_of(np.roll(corners, -first, axis=0))
        assert found is not None
        assert len(found.offsets) == 8
        assert found.area == pytest.approx(stairs.area)
        assert np.abs(stairs.foot(found.chain()[0]).distance).max() < 1e-12
    shaken = corners + 0.05 * np.random.default_rng(1).normal(size=corners.shape)
    halved = np.insert(shaken, 1, shaken[:2].mean(axis=0) + 0.03, axis=0)
    found = rectilinear_of(halved)
    assert found is not None
    assert len(found.offsets) == 8
    assert np.abs(stairs.foot(found.chain()[0]).distance).max() < 0.15


def test_polygons_without_right_corners_and_rectangles_are_not_rectilinear() -> None:
    for sides in (3, 5, 6, 8, 12):
        assert rectilinear_of(RegularPolygon(CENTRE, 1.0, 0.3, sides).chain()[0]) is None
    assert rectilinear_of(Rectangle(CENTRE, 2.0, 1.0, 0.4).chain()[0]) is None
    assert rectilinear_of(Star(CENTRE, 1.0, 0.45, 0.3, 5).chain()[0]) is None


def test_the_smallest_step_is_left_out() -> None:
    stairs = RectilinearPolygon(STAIRS, 0.3)
    for first in range(0, 8, 2):
        fewer = with_a_step_less(replace(stairs, offsets=np.roll(STAIRS, -first)))
        assert fewer is not None
        assert len(fewer.offsets) == 6
        assert ring_area(fewer.chain()[0]) > 0
        assert fewer.area == pytest.approx(stairs.area, rel=0.1)
        assert with_a_step_less(fewer) is None


@pytest.mark.parametrize("width", [0.3, 0.8, 1.5])
def test_most_of_a_circle_is_one_arc(width: float) -> None:
    """A key: a round head of radius 1, and a bar of some width that begins in it."""
    bar = np.array([[3, -width / 2], [3, width / 2]])
    start, sweep = np.arcsin(width / 2), 2 * np.pi - 2 * np.arcsin(width / 2)
    angle = start + sweep * np.linspace(0, 1, 300)
    ring = np.concatenate([bar, np.column_stack([np.cos(angle), np.sin(angle)])])
    vertices, bulges = line_arc_pieces(ring, 0.005, 0.05, (5.0,))[0]
    assert len(vertices) == 4
    assert np.sort(bulges)[:3].tolist() == [0, 0, 0]
    assert 4 * np.arctan(bulges.max()) == pytest.approx(sweep, abs=0.15)


@pytest.mark.parametrize("bulge", [-1.0, 0.4, 1.0, 2.2])
def test_few_points_integrate_over_arcs_that_turn_far(bulge: float) -> None:
    """As every edge of an outline of many has, when a wall has points at some heights to spread."""
    angles = np.arange(10) / 10 * 2 * np.pi
    vertices = np.column_stack([np.cos(angles), np.sin(angles)])
    bulges = np.where(np.arange(10) % 2 == 0, bulge, 0.0)
    boundary = chain_boundary(vertices, bulges, 20)
    flux = np.einsum("ij,ij,i->", boundary.points, boundary.normals, boundary.lengths) / 2
    assert flux == pytest.approx(chain_area(vertices, bulges), rel=1e-4)
