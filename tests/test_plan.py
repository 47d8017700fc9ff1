"""Plans: what is found can be written down, read back as the same model, edited, and is checked."""

from __future__ import annotations

import json
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchloft.cli import _exit_code
from sketchloft.cloud import PointCloud
from sketchloft.errors import InputError, OutputError, UsageError
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import ExactModel, model_of, tied
from sketchloft.exact.model.joins import joined
from sketchloft.exact.model.kinks import with_kink
from sketchloft.exact.model.surgery import with_run
from sketchloft.exact.planned import planned_body
from sketchloft.frame import Frame
from sketchloft.outline.circle import Circle
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.outline.rounded_polygon import RoundedPolygon
from sketchloft.outline.spline_loop import spline_loop
from sketchloft.outline.stadium import Stadium
from sketchloft.outline.star import Star
from sketchloft.pipeline import Params, reconstruct
from sketchloft.plan.from_model import planned_from_model
from sketchloft.plan.legend import LEGEND
from sketchloft.plan.plan import Plan
from sketchloft.plan.read import parse_plan, read_plan
from sketchloft.plan.to_model import model_from_plan
from sketchloft.plan.walls import FORMS, kind_of
from sketchloft.plan.write import plan_text, write_plan
from sketchloft.stack import Run, Stack, Wall
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import lofted
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

CENTRE = np.array([0.03, -0.02])
KNOTS = np.array([-0.35] * 4 + [0.02] + [0.35] * 4)
ELL = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]) / 5 - 0.16
FLOWER = spline_loop(
    np.array(
        [
            [(2 + np.cos(3 * a)) * np.cos(a), (2 + np.cos(3 * a)) * np.sin(a)]
            for a in np.arange(12) * np.pi / 6
        ]
    )
    / 10
)
BULGES = np.array([0, 0.3, 0, -0.4, 0.2, 0])
OUTLINES: list[Outline] = [
    Circle(CENTRE, 0.3),
    Ellipse(CENTRE, 0.3, 0.2, 0.7),
    Rectangle(CENTRE, 0.4, 0.3, 0.4),
    RoundedRectangle(CENTRE, 0.4, 0.3, 0.4, 0.05),
    Stadium(CENTRE, 0.3, 0.1, 0.4),
    RegularPolygon(CENTRE, 0.3, 0.2, 6),
    Star(CENTRE, 0.4, 0.2, 0.1, 5),
    RectilinearPolygon(np.array([-0.2, 0.3, 0.2, 0.1, 0.05, -0.3]), 0.4),
    Polygon(ELL),
    RoundedPolygon(ELL, 0.02),
    LineArc(ELL, np.array([0, 0.3, 0, -0.4, 0.2, 0]), np.array([0, 1, 0, 1, 1, 0], dtype=bool)),
    FLOWER.moved(0.01 * np.cos(np.arange(12.0))),
]
RINGS = np.stack([scale * FLOWER.poles for scale in (0.8, 1.0, 1.1, 0.9, 0.7)])
WALLS: list[Wall] = [
    Revolved(CENTRE, LineProfile(0.0, 0.3, None)),
    Revolved(CENTRE, LineProfile(0.1, 0.3, -0.4)),
    Revolved(CENTRE, ArcProfile(0.05, None, 0.4)),
    Revolved(CENTRE, ArcProfile(0.05, 0.5, 0.45, -1)),
    Revolved(CENTRE, ArcProfile(-0.05, 0.1, 0.45, 1)),
    Revolved(CENTRE, SplineProfile(KNOTS, np.array([0.2, 0.3, 0.35, 0.3, 0.25]))),
    lofted(RINGS, KNOTS),
    Filleted(RoundedRectangle(CENTRE, 0.4, 0.3, 0.4, 0.05), None, "bottom", -0.3, 0.3),
    Filleted(Rectangle(CENTRE, 0.4, 0.3, 0.4), 0.05, "both", -0.3, 0.3),
    Ruled(Polygon(ELL), LineArc(0.8 * ELL, BULGES, BULGES != 0), -0.3, 0.3),
    Ruled(Rectangle(CENTRE, 0.4, 0.3, 0.4), DividedCircle(CENTRE, 0.15, 1.1, -0.1), -0.3, 0.3),
    Ruled(DividedCircle(CENTRE, 0.15, 1.1, -0.1), Rectangle(CENTRE, 0.4, 0.3, 0.4), -0.3, 0.3),
    Ruled(Rectangle(CENTRE, 0.4, 0.3, 0.4), Rectangle(np.zeros(2), 0.2, 0.25, 0.3), -0.3, 0.3),
    *(Swept(outline, 0.1, np.zeros(2), np.zeros(2)) for outline in OUTLINES),
    *(
        Swept(
            outline, 0.1, np.array([0.01, 0.02]), np.array([0.1, -0.2]), 0.3, 0.5, ("drift", "taper", "twist")
        )
        for outline in OUTLINES
    ),
    Swept(OUTLINES[2], 0.0, np.zeros(2), np.zeros(2), 0.0, 0.5, ("twist",)),
    Swept(OUTLINES[2], 0.0, CENTRE, np.zeros(2), 0.3, 0.0, ("taper",)),
    *(
        Swept(outline, 0.1, np.array([0.01, 0.02]), np.zeros(2), 0.3, 0.0, ("taper", "bow"), 1.5)
        for outline in OUTLINES
    ),
]
BOX = """
[[body]]
name = "box"
direction = [0, 0, 1]
x_axis = [1, 0, 0]
centre = [10, 20, 30]
noise = 0.01
breaks = [{ height = -3 }, { height = 0.0, join = "step" }, { height = 3 }]

[body.shared]
middle = [0.1, 0]

[[body.run]]
[[body.run.wall]]
kind = "cylinder"
centre = "middle"
radius = 2
[[body.run.wall]]
kind = "rectangle"
hole = true
centre = [0, 0]
width = 1
depth = 1.5
angle = 30

[[body.run]]
[[body.run.wall]]
kind = "cone"
centre = "middle"
radius = 1.5
slope = -0.1
height = 0
"""


