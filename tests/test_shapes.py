import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchloft.edge_points import EdgePoints
from sketchloft.errors import StageError, UsageError
from sketchloft.ring import ring_area
from sketchloft.shapes.choice import ShapesParams, choices
from sketchloft.shapes.circle import Circle, fit_circle
from sketchloft.shapes.ellipse import Ellipse, fit_ellipse
from sketchloft.shapes.recognise import Shape, recognise, simpler
from sketchloft.shapes.rectangle import Rectangle, fit_rectangle
from sketchloft.shapes.spline import fit_spline

AROUND = np.arange(400) / 400
lengths = st.floats(0.1, 100)
places = st.floats(-100, 100)
angles = st.floats(0, 3.1)


def edge(points: np.ndarray, height: float = 0.0, area: float | None = None) -> EdgePoints:
    return EdgePoints(height, 1.0, points, ring_area(points) if area is None else area, 0, True)


def noisy(shape: Shape, count: int = 60, noise: float = 0.01, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    points = shape.evaluate(np.sort(rng.random(count)))
    return points + noise * rng.normal(size=points.shape)


@settings(max_examples=50, deadline=None)
@given(places, places, lengths, st.integers(0, 99))
def test_a_circle_is_found_exactly(x: float, y: float, radius: float, seed: int) -> None:
    circle = Circle(np.array([x, y]), radius)
    found = fit_circle(circle.evaluate(np.random.default_rng(seed).random(12)))
    assert found.radius == pytest.approx(radius, rel=1e-6)
    assert found.centre == pytest.approx([x, y], abs=1e-6 * (1 + radius))


@settings(max_examples=50, deadline=None)
@given(places, places, lengths, st.floats(1.1, 6), angles)
def test_an_ellipse_is_found_exactly(x: float, y: float, short: float, ratio: float, angle: float) -> None:
    ellipse = Ellipse(np.array([x, y]), np.array([short * ratio, short]), angle)
    found = fit_ellipse(ellipse.evaluate(np.arange(24) / 24))
    assert found.semi_axes == pytest.approx(ellipse.semi_axes, rel=1e-5)
    assert found.centre == pytest.approx([x, y], abs=1e-5 * (1 + short * ratio))
    assert abs(np.sin(found.angle - angle)) < 1e-4


@settings(max_examples=50, deadline=None)
@given(places, places, lengths, st.floats(1.1, 6), angles)
def test_a_rectangle_is_found_exactly(x: float, y: float, short: float, ratio: float, angle: float) -> None:
    rectangle = Rectangle(np.array([x, y]), np.array([short * ratio, short]), angle)
    found = fit_rectangle(rectangle.evaluate(np.arange(36) / 36))
    assert found.half_sides == pytest.approx(rectangle.half_sides, rel=1e-5)
    assert found.centre == pytest.approx([x, y], abs=1e-5 * (1 + short * ratio))
    assert abs(np.sin(found.angle - angle)) < 1e-4


def test_a_square_at_any_turn() -> None:
    for angle in np.linspace(0, np.pi / 2, 7):
        square = Rectangle(np.array([1.0, 2.0]), np.array([1.0, 1.0]), angle)
        assert fit_rectangle(noisy(square)).half_sides == pytest.approx([1, 1], abs=0.02)


@pytest.mark.parametrize(
    "shape",
    [
        Circle(np.array([1.0, 2.0]), 3.0),
        Ellipse(np.array([1.0, 2.0]), np.array([3.0, 1.0]), 0.4),
        Rectangle(np.array([1.0, 2.0]), np.array([3.0, 1.0]), 0.4),
        fit_spline(Circle(np.array([1.0, 2.0]), 3.0).evaluate(AROUND), 16),
    ],
)
def test_what_every_shape_can_do(shape: Shape) -> None:
    ring = shape.evaluate(AROUND)
    assert ring_area(ring) > 0
    assert shape.evaluate(np.array([0.0])) == pytest.approx(shape.evaluate(np.array([1.0])))
    assert np.abs(shape.distance(ring)).max() < 2e-3
    assert (
        np.abs(shape.grown(0.1).distance(ring) + 0.1).max() < 0.02
    )  # a moved ellipse is not quite an ellipse
    middle = ring.mean(axis=0)
    inner, outer = shape.distance(np.stack([middle, middle + np.array([50.0, 0.0])]))
    assert inner < 0 < outer


def test_the_corners_of_a_rectangle_are_at_the_quarters() -> None:
    corners = Rectangle(np.zeros(2), np.array([2.0, 1.0]), 0.0).evaluate(np.arange(4) / 4)
    assert sorted(map(tuple, np.abs(corners))) == [(2, 1)] * 4


def test_a_spline_follows_a_wave_with_enough_poles() -> None:
    angle = 2 * np.pi * AROUND
    wave = (1 + 0.2 * np.cos(5 * angle))[:, None] * np.c_[np.cos(angle), np.sin(angle)]
    errors = [np.abs(fit_spline(wave, count).distance(wave)).max() for count in (8, 16, 48)]
    assert errors[0] > 0.05
    assert errors[1] < errors[0]
    assert errors[2] < 5e-3


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(
    ("shape", "kind"),
    [
        (Circle(np.zeros(2), 2.0), "circle"),
        (Ellipse(np.zeros(2), np.array([3.0, 2.0]), 1.0), "ellipse"),
        (Rectangle(np.zeros(2), np.array([3.0, 2.0]), 1.0), "rectangle"),
        (fit_spline(np.array([[0, 0], [10, 0], [10, 4], [4, 4], [4, 10], [0, 10.0]]), 32), "spline"),
    ],
)
def test_the_kind_with_the_most_evidence_is_chosen(shape: Shape, kind: str, seed: int) -> None:
    edges = [edge(noisy(shape, seed=10 * seed + i), float(i)) for i in range(4)]
    found = recognise(edges, np.array([0.0, 3.0]), ShapesParams())
    assert [one.kind for one in found] == [kind] * 4


def test_each_run_between_key_heights_gets_its_own_kind() -> None:
    circle, rectangle = Circle(np.zeros(2), 2.0), Rectangle(np.zeros(2), np.array([3.0, 2.0]), 0.0)
    edges = [edge(noisy(circle if i < 4 else rectangle, seed=i), float(i)) for i in range(8)]
    found = recognise(edges, np.array([0.0, 4.0, 7.0]), ShapesParams())
    assert [one.kind for one in found] == ["circle"] * 4 + ["rectangle"] * 4


def test_shapes_enclose_the_area_that_the_points_account_for() -> None:
    points = noisy(Circle(np.zeros(2), 2.0))
    for kind in ("circle", "ellipse", "off"):
        (found,) = recognise([edge(points, area=14.0)], np.array([0.0, 0.0]), ShapesParams(kind))
        assert ring_area(found.evaluate(AROUND)) == pytest.approx(14, rel=1e-3)


def test_simpler_splines_end_at_the_fewest_poles() -> None:
    shape: Shape | None = fit_spline(noisy(Circle(np.zeros(2), 2.0)), 48)
    counts = []
    while shape is not None:
        counts.append(shape.parameters)
        shape = simpler(shape, edge(noisy(Circle(np.zeros(2), 2.0))))
    assert counts == [48, 32, 24, 16, 12, 8]
    assert simpler(Circle(np.zeros(2), 1.0), edge(noisy(Circle(np.zeros(2), 1.0)))) is None


def test_a_contour_that_crosses_itself_is_named() -> None:
    angle = 2 * np.pi * np.arange(40) / 40
    eight = np.c_[np.sin(angle), np.sin(2 * angle)]
    with pytest.raises(StageError, match="shapes, slice 0: the spline through 40 edge points crosses itself"):
        recognise([edge(eight, area=0.5)], np.array([0.0, 0.0]), ShapesParams("off"))


def test_choices_for_all_and_for_single_slices() -> None:
    assert choices("circle", 3) == ("circle",) * 3
    assert choices("3:circle,7-9:rectangle", 10) == (
        *["auto"] * 3, "circle", *["auto"] * 3, *["rectangle"] * 3
    )  # fmt: skip
    assert choices("1:circle, off", 3) == ("off", "circle", "off")


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("round", "found 'round', expected one of auto, off, circle"),
        ("9:circle", "found slices 9, but the slices are 0 to 3"),
        ("2-1:circle", "found slices 2-1"),
        ("x:circle", "found 'x' for slices, expected a number or a range"),
        ("", "found ''"),
    ],
)
def test_wrong_choices_are_refused(asked: str, said: str) -> None:
    with pytest.raises(UsageError, match=said):
        choices(asked, 4)
