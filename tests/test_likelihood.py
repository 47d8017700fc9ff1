"""The likelihood: its slopes are those of its values, and at the truth they are what chance makes of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sketchloft.cloud import Floats
from sketchloft.exact.fit.climb import climb
from sketchloft.exact.fit.expected import mass_nodes, wall_nodes
from sketchloft.exact.fit.fit_density import FEWEST
from sketchloft.exact.fit.likelihood import beside_walls, evaluate, share_of, value_of
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of, tied
from sketchloft.exact.model.joins import joined, natural_joins
from sketchloft.exact.model.soundness import slits, sound
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import spline_loop
from sketchloft.stack import Run, Stack, Wall
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import lofted
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Freedom, Swept

COUNT, SIGMA = 4000, 0.004
STRAYS = 60.0
BREAKS = np.array([-0.3, 0.28])
KNOTS = np.array([-0.304] * 4 + [0.02] + [0.284] * 4)
"""Just longer than the runs, so that breaks can be moved."""
CENTRE, ORIGIN = np.array([0.03, -0.02]), np.zeros(2)
ELL = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]) / 5 - 0.16
ROUND = np.array([0.0, 0.4, 0.45, 0.3])
BULGES = np.array([0, 0.3, 0, -0.4, 0.2, 0])
ANGLE = np.arange(12) * np.pi / 6
FLOWER = spline_loop(
    ((2 + 0.4 * np.cos(3 * ANGLE)) * np.stack([np.cos(ANGLE), np.sin(ANGLE)])).T / 7,
)
RINGS = np.stack(
    [
        scale * FLOWER.poles + [shift, 0]
        for scale, shift in ((0.8, 0), (1, 0.02), (1.1, 0.05), (0.9, 0.1), (0.7, 0.1))
    ]
)


def swept(outline: Outline, *free: Freedom) -> Swept:
    drift, taper, twist = (float(name in free) for name in ("drift", "taper", "twist"))
    return Swept(outline, 0.05, CENTRE, np.array([0.2, -0.1]) * drift, 0.4 * taper, 0.6 * twist, free)


WALLS: dict[str, Wall] = {
    "cylinder": Revolved(CENTRE, LineProfile(0.0, 0.3, None)),
    "cone": Revolved(CENTRE, LineProfile(0.1, 0.3, -0.4)),
    "sphere": Revolved(CENTRE, ArcProfile(0.05, None, 0.4)),
    "torus": Revolved(CENTRE, ArcProfile(0.05, 0.1, 0.4)),
    "waist": Revolved(CENTRE, ArcProfile(-0.05, 0.7, 0.45, -1)),
    "spline revolve": Revolved(CENTRE, SplineProfile(KNOTS, np.array([0.2, 0.3, 0.35, 0.3, 0.25]))),
    "extrusion": swept(Rectangle(CENTRE, 0.6, 0.4, 0.3)),
    "slanted": swept(Polygon(ELL), "drift"),
    "tapered": swept(Ellipse(CENTRE, 0.3, 0.2, 0.7), "taper"),
    "tapered beside it": Swept(Ellipse(CENTRE, 0.3, 0.2, 0.7), 0.05, ORIGIN, ORIGIN, 0.4, 0.0, ("taper",)),
    "twisted": swept(RegularPolygon(CENTRE, 0.35, 0.2, 5), "twist"),
    "all at once": swept(RoundedRectangle(CENTRE, 0.6, 0.4, 0.3, 0.08), "drift", "taper", "twist"),
    "ellipsoid": Swept(Ellipse(CENTRE, 0.4, 0.3, 0.7), 0.05, CENTRE, ORIGIN, 0.2, 0.0, ("taper", "bow"), 2.0),
    "ellipsoid beside it": Swept(
        Ellipse(CENTRE, 0.4, 0.3, 0.7), 0.05, ORIGIN, ORIGIN, 0.2, 0.0, ("taper", "bow"), 2.0
    ),
    "pillow": Swept(
        Rectangle(CENTRE, 0.6, 0.4, 0.3), 0.05, CENTRE, ORIGIN, -0.2, 0.0, ("drift", "taper", "bow"), 1.8
    ),
    "rounded": swept(RoundedPolygon(ELL, 0.03)),
    "lines and arcs": swept(LineArc(ELL, BULGES, BULGES != 0)),
    "free outline": swept(FLOWER),
    "loft": lofted(RINGS, KNOTS),
    "filleted": Filleted(RoundedRectangle(CENTRE, 0.6, 0.4, 0.3, 0.08), None, "both", *BREAKS.tolist()),
    "filleted, sharp": Filleted(Rectangle(CENTRE, 0.6, 0.4, 0.3), 0.1, "top", *BREAKS.tolist()),
    "ruled": Ruled(
        RegularPolygon(CENTRE, 0.4, 0.2, 4),
        LineArc(RegularPolygon(ORIGIN, 0.3, 0.3, 4).chain()[0], ROUND, ROUND != 0),
        *BREAKS.tolist(),
    ),
    "square to round": Ruled(
        Rectangle(CENTRE, 0.6, 0.4, 0.3), DividedCircle(ORIGIN, 0.25, 1.0, -0.1), *BREAKS.tolist()
    ),
}
each = pytest.mark.parametrize("name", WALLS)


def known(stack: Stack, seed: int = 3) -> tuple[Floats, ExactModel]:
    """Points drawn evenly in a stack, with noise and strays, and the model that they were drawn from."""
    rng = np.random.default_rng(seed)
    box = rng.uniform(-0.6, 0.6, (40 * COUNT, 3))
    inside = np.zeros(len(box), dtype=bool)
    for j, run in enumerate(stack.runs):
        here = (box[:, 2] >= stack.breaks[j]) & (box[:, 2] < stack.breaks[j + 1])
        within = np.array([wall.foot(box[here]).distance < 0 for wall in run.walls])
        outer = len(run.walls) - run.holes
        inside[here] = within[:outer].any(axis=0) & ~within[outer:].any(axis=0)
    points = box[inside][:COUNT]
    points = points + SIGMA * rng.standard_normal(points.shape)
    strays = rng.uniform(-0.6, 0.6, (int(STRAYS * 1.2**3), 3))
    density = Density(np.log([COUNT / stack_volume(stack)]))
    return np.concatenate([points, strays]), model_of(stack, SIGMA, density, STRAYS, 1.2**3)


def one_run(name: str) -> Stack:
    return Stack(BREAKS, (Run((WALLS[name],)),))


def shifted(points: Floats, model: ExactModel, i: int, step: float) -> float:
    """Value of the likelihood with the i-th parameter of its score moved."""
    vector, breaks = model.vector.copy(), model.stack.breaks.copy()
    tilt = np.zeros(3)
    last = model.size + len(breaks)
    if i < model.size:
        vector[i] += step
    elif i < last:
        breaks[i - model.size] += step
    elif i < last + 2:
        tilt[i - last] = step
        points = Rotation.from_rotvec(tilt).apply(points)
    elif i == last + 2:
        model = replace(model, sigma=model.sigma * np.exp(step))
    else:
        model = replace(model, stray=model.stray * np.exp(step))
    return value_of(points, model.moved(vector, breaks))


def assert_slopes(points: Floats, model: ExactModel, *, rounded: bool = False) -> None:
    """Scores are the values' central differences, to a fraction of what chance makes of them."""
    found, step = evaluate(points, model).derivatives(), 1e-6
    count = len(found.score)
    some = sorted({*range(0, count, 1 + count // 20), *range(model.size, count)})
    slopes = [(shifted(points, model, i, step) - shifted(points, model, i, -step)) / (2 * step) for i in some]
    off = np.abs(found.score[some] - slopes) / np.sqrt(np.diag(found.information))[some]
    # A wall's curvature is taken to stay when the wall moves.
    assert off.max() < (0.3 if rounded else 0.05)


@each
def test_scores_are_the_slopes_of_the_value(name: str) -> None:
    points, model = known(one_run(name))
    assert evaluate(points, model).value == pytest.approx(value_of(points, model))
    assert_slopes(points, model, rounded=name in ("rounded", "all at once", "filleted", "filleted, sharp"))


def test_scores_of_several_runs_with_pieces_and_a_hole() -> None:
    hole = Revolved(CENTRE, LineProfile(0.0, 0.12, None))
    pieces = [Swept(Rectangle(np.array([x, 0.0]), 0.2, 0.3, 0.1), 0.1, ORIGIN, ORIGIN) for x in (-0.2, 0.25)]
    stack = Stack(
        np.array([-0.4, -0.1, 0.1, 0.35]),
        (Run((WALLS["cylinder"],)), Run((WALLS["cylinder"], hole), holes=1), Run(tuple(pieces))),
    )
    points, model = known(stack)
    assert_slopes(points, model)
    assert share_of(points, model)[:COUNT].mean() > 0.98
    assert share_of(points, model)[COUNT:].mean() < 0.4


@each
def test_at_the_truth_scores_are_what_chance_makes_of_them(name: str) -> None:
    """Neither noise nor the curvature of a wall pulls it to one side."""
    points, model = known(one_run(name))
    found = evaluate(points, model).derivatives()
    moving = model.size + len(model.stack.breaks)
    deviations = (found.score / np.sqrt(np.diag(found.information)))[:moving]
    assert np.abs(deviations).max() < 4
    assert (deviations**2).mean() < 2.5


@each
def test_the_integration_points_hold_the_volume(name: str) -> None:
    _, model = known(one_run(name))
    assert mass_nodes(model, wall_nodes(model))[1].sum() == pytest.approx(stack_volume(model.stack), rel=2e-3)


def test_a_ring_is_pulled_nowhere_where_its_walls_meet() -> None:
    walls = tuple(Revolved(CENTRE, ArcProfile(0.0, 0.35, 0.12, side)) for side in (1, -1))
    points, model = known(Stack(np.array([-0.12, 0.12]), (Run(walls, 1),)))
    model = natural_joins(tied(model, [((0, 0, k), (0, 1, k)) for k in range(5)]))
    assert (model.size, model.joins) == (5, ("pole", "pole"))
    found = evaluate(points, model).derivatives()
    assert np.abs(found.score / np.sqrt(np.maximum(np.diag(found.information), 1e-12)))[:5].max() < 3
    larger = joined(model.moved(model.vector + [0, 0, 0, 0.01, 0], model.stack.breaks))
    assert value_of(points, larger) < value_of(points, model)


def test_what_lies_deep_inside_is_left_out_and_the_rest_is_not() -> None:
    points, model = known(one_run("cylinder"))
    beside = beside_walls(points, model, 0.02)
    flat = points[:, :2] - CENTRE
    ends = (points[:, 2] - BREAKS[0], BREAKS[1] - points[:, 2])
    depth = np.min([0.3 - np.hypot(flat[:, 0], flat[:, 1]), *ends], axis=0)
    assert beside[depth < 0.015].all()
    assert not beside[depth > 0.025].any()


def test_walls_that_enclose_nothing_are_not_sound() -> None:
    _, model = known(one_run("cone"))
    assert sound(model)
    assert not sound(model.moved(model.vector, BREAKS[::-1]))
    assert not sound(model.moved(model.vector * [1, 1, -1, 0], BREAKS))
    assert not sound(model.moved(model.vector * np.nan, BREAKS))


def test_what_is_unsound_explains_nothing_and_has_no_slopes() -> None:
    points, model = known(one_run("cylinder"))
    found = evaluate(points, model.moved(model.vector, BREAKS[::-1]))
    assert found.value == -np.inf
    with pytest.raises(ValueError, match="not sound"):
        _ = found.derivatives()


def test_the_order_of_the_points_is_nothing_to_a_climb() -> None:
    points, model = known(one_run("cylinder"))
    for tilt in (False, True):
        order = np.random.default_rng(0).permutation(len(points))
        plain, turned, _ = climb(points, model, 3, tilt=tilt)
        mixed, again, rotation = climb(points[order], model, 3, tilt=tilt)
        np.testing.assert_allclose(mixed.vector, plain.vector, rtol=0, atol=1e-9)
        np.testing.assert_allclose(again, turned[order], rtol=0, atol=1e-9)
        np.testing.assert_allclose(again, points[order] @ rotation, rtol=0, atol=1e-15)


@pytest.mark.parametrize("name", [name for name in WALLS if name != "loft"])  # which has farther to go
def test_a_climb_ends_near_the_top(name: str) -> None:
    points, model = known(one_run(name))
    push = SIGMA * np.random.default_rng(1).standard_normal(model.size)
    off = replace(model, sigma=3 * SIGMA).moved(model.vector + push, BREAKS + [SIGMA, -SIGMA])
    found, _, _ = climb(points, off, 12, noise=True, strays=True)
    top, _, _ = climb(points, found, 60, noise=True, strays=True, enough=1e-9)
    assert value_of(points, off) < value_of(points, found) - 10
    assert value_of(points, top) < value_of(points, found) + 0.1


@pytest.mark.parametrize("name", [name for name in WALLS if name != "loft"])
def test_what_its_limit_holds_does_not_keep_the_rest_from_the_top(name: str) -> None:
    """No strays are left to lose, and the noise may not become what it is."""
    points, model = known(one_run(name))
    inner = points[share_of(points, model) > 0.5]
    push = SIGMA * np.random.default_rng(1).standard_normal(model.size)
    off = replace(model, stray=FEWEST / model.space, sigma=0.7 * SIGMA)
    off = off.moved(model.vector + push, BREAKS + [SIGMA, -SIGMA])
    found, _, _ = climb(inner, off, 12, noise=True, strays=True, most=0.7 * SIGMA)
    top, _, _ = climb(inner, replace(found, stray=off.stray), 60, enough=1e-9)
    assert value_of(inner, top) < value_of(inner, found) + 0.1


def test_pieces_that_overlap_and_holes_that_break_through_are_unsound() -> None:
    """Where pieces overlapped, their points would be explained twice."""

    def stack(*, apart: float, out: float) -> Stack:
        first, second = (
            Swept(Rectangle(np.array([x, 0.0]), 0.2, 0.3, 0.1), 0.1, ORIGIN, ORIGIN) for x in (0, apart)
        )
        outer = Revolved(ORIGIN, LineProfile(0.0, 0.2, None))
        hole = Revolved(np.array([out, 0.0]), LineProfile(0.0, 0.1, None))
        return Stack(np.array([-0.3, 0.0, 0.3]), (Run((first, second)), Run((outer, hole), holes=1)))

    assert sound(known(stack(apart=0.25, out=0.05))[1])
    assert not sound(known(stack(apart=0.15, out=0.05))[1])
    assert not sound(known(stack(apart=0.25, out=0.15))[1])


@pytest.mark.parametrize("drawn", [Polygon, spline_loop, lambda ring: RoundedPolygon(ring, 0.01)])
def test_an_outline_turned_inside_out_is_unsound(drawn: Callable[[Floats], Outline]) -> None:
    """All the rest of the world would be inside, and explain any cloud."""

    def prism(ring: Floats) -> Stack:
        return Stack(BREAKS, (Run((Swept(drawn(ring), 0.05, ORIGIN, ORIGIN),)),))

    model = known(prism(ELL))[1]
    assert sound(model)
    assert not sound(replace(model, stack=prism(ELL[::-1])))


def test_a_slit_that_nobody_draws_is_seen() -> None:
    """By chance no points lie in a thin enough cut, so that a polygon would explain them a little better."""

    def prism(half_width: float) -> Stack:
        cut = [[0.2, 0.15 + half_width], [-0.1, 0.15], [0.2, 0.15 - half_width]]
        vertices = np.array([[-0.2, 0.0], [0.2, 0.0], *cut[::-1], [0.2, 0.3], [-0.2, 0.3]])
        return Stack(np.array([-0.3, 0.3]), (Run((Swept(Polygon(vertices), 0.0, ORIGIN, ORIGIN),)),))

    assert slits(known(prism(0.07))[1]) == 0
    assert 0 < slits(known(prism(0.05))[1]) < 1
    assert 1 < slits(known(prism(0.01))[1]) < 2  # a thinner one counts more, lest one be widened for nothing


def test_points_in_any_order_have_the_same_likelihood() -> None:
    points, model = known(one_run("cone"))
    order = np.random.default_rng(3).permutation(len(points))
    assert value_of(points[order], model) == pytest.approx(value_of(points, model), rel=1e-12)
    assert (beside_walls(points, model, 0.02)[order] == beside_walls(points[order], model, 0.02)).all()
    assert share_of(points, model)[order] == pytest.approx(share_of(points[order], model), abs=1e-12)


def test_strays_cost_what_they_are_expected_to_be() -> None:
    """More of them than there are explain nothing better: no model wins by calling its points strays."""
    points, model = known(one_run("cylinder"))
    strays = [replace(model, stray=model.stray * factor) for factor in (0.3, 1.0, 4.0)]
    few, right, many = (value_of(points, other) for other in strays)
    assert right > max(few, many)