def model(*runs: Run, breaks: np.ndarray | None = None) -> ExactModel:
    heights = np.linspace(-0.3, 0.3, len(runs) + 1) if breaks is None else breaks
    return model_of(Stack(heights, runs), 0.002, Density(np.zeros(1)), 1.0, 1.0)


def text_of(found: ExactModel, scale: float = 7.0, frame: Frame | None = None) -> str:
    body = planned_from_model("thing", found, frame or Frame(np.eye(3)), np.array([1e4, 2, 3]), scale)
    return plan_text(Plan("mm", "nothing", (body,)))


def back(text: str, scale: float = 7.0) -> ExactModel:
    return model_from_plan(parse_plan(text).bodies[0], scale)


def assert_same(one: ExactModel, other: ExactModel) -> None:
    assert one.joins == other.joins
    assert [[s.tolist() for s in row] for row in one.slots] == [
        [s.tolist() for s in row] for row in other.slots
    ]
    np.testing.assert_allclose(other.stack.breaks, one.stack.breaks, rtol=1e-9, atol=1e-9)
    assert other.sigma == pytest.approx(one.sigma, rel=1e-12)
    points = np.random.default_rng(0).uniform(-0.3, 0.3, (50, 3))
    for run, again in zip(one.stack.runs, other.stack.runs, strict=True):
        assert run.holes == again.holes
        for wall, wall_again in zip(run.walls, again.walls, strict=True):
            assert wall_again.kind == wall.kind
            assert len(wall_again.vector) == len(wall.vector)
            np.testing.assert_allclose(
                wall_again.foot(points).distance, wall.foot(points).distance, atol=1e-9
            )


