import numpy as np
import pytest

from sketchloft.edge_points import EdgePoints
from sketchloft.loft import Between, LoftParams, Section, loft
from sketchloft.ring import ring_area, ring_is_simple
from sketchloft.shapes.circle import Circle
from sketchloft.shapes.ellipse import Ellipse
from sketchloft.shapes.rectangle import Rectangle
from sketchloft.shapes.spline import fit_spline
from sketchloft.surface import evaluate
from sketchloft.untangle import _borrow, untangled

U = np.arange(200) / 200
ROUND = [Section(float(z), Circle(np.array([0.1 * z, 0.0]), 2.0 + 0.1 * z)) for z in range(6)]


def rings(sections: list[Section], between: Between = "straight") -> np.ndarray:
    surface = loft(sections, LoftParams(between))
    heights = np.array([section.height for section in sections])
    return evaluate(surface, U, (heights - heights[0]) / np.ptp(heights))


@pytest.mark.parametrize("between", ["straight", "smooth"])
def test_the_loft_runs_through_its_sections(between: Between) -> None:
    for ring, section in zip(rings(ROUND, between), ROUND, strict=True):
        assert ring[:, 2] == pytest.approx(section.height, abs=1e-9)
        assert np.abs(section.shape.distance(ring[:, :2])).max() < 1e-5


def test_straight_lofts_never_overshoot() -> None:
    sections = [
        Section(0.0, Circle(np.zeros(2), 5.0)),
        Section(1.0, Circle(np.zeros(2), 5.0)),
        Section(1.01, Circle(np.zeros(2), 1.0)),
        Section(5.0, Circle(np.zeros(2), 1.0)),
    ]
    radius = np.linalg.norm(
        evaluate(loft(sections, LoftParams()), U, np.linspace(0, 1, 400))[..., :2], axis=2
    )
    assert radius.max() < 5 + 1e-5
    assert radius.min() > 1 - 1e-5


def test_the_corners_of_rectangles_stay_sharp_and_circles_round() -> None:
    sections = [
        Section(0.0, Circle(np.zeros(2), 1.5)),
        Section(1.0, Rectangle(np.zeros(2), np.array([2.0, 1.0]), 0.7)),
        Section(2.0, Rectangle(np.zeros(2), np.array([2.0, 1.0]), 0.7)),
    ]
    found = rings(sections)
    assert np.abs(sections[1].shape.distance(found[1][:, :2])).max() < 1e-9
    assert np.abs(sections[0].shape.distance(found[0][:, :2])).max() < 1e-5
    reach = np.linalg.norm(found[1][:, :2], axis=1)
    assert (reach > np.sqrt(5) - 1e-9).sum() == 4


@pytest.mark.parametrize("seed", range(5))
def test_sections_that_start_anywhere_are_lofted_without_twist(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ellipse = Ellipse(np.zeros(2), np.array([3.0, 1.0]), 0.3)
    sections = []
    for z in range(6):
        ring = np.roll(ellipse.evaluate(np.arange(120) / 120), int(rng.integers(120)), axis=0)
        sections.append(Section(float(z), fit_spline(ring, 24)))
    surface = loft(sections, LoftParams())
    between = evaluate(surface, U, np.linspace(0, 1, 31))
    areas = np.array([ring_area(ring[:, :2]) for ring in between])
    assert areas == pytest.approx(3 * np.pi, rel=0.01)  # a twisted loft has a waist


def test_a_slow_turn_is_followed() -> None:
    sections = [
        Section(float(z), Rectangle(np.zeros(2), np.array([2.0, 1.0]), (0.15 * z) % np.pi)) for z in range(30)
    ]
    areas = [
        ring_area(ring[:, :2]) for ring in evaluate(loft(sections, LoftParams()), U, np.linspace(0, 1, 301))
    ]
    assert min(areas) > 0.97 * 8


def test_two_sections_are_enough_for_a_smooth_loft_too() -> None:
    surface = loft(ROUND[:2], LoftParams("smooth"))
    assert surface.v_degree == 1
    assert loft(ROUND, LoftParams("smooth")).v_degree == 3


def test_ragged_sections_that_tangle_become_plainer() -> None:
    rng = np.random.default_rng(3)
    angle = 2 * np.pi * np.arange(60) / 60
    sections, edges = [], []
    for z in range(8):
        ragged = (1 + 0.45 * rng.normal(size=60).clip(-1.5, 1.5))[:, None] * np.c_[
            np.cos(angle), np.sin(angle)
        ]
        ragged = ragged + 0.15 * rng.normal(size=ragged.shape)
        sections.append(Section(float(z), fit_spline(ragged, 48)))
        edges.append(EdgePoints(float(z), 1.0, ragged, ring_area(ragged), 0, True))
    kept, surface = untangled(sections, edges, LoftParams())
    assert sum(one.shape.parameters for one in kept) < 8 * 48
    for ring in evaluate(surface, U, np.linspace(0, 1, 29)):
        assert ring_is_simple(ring[:, :2])


def test_sections_that_do_not_tangle_are_left_alone() -> None:
    edges = [EdgePoints(s.height, 1.0, s.shape.evaluate(U), 1.0, 0, True) for s in ROUND]
    kept, _ = untangled(ROUND, edges, LoftParams())
    assert kept == tuple(ROUND)


def test_a_section_that_cannot_be_made_plainer_borrows_once() -> None:
    sections = [Section(0.0, Circle(np.zeros(2), 1.0)), Section(1.0, Circle(np.zeros(2), 2.0))]
    assert _borrow(sections, [0])
    assert sections[1].shape is sections[0].shape
    assert [section.borrowed for section in sections] == [False, True]
    assert not _borrow(sections, [0])
