"""The exact solid of a stack: its faces by kind, its volume, how runs join, and what is refused."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchloft.brep.build_stack import built_stack
from sketchloft.brep.check import check_closed
from sketchloft.brep.check_stack import check_stack
from sketchloft.brep.clearance import check_walls
from sketchloft.brep.facts import SolidFacts, solid_facts
from sketchloft.brep.files import read_model, write_model
from sketchloft.brep.meridian import Straight, meridian
from sketchloft.brep.model import NamedSolid
from sketchloft.brep.overlay import overlay
from sketchloft.brep.section_rims import section_of
from sketchloft.brep.stack_blocks import block_of
from sketchloft.brep.stack_solid import stack_solid
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.outline.circle import Circle
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RegularPolygon, RoundedRectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.spline_loop import spline_loop
from sketchloft.outline.stadium import Stadium
from sketchloft.stack import Run, Stack, Wall
from sketchloft.stack_distance import distance_from_stack
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.lofted import lofted
from sketchloft.wall.profile import ArcProfile, LineProfile, SplineProfile
from sketchloft.wall.revolved import Revolved
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

AXIS = np.array([0.1, 0.2])
LONG = np.r_[[-0.1] * 4, 0.3, 0.6, [1.1] * 4]
"""Knots that reach beyond a run from 0 to 1."""
ELL = np.array([(0.0, 0), (1, 0), (1, 0.4), (0.4, 0.4), (0.4, 1), (0, 1)]) / 1.5
KIDNEY = np.array(
    [(np.cos(t) * (0.4 + 0.1 * np.cos(3 * t)), 0.3 * np.sin(t)) for t in np.arange(10) * np.pi / 5]
)


def stack(breaks: list[float], *runs: Wall | Run) -> Stack:
    return Stack(np.array(breaks), tuple(run if isinstance(run, Run) else Run((run,)) for run in runs))


def cylinder(radius: float, at: Floats = AXIS) -> Revolved:
    return Revolved(at, LineProfile(0.0, radius, None))


def cone(height: float, radius: float, slope: float) -> Revolved:
    return Revolved(AXIS, LineProfile(height, radius, slope))


def sphere(height: float, radius: float, at: Floats = AXIS) -> Revolved:
    return Revolved(at, ArcProfile(height, None, radius))


def torus(height: float, offset: float, radius: float, side: int = 1) -> Revolved:
    return Revolved(AXIS, ArcProfile(height, offset, radius, side))


def swept(outline: Outline, height: float = 0.0, **moves: object) -> Swept:
    return Swept(outline, height, **{"pivot": AXIS, "drift": np.zeros(2), **moves})  # type: ignore[arg-type]


def rectangle(width: float, depth: float, at: Floats = AXIS, angle: float = 0.3) -> Rectangle:
    return Rectangle(at, width, depth, angle)


def free_loft() -> Wall:
    rows = [KIDNEY * (1 + 0.2 * np.sin(k)) + [0.05 * k, 0] for k in range(6)]
    return lofted(np.array(rows), LONG)


def vase() -> Revolved:
    return Revolved(AXIS, SplineProfile(LONG, np.array([0.3, 0.35, 0.4, 0.2, 0.15, 0.2])))


def waist(one: float, r_one: float, other: float, r_other: float) -> float:
    """Height where two spheres on one axis cross."""
    return (r_one**2 - r_other**2 - one**2 + other**2) / (2 * (other - one))


BOX = Rectangle(AXIS, 0.6, 0.5, 0.3)
HEXAGON = RegularPolygon(AXIS, 0.35, 0.1, 6)
HOLLOWED = LineArc(ELL[:4], np.array([0, 0.3, -0.2, 0]), np.array([False, True, True, False]))
PLATE = Rectangle(AXIS, 1.0, 0.6, 0.0)
PINS = [AXIS + [x, y] for x in (-0.3, 0.3) for y in (-0.2, 0.2)]
SPHERES = stack(
    [-0.4, waist(0, 0.4, 0.5, 0.3), waist(0.5, 0.3, 0.85, 0.2), 1.05],
    sphere(0, 0.4), sphere(0.5, 0.3), sphere(0.85, 0.2),
)  # fmt: skip
LAMP = stack([0, 0.1, 0.6, 0.9], cylinder(0.4), swept(rectangle(0.2, 0.1)), cone(0.6, 0.3, -0.5))
SQUARE = RegularPolygon(AXIS, 0.4, 0.0, 4)
ROUND = LineArc(RegularPolygon(AXIS, 0.3, 0.0, 4).chain()[0], np.full(4, np.tan(np.pi / 8)), np.ones(4, bool))
ELLIPSE = Ellipse(AXIS, 0.4, 0.2, 0.2)
CASES: dict[str, tuple[Stack, dict[str, int]]] = {
    "three spheres": (SPHERES, {"SphericalSurface": 3}),
    "lamp": (LAMP, {"ConicalSurface": 1, "CylindricalSurface": 1, "Plane": 8}),
    "L": (stack([0, 0.3], swept(Polygon(ELL))), {"Plane": 8}),
    "stepped shaft": (
        stack([0, 0.3, 0.5, 0.9], cylinder(0.2), cylinder(0.4), cylinder(0.1)),
        {"CylindricalSurface": 3, "Plane": 4},
    ),
    "capsule": (
        stack([0, 0.3, 0.6, 0.9], sphere(0.3, 0.3), cylinder(0.3), sphere(0.6, 0.3)),
        {"CylindricalSurface": 1, "SphericalSurface": 2},
    ),
    "ring": (
        stack([0, 0.2], Run((torus(0.1, 0.4, 0.1), torus(0.1, 0.4, 0.1, -1)), 1)),
        {"ToroidalSurface": 1},
    ),
    "half a ring": (
        stack([0.1, 0.3], Run((torus(0.1, 0.4, 0.2), torus(0.1, 0.4, 0.2, -1)), 1)),
        {"ToroidalSurface": 2, "Plane": 1},
    ),
    "ring on a plate": (
        stack([0, 0.1, 0.3], cylinder(0.7), Run((torus(0.15, 0.4, 0.15), torus(0.15, 0.4, 0.15, -1)), 1)),
        {"ToroidalSurface": 2, "Plane": 3, "CylindricalSurface": 1},
    ),
    "lemon": (stack([-0.5, 0.5], torus(0, -0.1, 0.4)), {"SurfaceOfRevolution": 1}),
    "vase": (stack([0, 1], vase()), {"Plane": 2, "SurfaceOfRevolution": 1}),
    "tube": (stack([0, 0.2], Run((cylinder(0.4), cylinder(0.3)), 1)), {"CylindricalSurface": 2, "Plane": 2}),
    "cup": (
        stack([0, 0.1, 0.4], cylinder(0.3), Run((cylinder(0.3), cylinder(0.25)), 1)),
        {"CylindricalSurface": 2, "Plane": 3},
    ),
    "drilled": (
        stack([0, 0.2, 0.3, 0.5], cylinder(0.4), Run((cylinder(0.4), cone(0.2, 0, 1)), 1),
              Run((cylinder(0.4), cylinder(0.1)), 1)),
        {"ConicalSurface": 1, "CylindricalSurface": 2, "Plane": 2},
    ),
    "U on its side": (
        stack([0, 0.3, 1], swept(rectangle(1, 0.3, angle=0)),
              Run(tuple(swept(rectangle(0.3, 0.3, AXIS + [x, 0], 0)) for x in (-0.35, 0.35)))),
        {"Plane": 10},
    ),
    "hexagon bolt": (
        stack([0, 0.2, 0.9, 1], swept(HEXAGON), cylinder(0.2), cone(0.9, 0.2, -0.5)),
        {"ConicalSurface": 1, "CylindricalSurface": 1, "Plane": 9},
    ),
    "frustum of a pyramid": (stack([0, 0.6], swept(rectangle(0.8, 0.8), taper=-0.8)), {"Plane": 6}),
    "pyramid": (stack([0, 0.6], swept(rectangle(0.8, 0.6), taper=-1 / 0.6)), {"Plane": 5}),
    "pyramid upside down": (stack([0, 0.6], swept(rectangle(0.8, 0.6), 0.6, taper=1 / 0.6)), {"Plane": 5}),
    "house": (stack([0, 0.4, 0.8], swept(BOX), swept(BOX, 0.4, taper=-2.5)), {"Plane": 9}),
    "pencil": (
        stack([0, 0.6, 0.8], cylinder(0.2), cone(0.6, 0.2, -1)),
        {"ConicalSurface": 1, "CylindricalSurface": 1, "Plane": 1},
    ),
    "slanted": (stack([0, 0.6], swept(rectangle(0.8, 0.4), drift=np.array([0.3, 0.2]))), {"Plane": 6}),
    "slanted pole": (
        stack([0, 0.6], swept(Circle(AXIS, 0.2), drift=np.array([0.3, 0.2]))),
        {"Plane": 2, "SurfaceOfLinearExtrusion": 1},
    ),
    "tapered circle": (
        stack([0, 0.6], swept(Circle(AXIS, 0.4), taper=-0.5)),
        {"ConicalSurface": 1, "Plane": 2},
    ),
    "twisted": (stack([0, 0.6], swept(rectangle(0.5, 0.5), twist=1.5)), {"BSplineSurface": 4, "Plane": 2}),
    "twisted to a point": (
        stack([0, 0.6], swept(rectangle(0.5, 0.5), twist=1.5, taper=-1 / 0.6)),
        {"BSplineSurface": 4, "Plane": 1},
    ),
    "loft": (stack([0, 1], free_loft()), {"BSplineSurface": 1, "Plane": 2}),
    "rounded rectangle": (
        stack([0, 0.4], swept(RoundedRectangle(AXIS, 0.8, 0.6, 0.2, 0.1))),
        {"CylindricalSurface": 4, "Plane": 6},
    ),
    "stadium": (
        stack([0, 0.4], swept(Stadium(AXIS, 0.5, 0.2, 0.3))),
        {"CylindricalSurface": 2, "Plane": 4},
    ),
    "rounded and tapered": (
        stack([0, 0.4], swept(RoundedRectangle(AXIS, 0.8, 0.6, 0.2, 0.1), taper=-0.7)),
        {"BSplineSurface": 4, "Plane": 6},
    ),
    "hollow in its side": (
        stack([0, 0.4], swept(HOLLOWED)),
        {"CylindricalSurface": 2, "Plane": 4},
    ),
    "elliptic cylinder": (
        stack([0, 0.4], swept(Ellipse(AXIS, 0.4, 0.3, 0.2))),
        {"Plane": 2, "SurfaceOfLinearExtrusion": 1},
    ),
    "elliptic cone": (
        stack([0, 0.4], swept(Ellipse(AXIS, 0.4, 0.3, 0.2), taper=-0.9)),
        {"BSplineSurface": 1, "Plane": 2},
    ),
    "kidney": (stack([0, 0.4], swept(spline_loop(KIDNEY))), {"SurfaceOfLinearExtrusion": 1, "Plane": 2}),
    "plate with holes": (
        stack([0, 0.1], Run((swept(PLATE), *(cylinder(0.05, at) for at in PINS)), 4)),
        {"CylindricalSurface": 4, "Plane": 6},
    ),
    "table": (
        stack([0, 0.5, 0.6], Run(tuple(cylinder(0.05, at) for at in PINS)), swept(PLATE)),
        {"CylindricalSurface": 4, "Plane": 10},
    ),
    "ball with a square hole": (
        stack([-0.4, 0, 0.3], sphere(0, 0.4), Run((sphere(0, 0.4), swept(rectangle(0.2, 0.2))), 1)),
        {"Plane": 6, "SphericalSurface": 1},
    ),
    "loft on a loft": (stack([0, 0.5, 1], free_loft(), free_loft()), {"BSplineSurface": 2, "Plane": 2}),
    "twisted on straight": (
        stack([0, 0.3, 0.9], swept(BOX), swept(BOX, 0.3, twist=1.5)),
        {"BSplineSurface": 4, "Plane": 6},
    ),
    "ellipsoid": (
        stack([0.2 - 1 / 3, 0.2 + 1 / 3], swept(ELLIPSE, 0.2, bow=3.0)),
        {"BSplineSurface": 1},
    ),
    "slanted pillow, cut": (
        stack([0, 0.4], swept(rectangle(0.8, 0.6), drift=np.array([0.3, 0.1]), taper=0.5, bow=2.0)),
        {"BSplineSurface": 4, "Plane": 2},
    ),
    "dome on a prism": (
        stack([0, 0.3, 0.8], swept(ELLIPSE), swept(ELLIPSE, 0.3, bow=2.0)),
        {"BSplineSurface": 1, "Plane": 1, "SurfaceOfLinearExtrusion": 1},
    ),
    "rounded box": (
        stack([0, 0.6], Filleted(RoundedRectangle(AXIS, 0.8, 0.5, 0.3, 0.1), None, "both", 0.0, 0.6)),
        {"CylindricalSurface": 12, "Plane": 6, "SphericalSurface": 8},
    ),
    "rounded lid on a box": (
        stack([0, 0.5, 0.7], swept(rectangle(0.6, 0.4)),
              Filleted(RoundedRectangle(AXIS, 0.8, 0.5, 0.3, 0.05), None, "top", 0.5, 0.7)),
        {"CylindricalSurface": 8, "Plane": 11, "SphericalSurface": 4},
    ),
    "sharp, its ends rounded": (
        stack([0, 0.6], Filleted(BOX, 0.1, "both", 0.0, 0.6)),
        {"CylindricalSurface": 8, "Plane": 6},
    ),
    "square to round": (stack([0, 0.8], Ruled(SQUARE, ROUND, 0.0, 0.8)), {"BSplineSurface": 4, "Plane": 2}),
    "between two rectangles": (
        stack([0, 0.8], Ruled(Rectangle(AXIS, 0.8, 0.4, 0), Rectangle(AXIS, 0.3, 0.5, 0), 0.0, 0.8)),
        {"Plane": 6},
    ),
    "square, turned": (
        stack([0, 0.8], Ruled(SQUARE, RegularPolygon(AXIS, 0.4, 0.4, 4), 0.0, 0.8)),
        {"BSplineSurface": 4, "Plane": 2},
    ),
    "crossing sections": (
        stack([0, 0.4, 0.8], swept(ELLIPSE), swept(rectangle(0.5, 0.5))),
        {"Plane": 10, "SurfaceOfLinearExtrusion": 1},
    ),
}  # fmt: skip
"""Stacks and the faces that a designer would draw."""


def solid_of(case: Stack) -> SolidFacts:
    return check_stack(stack_solid(case), case)


# ---- faces and volume -----------------------------------------------------------------------
@pytest.mark.parametrize("name", CASES)
def test_a_stack_has_the_faces_that_one_would_draw_and_the_volume_of_its_sections(name: str) -> None:
    case, faces = CASES[name]
    facts = solid_of(case)
    assert facts.faces == faces
    assert facts.volume == pytest.approx(stack_volume(case), rel=2e-6)


def test_volumes_are_the_known_ones() -> None:
    caps = stack([0, 0.3, 0.6, 0.9], sphere(0.3, 0.3), cylinder(0.3), sphere(0.6, 0.3))
    assert stack_volume(caps) == pytest.approx(np.pi * 0.3**2 * 0.3 + 4 / 3 * np.pi * 0.3**3, rel=1e-12)
    assert stack_volume(CASES["ring"][0]) == pytest.approx(2 * np.pi**2 * 0.4 * 0.1**2, rel=1e-12)
    assert stack_volume(CASES["pyramid"][0]) == pytest.approx(0.8 * 0.6 * 0.6 / 3, rel=1e-12)
    beyond_its_tip = stack([0, 0.9], swept(rectangle(0.8, 0.6), taper=-1 / 0.6))
    assert solid_of(beyond_its_tip).volume == pytest.approx(0.8 * 0.6 * 0.6 / 3, rel=1e-12)
    assert stack_volume(CASES["ellipsoid"][0]) == pytest.approx(4 / 3 * np.pi * 0.4 * 0.2 / 3, rel=1e-12)
    assert solid_of(stack([-0.5, 0.5], sphere(0, 0.4))).volume == pytest.approx(4 / 3 * np.pi * 0.4**3)


READ_BACK = ["three spheres", "lamp", "loft on a loft", "twisted to a point", "lemon", "ring"]


@pytest.mark.parametrize("name", READ_BACK)
def test_a_placed_stack_survives_a_step_file(name: str, tmp_path: Path) -> None:
    case, faces = CASES[name]
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    solid, facts = built_stack(case, np.array([1e3, -2e3, 50.0]), turn, 40.0)
    assert facts.volume == pytest.approx(40**3 * stack_volume(case), rel=2e-6)
    write_model(tmp_path / "x.step", [NamedSolid("x", solid)], "mm")
    (back,) = read_model(tmp_path / "x.step").bodies
    check_closed(back.solid)
    found = solid_facts(back.solid)
    assert (found.faces, found.edges) == (faces, facts.edges)
    assert found.volume == pytest.approx(facts.volume, rel=1e-8)
    assert found.bounds == pytest.approx(facts.bounds, abs=1e-3)


@settings(max_examples=25, deadline=None)
@given(
    kind=st.sampled_from(["drift", "taper", "twist"]),
    amount=st.floats(-0.8, 0.8),
    outline=st.sampled_from([BOX, Ellipse(AXIS, 0.4, 0.3, 1.0), spline_loop(KIDNEY), Polygon(ELL)]),
)
def test_swept_walls_enclose_their_sections_however_they_move(
    kind: str, amount: float, outline: Outline
) -> None:
    move = np.array([amount, 0.2]) if kind == "drift" else amount
    case = stack([0.1, 0.9], swept(outline, 0.4, **{kind: move}))
    assert solid_of(case).volume == pytest.approx(stack_volume(case), rel=2e-6)


def test_points_on_the_walls_are_on_the_stack_and_others_are_as_far_as_they_should() -> None:
    points = np.array([(0.5, 0.2, 0.05), (0.6, 0.2, 0.05), (0.1, 0.2, 0.35), (5.0, 5, 0.6)])
    assert distance_from_stack(points, LAMP) == pytest.approx([0, 0.05, 0.05, 0], abs=1e-12)


# ---- profiles that meet ---------------------------------------------------------------------
def test_walls_that_nearly_meet_do_meet_without_a_ledge() -> None:
    low, high = SPHERES.breaks[1], SPHERES.breaks[2]
    shifted = dataclasses.replace(SPHERES, breaks=np.array([-0.4, low + 3e-7, high - 3e-7, 1.05]))
    assert solid_of(shifted).faces == {"SphericalSurface": 3}
    caps = stack([0, 0.3, 0.6, 0.9], sphere(0.3, 0.3), cylinder(0.3 + 3e-7), sphere(0.6, 0.3))
    assert solid_of(caps).faces == {"CylindricalSurface": 1, "SphericalSurface": 2}
    two = stack([0, 0.3, 0.6], cylinder(0.3), cylinder(0.3 + 3e-7))
    assert solid_of(two).faces == {"CylindricalSurface": 1, "Plane": 2}
    step = stack([0, 0.3, 0.6], cylinder(0.3), cylinder(0.3001))
    assert solid_of(step).faces == {"CylindricalSurface": 2, "Plane": 3}


def test_arcs_that_meet_stay_what_they_are() -> None:
    profiles = [ArcProfile(0, None, 0.4), ArcProfile(0.5, None, 0.3)]
    middle = waist(0, 0.4, 0.5, 0.3)
    below, above = meridian(profiles, np.array([-0.4, middle + 1e-6, 0.8]), 1.0)
    assert below.end == pytest.approx([np.sqrt(0.16 - middle**2), middle], abs=1e-12)
    assert np.array_equal(below.end, above.start)
    assert [below.profile, above.profile] == profiles
    assert below.start[0] == 0
    assert above.end == pytest.approx([0, 0.8], abs=1e-12)


def test_a_sphere_that_ends_beside_its_pole_ends_in_it_and_one_cut_off_keeps_its_face() -> None:
    assert solid_of(stack([-0.4 + 5e-6, 0.1], sphere(0, 0.4))).faces == {"Plane": 1, "SphericalSurface": 1}
    assert solid_of(stack([-0.39, 0.1], sphere(0, 0.4))).faces == {"Plane": 2, "SphericalSurface": 1}


def test_a_hole_may_end_in_a_tip() -> None:
    pieces = meridian([Straight(), LineProfile(0.2, 0.0, 1.0)], np.array([0, 0.2 - 1e-7, 0.4]), 1.0)
    assert [tuple(piece.start) for piece in pieces] == [(0, 0), (0, 0.2)]


# ---- sections that meet ---------------------------------------------------------------------
@pytest.mark.parametrize("gap", [0.0, 1e-8, 1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("outline", [BOX, Ellipse(AXIS, 0.4, 0.3, 1.0), spline_loop(KIDNEY)])
def test_sections_that_nearly_coincide_are_joined(outline: Outline, gap: float) -> None:
    rng = np.random.default_rng(1)
    other = outline.moved(outline.vector + gap * rng.normal(size=len(outline.vector)))
    facts = solid_of(stack([0, 0.5, 1], swept(outline), swept(other, 0.5, taper=-0.3)))
    ledges = facts.faces["Plane"] - (10 if outline is BOX else 2)
    if not 1e-7 < gap < 1e-4:  # between, either will do
        assert (ledges > 0) == (gap > 1e-5)


def test_an_overlay_cuts_rims_where_they_cross_and_finds_what_is_inside() -> None:
    case = stack([0, 1, 2], swept(rectangle(2, 1, np.zeros(2), 0)), cylinder(0.8, np.zeros(2)))
    below, above = (block_of(case, group, 4.0) for group in ((0, 1), (1, 2)))
    found = overlay(section_of(below.top), section_of(above.bottom), 1e-6)
    crossings = found.nodes[np.isclose(np.linalg.norm(found.nodes, axis=1), 0.8)]
    x = np.sqrt(0.8**2 - 0.5**2)
    assert {tuple(p) for p in crossings.round(9)} == {
        *((sx, sy) for sx in (-round(x, 9), round(x, 9)) for sy in (-0.5, 0.5)), (0.8, 0)
    }  # fmt: skip
    assert sorted(piece.place for piece in found.below) == ["in"] * 2 + ["out"] * 6
    assert sorted(piece.place for piece in found.above) == ["in"] * 3 + ["out"] * 2


def test_distances_from_a_section_are_exact_near_it_and_tell_holes() -> None:
    case = stack([0, 1], Run((swept(Ellipse(AXIS, 0.4, 0.3, 0.0)), cylinder(0.1)), 1))
    section = section_of(block_of(case, (0, 1), 1.0).top)
    points = AXIS + [(0.4001, 0), (0.3999, 0), (0.1001, 0), (0, 0.3), (0.05, 0), (0, 0), (2, 2)]
    expected = [1e-4, -1e-4, -1e-4, 0, 0.05, 0.1]
    assert section.feet(points).distance[:6] == pytest.approx(expected, abs=2e-4)
    assert section.feet(points).distance[:4] == pytest.approx(expected[:4], abs=1e-12)
    assert section.feet(points).distance[6] > 2


# ---- what is refused ------------------------------------------------------------------------
SIDE, CROSSED = AXIS + [0.3, 0], AXIS + np.array([(0, 0), (1, 1), (1, 0), (0, 1.2)])
REFUSED = {
    "apart": (
        stack([0, 1], Run((cylinder(0.1), cylinder(0.1, AXIS + 1)))),
        "2 pieces .* not hang together",
    ),
    "apart at a break": (stack([0, 0.5, 1], cylinder(0.1), cylinder(0.1, AXIS + 1)), "2 pieces"),
    "touching": (stack([0, 0.5, 1], cylinder(0.1), cylinder(0.1, AXIS + [0.2, 0])), "2 pieces|at height 0.5"),
    "cavity": (
        stack([0, 0.3, 0.6, 1], cylinder(0.4), Run((cylinder(0.4), cylinder(0.1)), 1), cylinder(0.4)),
        "between the heights 0.3 and 0.6 there is a closed cavity",
    ),
    "hole through the side": (
        stack([0, 1], Run((swept(BOX), cylinder(0.2, SIDE)), 1)),
        "walls meet between the heights 0 and 1",
    ),
    "hole leaves halfway": (
        stack([0, 1], Run((swept(BOX, drift=np.array([0.9, 0])), cylinder(0.1)), 1)),
        "walls meet",
    ),
    "crosses itself": (stack([0, 1], swept(Polygon(CROSSED))), "heights 0 and 1 make no valid solid"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_solid_is_refused_with_the_place(name: str) -> None:
    case, words = REFUSED[name]
    with pytest.raises(ModelError, match=words):
        built_stack(case, np.zeros(3), np.eye(3))


def test_the_checks_notice_another_solid() -> None:
    solid = stack_solid(LAMP)
    with pytest.raises(ModelError, match="enclose a volume"):
        check_stack(solid, dataclasses.replace(LAMP, breaks=np.array([0, 0.1, 0.6, 0.901])))
    turned = stack(
        [0, 0.1, 0.6, 0.9], cylinder(0.4), swept(rectangle(0.2, 0.1, angle=0.4)), cone(0.6, 0.3, -0.5)
    )
    with pytest.raises(ModelError, match="beside its walls at a height of"):
        check_stack(solid, turned)
    check_walls(LAMP)


def test_what_others_would_read_as_no_valid_solid_is_refused() -> None:
    thin = stack([0, 0.4, 0.8], cylinder(0.3, np.zeros(2)), cylinder(0.301, np.array([0.0015, 0.0])))
    assert stack_solid(thin)
    with pytest.raises(ModelError, match="who read it from STEP"):
        built_stack(thin, np.array([0.1, 0.2, 0.3]), np.eye(3), 9.0)