def test_every_kind_is_tried_and_explained() -> None:
    assert {kind_of(wall) for wall in WALLS} == set(FORMS)
    for kind, form in FORMS.items():
        assert re.search(rf"^# +{kind}  ", LEGEND, re.MULTILINE), kind
        for field in form.fields:
            assert field.name in LEGEND


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.kind)
@settings(max_examples=8, deadline=None)
@given(scale=st.floats(1e-4, 1e4), seed=st.integers(0, 99))
def test_every_wall_comes_back(wall: Wall, scale: float, seed: int) -> None:
    change = np.random.default_rng(seed).normal(0, 0.01, len(wall.vector))
    moved = wall.moved(wall.vector * (1 + change) + 0.001 * change)
    found = model(Run((moved,)))
    text = text_of(found, scale)
    assert_same(found, back(text, scale))
    assert plan_text(parse_plan(text)) == text


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6))
def test_frames_come_back(seed: int) -> None:
    axes = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    axes *= np.sign(np.linalg.det(axes))
    body = parse_plan(text_of(model(Run((WALLS[0],))), 1.0, Frame(axes))).bodies[0]
    np.testing.assert_allclose(body.frame.axes, axes, atol=1e-14)
    assert body.centre.tolist() == [1e4, 2, 3]


def bullet() -> ExactModel:
    """A half sphere under a cylinder, a cone on it, and a step above that; all on one axis."""
    runs = [
        Run((Revolved(CENTRE, profile),))
        for profile in (
            ArcProfile(0.0, None, 0.2),
            LineProfile(0.0, 0.2, None),
            LineProfile(0.3, 0.2, -0.25),
            LineProfile(0.0, 0.1, None),
        )
    ]
    found = model(*runs, breaks=np.array([-0.2, 0.0, 0.3, 0.5, 0.6]))
    found = tied(found, [((0, 0, k), (j, 0, k)) for j in (1, 2) for k in (0, 1)])
    return joined(replace(found, joins=("pole", "tangent", "cross", "step", "step")))


def test_joins_and_ties_come_back() -> None:
    text = text_of(bullet())
    assert text.count('centre = "axis"') == 3
    assert_same(bullet(), back(text))
    assert_same(bullet(), back(plan_text(parse_plan(text))))


def house(*, both_ways: bool) -> ExactModel:
    """A box under a roof that leaves its outline."""
    box = Rectangle(CENTRE, 0.4, 0.3, 0.4)
    roof: Wall = Swept(box, 0.05, CENTRE, np.zeros(2), -0.8, 0.0, ("taper",))
    if both_ways:
        roof = Ruled(box, Rectangle(CENTRE, 0.2, 0.05, 0.4), 0.05, 0.3)
    base = model(Run((prism_on(box),)), Run((prism_on(FLOWER),)), breaks=np.array([-0.3, 0.05, 0.3]))
    above = Run((roof,)) if both_ways else with_kink(base.stack.runs[0], Run((roof,)))[1]
    return with_run(base, 1, above)


def prism_on(outline: Outline) -> Swept:
    return Swept(outline, 0.0, CENTRE, np.zeros(2))


@pytest.mark.parametrize("both_ways", [False, True])
def test_a_roof_and_what_it_stands_on_come_back(*, both_ways: bool) -> None:
    found = house(both_ways=both_ways)
    text = text_of(found)
    assert found.joins[1] == ("step" if both_ways else "cross")
    assert found.size == 7  # of the box five; and a slope and a height, or two sides
    names = ["angle", "bottom_angle", "top_angle"] if both_ways else ["angle"] * 2
    assert all(f'{name} = "angle"' in text for name in names)
    assert_same(found, back(text))


def test_the_break_below_a_roof_goes_with_its_height() -> None:
    text = text_of(house(both_ways=False))
    higher = re.sub(r"^height = \S+\ntaper", "height = 0.7\ntaper", text, flags=re.MULTILINE)
    assert back(higher).stack.breaks[1] == pytest.approx(0.1)
    straight = re.sub(r"^taper = \S+", "", text, flags=re.MULTILINE)
    with pytest.raises(InputError, match=r'found join = "cross", but .* do not cross there'):
        back(straight)


