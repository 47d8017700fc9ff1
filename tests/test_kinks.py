"""Kinks: roofs, chamfers and bends of prisms, whose walls have one outline where they meet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from scribbles import scribbled
from sketchloft import Params, PointCloud, reconstruct
from sketchloft.cloud import Floats
from sketchloft.exact.body import ExactBody
from sketchloft.exact.changes.bends import bends
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of
from sketchloft.exact.model.kinks import kink, with_kink
from sketchloft.exact.model.set_upon import moved_off
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.search.kinked import kinked
from sketchloft.exact.search.squared import squared
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon
from sketchloft.outline.polygons import Polygon
from sketchloft.stack import Run, Stack, Wall
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Freedom, Swept

Bools = NDArray[np.bool_]

ORIGIN = np.zeros(2)
BOX = Rectangle(np.array([0.02, -0.01]), 0.5, 0.4, 0.3)
NUT = RegularPolygon(np.array([0.02, -0.01]), 0.25, 0.2, 6)
N = 20_000
SIGMA = 0.002


def prism(outline: Rectangle | RegularPolygon = BOX) -> Swept:
    return Swept(outline, 0.0, outline.centre, ORIGIN)


def roof(outline: Rectangle | RegularPolygon = BOX, height: float = 0.1, taper: float = -1.5) -> Swept:
    return Swept(outline, height, outline.centre, ORIGIN, taper, 0.0, ("taper",))


def stack(*walls: Wall, breaks: tuple[float, ...] = (-0.3, 0.1, 0.3)) -> Stack:
    return Stack(np.array(breaks), tuple(Run((wall,)) for wall in walls))


def model_with(found: Stack) -> ExactModel:
    return model_of(found, SIGMA, Density(np.log([N / stack_volume(found)])), 1.0, 1.0)


def within(found: Stack, points: Floats) -> Bools:
    """Whether points (n, 3) are inside a stack."""
    inside = np.zeros(len(points), dtype=bool)
    for run, low, high in found.slabs():
        between = (points[:, 2] > low) & (points[:, 2] <= high)
        inside |= between & (run.walls[0].foot(points).distance < 0)
    return inside


def drawn(found: Stack, sigma: float = SIGMA, count: int = N, seed: int = 0) -> Floats:
    """Points inside a stack, with noise."""
    rng = np.random.default_rng(seed)
    points = rng.uniform([-0.5, -0.5, found.breaks[0]], [0.5, 0.5, found.breaks[-1]], (20 * count, 3))
    points = points[within(found, points)][:count]
    return points + rng.normal(0, sigma, points.shape)


@pytest.mark.parametrize(
    ("moves", "bow"),
    [(("taper",), 0.0), (("drift", "taper", "twist"), 0.0), (("drift",), 0.0), (("taper", "bow"), 1.2)],
)
def test_the_derivative_by_the_height_is_that(moves: tuple[Freedom, ...], bow: float) -> None:
    drift = np.array([0.2, -0.1]) if "drift" in moves else ORIGIN
    twist = 0.4 if "twist" in moves else 0.0
    wall = Swept(BOX, 0.1, BOX.centre, drift, 0.3, twist, (*moves, "height"), bow)
    on_it = wall.boundary(0.0, 0.3, 200).points
    step = np.zeros(len(wall.vector))
    step[-1] = 1e-6
    ahead, behind = (wall.moved(wall.vector + way * step).foot(on_it).distance for way in (1, -1))
    np.testing.assert_allclose(wall.foot(on_it).gradient[:, -1], (ahead - behind) / 2e-6, atol=1e-6)


def test_where_walls_of_one_outline_meet() -> None:
    below, above = with_kink(*stack(prism(), roof()).runs)
    assert kink(below, above) == 0.1
    turned_over = with_kink(*stack(roof(taper=1.5), prism()).runs)
    assert kink(*turned_over) == 0.1
    mansard = Run((roof(taper=-0.5),)), Run((replace(roof(height=0.2), free=("taper", "height")),))
    height = kink(*mansard)
    assert height is not None
    first, last = (run.walls[0].area(np.array([height])) for run in mansard)
    np.testing.assert_allclose(first, last)


def test_a_wall_moved_off_another_has_its_section_there() -> None:
    mansard = roof(taper=-0.5)
    moved = moved_off(replace(roof(height=0.0), outline=replace(BOX, width=0.7)), mansard, 0.2)
    at = np.array([0.2])
    np.testing.assert_allclose(moved.area(at), mansard.area(at))
    np.testing.assert_array_equal(moved.outline.vector, BOX.vector)


def test_a_height_is_held_where_the_outline_has_become_another() -> None:
    _, above = with_kink(*stack(prism(), roof()).runs)
    model = with_run(model_with(stack(prism(), roof())), 1, above)
    assert model.size == 7
    assert model.joins[1] == "cross"
    other = with_run(model, 0, Run((prism(NUT),)))
    assert other.joins[1] == "step"
    (last,) = other.stack.runs[1].walls
    assert isinstance(last, Swept)
    assert last.free == ("taper",)


@pytest.mark.parametrize("outline", [BOX, NUT], ids=["box", "hexagon"])
@pytest.mark.parametrize("seed", range(3))
def test_a_roof_that_the_points_do_not_lift_off_stands_on_its_house(
    outline: Rectangle | RegularPolygon, seed: int
) -> None:
    points = drawn(stack(prism(outline), roof(outline)), seed=seed)
    apart = outline.moved(outline.vector * (1 + 0.002 * np.cos(np.arange(len(outline.vector)))))
    found = kinked(points, model_with(stack(prism(outline), roof(apart, 0.102))), 1.0)
    assert found.joins[1] == "cross"
    assert found.stack.breaks[1] == pytest.approx(0.1, abs=0.003)
    lower, upper = (run.walls[0] for run in found.stack.runs)
    assert isinstance(lower, Swept)
    assert isinstance(upper, Swept)
    np.testing.assert_array_equal(lower.outline.vector, upper.outline.vector)


def test_eaves_that_stick_out_stay() -> None:
    wide = replace(BOX, width=0.52, height=0.42)
    house = stack(prism(), roof(wide))
    model = model_with(house)
    assert kinked(drawn(house), model, 1.0) is model


def hipped(turn: float = 0.0) -> Ruled:
    top = Rectangle(BOX.centre, 0.3, 0.1, 0.3 + turn)
    return Ruled(Polygon(BOX.chain()[0]), Polygon(top.chain()[0]), -0.1, 0.2)


@pytest.mark.parametrize("seed", range(3))
def test_a_ruled_wall_of_four_sides_goes_from_rectangle_to_rectangle(seed: int) -> None:
    there = stack(hipped(), breaks=(-0.1, 0.2))
    found = squared(drawn(there, seed=seed), model_with(there), 1.0)
    assert found.size == 7  # one centre, one angle, two widths, two depths and no more
    (wall,) = found.stack.walls
    assert isinstance(wall, Ruled)
    np.testing.assert_allclose(wall.top.area, 0.03, rtol=0.03)


def test_a_top_that_is_turned_stays_so() -> None:
    there = stack(hipped(0.15), breaks=(-0.1, 0.2))
    model = model_with(there)
    assert squared(drawn(there), model, 1.0) is model


def test_a_hipped_roof_shares_the_outline_of_its_house() -> None:
    top = Rectangle(BOX.centre, 0.3, 0.1, 0.3)
    there = stack(prism(), Ruled(BOX, top, 0.1, 0.3))
    off = Rectangle(BOX.centre + 0.001, BOX.height, BOX.width, BOX.angle + 0.001 + np.pi / 2)
    turned = Rectangle(off.centre, top.height, top.width, off.angle)
    start = with_run(model_with(there), 1, Run((Ruled(off, turned, 0.1, 0.3),)))
    found = kinked(drawn(there), start, 1.0)
    assert (start.size, found.size) == (12, 7)
    first, last = (run.walls[0] for run in found.stack.runs)
    assert isinstance(first, Swept)
    assert isinstance(last, Ruled)
    np.testing.assert_array_equal(first.outline.vector, last.bottom.vector)


def test_bends_change_nothing_but_the_ends() -> None:
    (one,) = {
        len(change.model.stack.runs) for change in bends(model_with(stack(prism(NUT), breaks=(-0.3, 0.3))))
    }
    assert one == 2


def built(points: Floats) -> ExactBody:
    (body,) = reconstruct(PointCloud.of(points), Params("exact")).bodies
    assert isinstance(body, ExactBody), body.instead
    return body


@pytest.mark.slow
@pytest.mark.parametrize("both_ways", [False, True])
def test_a_house_has_ten_faces(*, both_ways: bool) -> None:
    long = replace(BOX, width=0.8)
    top: Wall = Ruled(long, Rectangle(long.centre, 0.44, 0.12, 0.3), 0.1, 0.3) if both_ways else roof(long)
    body = built(drawn(stack(prism(long), top), 0.0, 8000))
    assert body.facts.faces == {"Plane": 10}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_chamfer_in_a_scribble_is_found(seed: int) -> None:
    nut = replace(NUT, radius=2.0)
    top = Swept(nut, 6.0, nut.centre, ORIGIN, -0.3, 0.0, ("taper",))
    there = stack(prism(nut), top, breaks=(0.0, 6.0, 7.0))
    low, high = np.array([-2.0, -2.0, 0.0]), np.array([2.0, 2.0, 7.0])
    body = built(scribbled(lambda points: within(there, points), low, high, 10_000, seed))
    assert body.facts.faces == {"Plane": 14}