def test_breaks_follow_their_walls_when_these_are_edited() -> None:
    text = text_of(bullet())
    wide = re.sub(r"(kind = \"sphere\"\ncentre = \"axis\"\nheight = 0.0\nradius = )\S+", r"\g<1>2.1", text)
    assert back(wide).stack.breaks[0] == pytest.approx(-0.3)
    thin = re.sub(r"(kind = \"cylinder\"\ncentre = \"axis\"\nradius = )\S+", r"\g<1>1.33", text, count=1)
    assert back(thin).stack.breaks[2] == pytest.approx(0.3 + 0.01 / 0.25)
    step = re.sub(r"\{ near = \S+ join = \"cross\"", '{ height = 2.45, join = "step"', text)
    assert back(step).stack.breaks[2] == pytest.approx(0.35)
    away = text.replace("slope = -0.25", "slope = 0.0")
    with pytest.raises(InputError, match=r'body 1: break 3: found join = "cross", but .* do not cross there'):
        back(away)


def test_a_join_that_walls_do_not_make_is_written_as_a_step() -> None:
    runs = [Run((Revolved(CENTRE, LineProfile(0.0, radius, None)),)) for radius in (0.2, 0.3)]
    found = replace(model(*runs), joins=("step", "cross", "pole"))
    assert back(text_of(found)).joins == ("step", "step", "step")


def test_edits_are_kept() -> None:
    first, second = back(BOX, 1.0).stack.runs
    assert (first.holes, len(first.walls)) == (1, 2)
    assert isinstance(first.walls[1], Swept)
    assert first.walls[1].outline.vector.tolist() == pytest.approx([0, 0, 1, 1.5, np.pi / 6])
    assert second.walls[0].kind == "cone"
    straight = back(BOX.replace("slope = -0.1\n", ""), 1.0).stack.runs[1].walls[0]
    assert straight.kind == "cylinder"
    hole = BOX[
        BOX.index('[[body.run.wall]]\nkind = "rectangle"') : BOX.index(
            '[[body.run]]\n[[body.run.wall]]\nkind = "cone"'
        )
    ]
    assert back(BOX.replace(hole, ""), 1.0).stack.runs[0].holes == 0
    rounded = BOX.replace('"rectangle"', '"rounded rectangle"').replace("depth", "corner_radius = 0.2\ndepth")
    assert back(rounded, 1.0).stack.runs[0].walls[1].kind == "rounded rectangle"
    assert back(BOX.replace("height = 0.0", "height = 1.0"), 1.0).stack.breaks.tolist() == [-3, 1, 3]
    shared = back(BOX, 1.0)
    assert shared.slots[0][0][:2].tolist() == shared.slots[1][0][:2].tolist()
    assert shared.size == 3 + 5 + 2


WRONG = {
    "no TOML": ("[[body]]", "[[body", "is not valid TOML"),
    "missing key": (
        "radius = 2\n",
        "",
        "body 1, run 1, wall 1: the key 'radius' is missing; .* 'cylinder' needs",
    ),
    "no kind": (
        'kind = "cone"\n',
        "",
        "run 2, wall 1: the key 'kind' is missing; expected one of cylinder, cone",
    ),
    "unknown key": (
        "radius = 2",
        "radios = 2",
        "unknown key 'radios'; the keys of .* are kind, centre, radius",
    ),
    "key of the body": (
        "noise",
        "noize",
        "body 1: unknown key 'noize'; the keys of a body are name, direction",
    ),
    "key of another kind": (
        '"cone"',
        '"cylinder"',
        "unknown key 'slope'; .* kind 'cylinder' are kind, centre",
    ),
    "unknown kind": ('"cone"', '"come"', "kind: found 'come', expected one of cylinder, cone, sphere"),
    "text for a number": (
        "radius = 2",
        'radius = "two"',
        "radius: found 'two', expected a value, or a name of",
    ),
    "truth for a number": ("radius = 2", "radius = true", "radius: found True, expected a number"),
    "not positive": ("radius = 2", "radius = -2", "radius: found -2, expected a positive number"),
    "not finite": ("radius = 2", "radius = nan", "radius: found nan, expected a number, all of them finite"),
    "huge": ("radius = 2", f"radius = 1{400 * '0'}", r"radius: found 10+\.\.\., expected a number"),
    "no point": (
        "centre = [0, 0]",
        "centre = [0, 0, 0]",
        r"centre: found \[0, 0, 0\], expected a point \[x, y\]",
    ),
    "shared, no point": ("middle = [0.1, 0]", "middle = 0.1", r"centre: middle: found 0.1, expected a point"),
    "shared, unknown": ("middle = [", "axis = [", "found 'middle', expected a value, or a name of .*: axis"),
    "breaks": (
        "height = 0.0",
        "height = 3.5",
        "body 1: break 3: found the height 3 after 3.5, expected one above",
    ),
    "one break too few": (
        ", { height = 3 }",
        "",
        "found 2 breaks and 2 runs, expected one break more than runs",
    ),
    "join": ('"step"', '"stop"', "break 2: join: found 'stop', expected one of step, cross, tangent, pole"),
    "no pole": ("{ height = -3 }", '{ near = -3, join = "pole" }', 'break 1: found join = "pole", but'),
    "height of a cross": ('"step"', '"cross"', "break 2: unknown key 'height'; the keys of a cross are near"),
    "only a hole": ("radius = 2\n", "radius = 2\nhole = true\n", "run 1: expected walls that are no holes"),
    "axis": ("x_axis = [1, 0, 0]", "x_axis = [0, 0, 2]", "x_axis: is along the direction, or one is zero"),
    "direction": (
        "direction = [0, 0, 1]",
        "direction = [0, 0, 0]",
        "x_axis: is along the direction, or one is",
    ),
    "fit": ("[[body]]\n", 'fit = "all"\n[[body]]\n', "fit: found 'all', expected one of nothing, sizes"),
    "body": ("[[body]]", "[body]", "body: found .*, expected one table or more"),
    "mixed": (
        "radius = 1.5\nslope = -0.1",
        'radius = "tilt"\nslope = "tilt"\n',
        "tilt: found -0.1, expected a positive",
    ),
}


@pytest.mark.parametrize(("old", "new", "message"), WRONG.values(), ids=WRONG.keys())
def test_mistakes_are_told_with_their_place(old: str, new: str, message: str) -> None:
    assert BOX.count(old) >= 1
    text = BOX.replace(old, new, 1).replace("middle = [", "tilt = -0.1\nmiddle = [")
    with pytest.raises(InputError, match=message):
        parse_plan(text)


def wall_text(**fields: object) -> str:
    head = BOX[: BOX.index("[[body.run]]")].replace('{ height = 0.0, join = "step" }, ', "")
    lines = [f"{name} = {json.dumps(value)}" for name, value in fields.items()]
    return "\n".join([head, "[[body.run]]", "[[body.run.wall]]", *lines])


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        (
            {"kind": "polygon", "vertices": [[0, 0], [0, 1], [1, 0]]},
            "wall 1: found points that run clockwise",
        ),
        (
            {"kind": "polygon", "vertices": [[0, 0], [1, 0]]},
            "vertices: found a list of 2, expected at least 3",
        ),
        ({"kind": "polygon", "vertices": [[0, 0], [1]]}, r"expected a list of points \[x, y\]"),
        (
            {"kind": "rectilinear polygon", "offsets": [-1, 1, 1, 0.5, 0], "angle": 0},
            "found 5 offsets, expected an even number",
        ),
        ({"kind": "line-arc", "vertices": [[0, 0], [1, 0]], "bulges": [1]}, "2 vertices and 1 bulges"),
        (
            {"kind": "regular polygon", "centre": [0, 0], "radius": 1, "angle": 0, "sides": 2.5},
            "sides: found 2.5, expected a whole number from 3",
        ),
        (
            {
                "kind": "torus",
                "centre": [0, 0],
                "height": 0,
                "minor_radius": 9,
                "major_radius": 9,
                "side": "up",
            },
            "side: found 'up', expected one of 'outer', 'inner'",
        ),
        (
            {
                "kind": "spline revolve",
                "centre": [0, 0],
                "knots": [*[-2] * 4, *[3] * 4],
                "radii": [1, 1, 1, 1],
            },
            "found knots from -2 to 3, expected them to reach from -3 to 3",
        ),
        (
            {
                "kind": "spline revolve",
                "centre": [0, 0],
                "knots": [*[-3] * 4, *[3] * 4],
                "radii": [1, 1, 1, 1, 1],
            },
            "found 8 knots and 5 radii, expected 4 knots more than radii",
        ),
        (
            {"kind": "spline revolve", "centre": [0, 0], "knots": [*range(8)], "radii": [1, 1, 1, 1]},
            "expected the first and the last one four times",
        ),
        (
            {"kind": "circle", "centre": [0, 0], "radius": 1, "taper": -0.5},
            "found a wall that comes to a point at 2, expected none within the run",
        ),
        ({"kind": "circle", "centre": "r", "radius": 1}, r"name of \[body.shared\]: middle"),
    ],
)
def test_walls_that_cannot_be(fields: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_plan(wall_text(**fields))


def test_a_value_cannot_be_shared_by_what_is_measured_differently() -> None:
    text = wall_text(kind="rectangle", centre=[0, 0], width="s", depth=1, angle="s")
    with pytest.raises(InputError, match="shared: s: found in use as length and as angle"):
        parse_plan(text.replace("middle = ", "s = 1.0\nmiddle = "))


def cylinder(count: int = 2500) -> np.ndarray:
    points = np.random.default_rng(1).uniform(-1, 1, (2 * count, 3))
    points = points[np.hypot(points[:, 0], points[:, 1]) < 1][:count]
    return points * [2, 2, 3] + [10, 20, 30]


def test_sizes_are_fitted_and_the_rest_is_kept() -> None:
    text = wall_text(kind="cylinder", centre="middle", radius=1.8).replace("-3 }", "-2.8 }")
    points = cylinder()
    for direction in ([0.0, 0.0, 1.0], [0.02, 0.0, 1.0]):
        plan = parse_plan(text.replace("direction = [0, 0, 1]", f"direction = {direction}")).bodies[0]
        kept = planned_body(points, np.zeros(3), plan, lambda _: None, fit=False)
        assert kept.model.stack.runs[0].walls[0].vector[2] * kept.scale == pytest.approx(1.8, rel=1e-12)
        assert kept.facts.volume == pytest.approx(np.pi * 1.8**2 * 5.8, rel=1e-9)
        found = planned_body(points, np.zeros(3), plan, lambda _: None, fit=True)
        np.testing.assert_allclose(found.vector, np.divide(direction, np.linalg.norm(direction)), atol=1e-15)
        wall = found.model.stack.runs[0].walls[0]
        assert wall.kind == "cylinder"
        assert wall.vector * found.scale == pytest.approx([0, 0, 2], abs=0.02)
        assert found.model.stack.breaks * found.scale == pytest.approx([-3, 3], abs=0.02)


def test_a_plan_has_as_many_bodies_as_the_cloud() -> None:
    text = wall_text(kind="cylinder", centre="middle", radius=2.0)
    two = parse_plan(text + text.replace('"box"', '"other"').replace("centre = [10,", "centre = [40,"))
    near, far = cylinder(), cylinder(1500) + [30, 0, 0]
    both = PointCloud.of(np.concatenate([near, far]))
    bodies = reconstruct(both, Params(plan=two)).bodies
    assert [body.name for body in bodies] == ["box", "other"]
    assert [body.facts.bounds.mean(axis=0)[0] for body in bodies] == pytest.approx([10.1, 40.1])
    with pytest.raises(InputError, match="the plan has 2 bodies, the cloud is separated into 1"):
        reconstruct(PointCloud.of(near), Params(plan=two))
    with pytest.raises(UsageError, match="the method paper follows no plan"):
        reconstruct(both, Params("paper", plan=two))


def test_files_that_cannot_be_read_or_written(tmp_path: Path) -> None:
    path = tmp_path / "plan.toml"
    with pytest.raises(InputError, match=r"plan\.toml: cannot be read: No such file"):
        read_plan(path)
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match="is no text in UTF-8"):
        read_plan(path)
    plan = parse_plan(BOX.replace('"box"', r'"Stück \u007f \"1\""'))
    write_plan(plan, path)
    assert list(tmp_path.iterdir()) == [path]
    assert read_plan(path).bodies[0].name == 'Stück \x7f "1"'
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert plan_text(read_plan(path)) == plan_text(plan)
    with pytest.raises(OutputError, match="cannot be written"):
        write_plan(plan, tmp_path / "none" / "plan.toml")


def run(*arguments: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    code = _exit_code(list(arguments))
    out, err = capsys.readouterr()
    return code, out, err


def test_the_command_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("sample", "lamp", "-n", "3000", "-o", "lamp.ply", capsys=capsys)[0] == 0
    assert run("build", "lamp.ply", "--axis", "z", "--save-plan", "plan.toml", capsys=capsys)[0] == 0
    again = ("build", "lamp.ply", "--json", "--plan")
    code, out, _ = run(*again, "plan.toml", "--save-plan", "again.toml", capsys=capsys)
    assert code == 0
    kept = json.loads(out)
    assert kept["written"] == ["lamp.step", "again.toml"]
    assert kept["bodies"][0]["runs"] == [["cylinder"], ["rectangle"], ["cone"]]
    assert sum(kept["bodies"][0]["faces"].values()) == 10
    numbers = [
        np.array(re.findall(r"-?\d+\.\d+(?:e-?\d+)?", Path(name).read_text()), dtype=float)
        for name in ("plan.toml", "again.toml")
    ]
    np.testing.assert_allclose(numbers[1], numbers[0], rtol=1e-9, atol=1e-12)

    text = Path("plan.toml").read_text()
    edited = re.sub(r"radius = \S+", "radius = 5.5", text, count=1).replace('"lamp"', '"my lamp"')
    Path("edited.toml").write_text(edited)
    code, out, _ = run(*again, "edited.toml", capsys=capsys)
    wide = json.loads(out)["bodies"][0]
    assert (code, wide["name"]) == (0, "my lamp")
    body = tomllib.loads(text)["body"][0]
    heights = [at["height"] for at in body["breaks"][:2]]
    radius = body["run"][0]["wall"][0]["radius"]
    more = np.pi * (5.5**2 - radius**2) * (heights[1] - heights[0])
    assert wide["volume"] - kept["bodies"][0]["volume"] == pytest.approx(more, rel=1e-6)

    for arguments, code, message in (
        (("--plan", "plan.toml", "--method", "paper"), 2, "leave out --plan or --method paper"),
        (("--save-plan", "p.toml", "--method", "paper"), 2, "leave out --save-plan or --method paper"),
        (("--save-plan", "lamp.ply"), 2, "expected a name that ends in .toml"),
        (("--plan", "plan.toml", "--axis", "z"), 2, "the plan says the direction"),
        (("--plan", "plan.toml", "--unit", "cm"), 2, "give --unit mm"),
        (("--plan", "lamp.ply"), 3, "lamp.ply: "),
    ):
        found, _, err = run("build", "lamp.ply", *arguments, capsys=capsys)
        assert (found, err.count("\n")) == (code, 1)
        assert message in err
