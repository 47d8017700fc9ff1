"""The kernel room: lofts, their checks, placement, primitives and triangles."""

from __future__ import annotations

import dataclasses
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.gp import gp_Pnt
from OCP.TopoDS import TopoDS, TopoDS_Shell, TopoDS_Solid

from sketchloft.brep.check import check_closed, check_solid
from sketchloft.brep.explore import faces_of, vertices_of
from sketchloft.brep.facts import solid_facts
from sketchloft.brep.kernel import bspline_surface, skin_of
from sketchloft.brep.patches import cut, part, sharp_columns, sharp_rows
from sketchloft.brep.place import placed
from sketchloft.brep.primitives import fuse
from sketchloft.brep.sections import check_sections, section_volume
from sketchloft.brep.solid import Solid, loft_solid
from sketchloft.brep.tessellate import tessellate, tessellate_faces
from sketchloft.errors import ModelError
from sketchloft.mesh import Mesh
from sketchloft.sample.goals import GOALS
from sketchloft.sample.primitives import Ball, Frustum, Prism
from sketchloft.surface import SkinSurface, basis_matrix, evaluate
from skins import clamped, cylinder, moved, prism, wavy

SQUARE = np.array([(-1.0, -1), (1, -1), (1, 1), (-1, 1)]) / 2
ELL = np.array([(0.0, 0), (10, 0), (10, 4), (4, 4), (4, 10), (0, 10)])
SKINS = {
    "wavy, straight": wavy(),
    "wavy, smooth": wavy(v_degree=3),
    "square": prism(SQUARE),
    "tapered": prism(SQUARE, np.array([1.0, 0.4, 0.7])),
    "ell": prism(ELL / 10),
    "cylinder": cylinder(),
}


# ---- the surface ----------------------------------------------------------------------------
@given(degree=st.integers(1, 4), inner=st.lists(st.floats(0.05, 0.95), max_size=6))
def test_basis_functions_sum_to_one_and_their_derivatives_to_zero(degree: int, inner: list[float]) -> None:
    knots = np.r_[np.zeros(degree + 1), np.sort(inner), np.ones(degree + 1)]
    at = np.linspace(0, 1, 33)
    values = basis_matrix(knots, degree, at)
    assert values.shape == (33, len(knots) - degree - 1)
    assert values.min() >= 0
    assert values.sum(axis=1) == pytest.approx(np.ones(33))
    slopes = basis_matrix(knots, degree, at, derivative=1)
    assert slopes.sum(axis=1) == pytest.approx(np.zeros(33), abs=1e-9)


@pytest.mark.parametrize("skin", SKINS.values(), ids=SKINS)
def test_evaluate_agrees_with_the_kernel(skin: SkinSurface) -> None:
    u = np.linspace(skin.u_knots[0], skin.u_knots[-1], 23)
    v = np.linspace(skin.v_knots[0], skin.v_knots[-1], 7)
    surface = bspline_surface(skin)
    for k, at in enumerate(v):
        kernel = [surface.Value(float(x), float(at)) for x in u]
        expected = np.array([(p.X(), p.Y(), p.Z()) for p in kernel])
        assert evaluate(skin, u, v)[k] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("derivative", [(1, 0), (0, 1)])
def test_derivatives_are_limits_of_differences(derivative: tuple[int, int]) -> None:
    step = 1e-6
    for skin in SKINS.values():
        u = np.linspace(skin.u_knots[0], skin.u_knots[-1], 12)[1:-1] + 0.0123
        v = np.linspace(skin.v_knots[0], skin.v_knots[-1], 6)[1:-1] + 0.0123
        du, dv = step * derivative[0], step * derivative[1]
        slope = (evaluate(skin, u + du, v + dv) - evaluate(skin, u - du, v - dv)) / (2 * step)
        assert evaluate(skin, u, v, *derivative) == pytest.approx(slope, abs=1e-6)


def test_a_surface_comes_back_from_the_kernel_as_it_went_in() -> None:
    for skin in SKINS.values():
        back = skin_of(bspline_surface(skin))
        assert np.array_equal(back.poles, skin.poles)
        assert np.array_equal(back.u_knots, skin.u_knots)
        assert np.array_equal(back.v_knots, skin.v_knots)
        assert (back.u_degree, back.v_degree) == (skin.u_degree, skin.v_degree)
        assert (back.weights is None) == (skin.weights is None)


# ---- patches --------------------------------------------------------------------------------
def test_sharp_edges_are_found_where_the_tangent_turns_and_only_there() -> None:
    assert sharp_columns(wavy()) == []
    assert sharp_columns(cylinder()) == []  # full knots, but smooth
    assert sharp_columns(prism(SQUARE)) == [0, 3, 6, 9]
    assert sharp_columns(prism(SQUARE, start=0.5)) == [3, 6, 9, 12]  # the seam is not sharp
    assert sharp_rows(prism(SQUARE, np.array([1.0, 0.9, 0.8, 0.9]))) == [2]  # straight at row 1
    assert sharp_rows(wavy(8, v_degree=1)) == [1, 2, 3, 4, 5, 6]
    assert sharp_rows(wavy(8, v_degree=3)) == []


@pytest.mark.parametrize("start", [0.0, 0.5])
def test_patches_cover_the_skin_side_by_side(start: float) -> None:
    grid = cut(prism(SQUARE, np.array([1.0, 0.6, 0.9]), start=start))
    assert grid.rows == [0, 1, 2]
    assert len(grid.columns) == 2
    for band, columns in enumerate(grid.columns):
        assert len(columns) == 5
        sides = [part(grid.skin, (band, band + 1), pair) for pair in pairwise(columns)]
        for side, following in zip(sides, sides[1:] + sides[:1], strict=True):
            assert np.array_equal(side.poles[:, -1], following.poles[:, 0])
            at = np.linspace(side.u_knots[0], side.u_knots[-1], 5)
            foot = evaluate(side, at, side.v_knots[:1])[0, :, :2]
            assert np.abs(foot).max(axis=1) == pytest.approx(np.full(5, 0.5 if band == 0 else 0.3))


def test_a_band_is_cut_along_only_where_its_own_sections_have_corners() -> None:
    # A circle of four cubic arcs under a square with its corners at the same parameters.
    k = 4 / 3 * (np.sqrt(2) - 1)
    arc = np.array([1 + 0j, 1 + k * 1j, k + 1j])
    circle = np.outer(1j ** np.arange(5), arc).ravel()[:13] * np.exp(-0.75j * np.pi)
    skin = prism(SQUARE, np.ones(5))
    poles = skin.poles.copy()
    poles[:3, :, :2] = 0.6 * np.stack([circle.real, circle.imag], axis=1)
    round_below = dataclasses.replace(skin, poles=poles)
    facts = check_solid(loft_solid(round_below), round_below)
    assert facts.faces == {"BSplineSurface": 1 + 4 + 4, "Plane": 2}


# ---- lofts ----------------------------------------------------------------------------------
@pytest.mark.parametrize("skin", SKINS.values(), ids=SKINS)
def test_lofts_pass_all_checks(skin: SkinSurface) -> None:
    facts = check_solid(loft_solid(skin), skin)
    assert facts.volume == pytest.approx(section_volume(skin), rel=1e-9)
    u = np.linspace(skin.u_knots[0], skin.u_knots[-1], 400)
    v = np.linspace(skin.v_knots[0], skin.v_knots[-1], 141)
    points = evaluate(skin, u, v)
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    assert facts.bounds == pytest.approx(np.stack([low, high]), abs=1e-3)


def test_known_shapes_have_known_measures() -> None:
    cube = solid_facts(loft_solid(prism(SQUARE)))
    assert cube.volume == pytest.approx(1, rel=1e-12)
    assert cube.area == pytest.approx(6, rel=1e-12)
    assert cube.bounds == pytest.approx(np.array([(-0.5, -0.5, 0), (0.5, 0.5, 1)]), abs=1e-12)
    assert (cube.faces, cube.edges) == ({"BSplineSurface": 4, "Plane": 2}, 12)
    ell = solid_facts(loft_solid(prism(ELL, heights=np.array([0.0, 4.0]))))
    assert ell.volume == pytest.approx(256, rel=1e-12)
    assert ell.area == pytest.approx(288, rel=1e-12)
    assert (ell.faces, ell.edges) == ({"BSplineSurface": 6, "Plane": 2}, 18)
    can = solid_facts(loft_solid(cylinder(radius=1.5, height=2.0)))
    assert can.volume == pytest.approx(np.pi * 1.5**2 * 2, rel=1e-7)
    assert can.area == pytest.approx(2 * np.pi * 1.5 * (1.5 + 2), rel=1e-7)
    assert (can.faces, can.edges) == ({"BSplineSurface": 1, "Plane": 2}, 3)
    frustum = solid_facts(loft_solid(prism(SQUARE, np.array([1.0, 0.5]))))
    assert frustum.volume == pytest.approx((1 + 0.5 + 0.25) / 3, rel=1e-12)


def test_the_seam_may_lie_on_a_side() -> None:
    skin = prism(SQUARE, np.array([1.0, 0.5]), start=0.3)
    facts = check_solid(loft_solid(skin), skin)
    assert facts.faces == {"BSplineSurface": 4, "Plane": 2}
    assert facts.volume == pytest.approx(7 / 12, rel=1e-12)


@pytest.mark.parametrize("skin", SKINS.values(), ids=SKINS)
def test_normals_point_outwards_whichever_way_the_skin_runs(skin: SkinSurface) -> None:
    around = dataclasses.replace(
        skin,
        poles=skin.poles[:, ::-1],
        u_knots=skin.u_knots[0] + skin.u_knots[-1] - skin.u_knots[::-1],
    )
    along = dataclasses.replace(
        skin, poles=skin.poles[::-1], v_knots=skin.v_knots[0] + skin.v_knots[-1] - skin.v_knots[::-1]
    )
    volume = section_volume(skin)
    for turned in (around, along):
        assert check_solid(loft_solid(turned), turned).volume == pytest.approx(volume, rel=1e-9)


def test_many_sections_loft_and_check() -> None:
    skin = wavy(400, 40)
    facts = check_solid(loft_solid(skin), skin)
    assert facts.volume == pytest.approx(section_volume(skin), rel=1e-9)


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 2**32 - 1), st.integers(3, 8), st.sampled_from([1, 3]))
def test_lofts_of_random_star_shaped_sections_are_valid(seed: int, corners: int, v_degree: int) -> None:
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.random(corners) + np.arange(corners)) / corners * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    skin = prism(ring, rng.uniform(0.3, 1.0, 5))
    skin = dataclasses.replace(skin, v_degree=v_degree, v_knots=clamped(5, v_degree))
    volume = check_solid(loft_solid(skin), skin).volume
    assert volume == pytest.approx(section_volume(skin), rel=1e-9)


def test_ends_that_no_plane_can_cap_are_refused() -> None:
    skin = prism(SQUARE)
    bent = skin.poles.copy()
    bent[-1, 5, 2] += 1e-3
    with pytest.raises(ModelError, match="last section leaves its plane"):
        loft_solid(dataclasses.replace(skin, poles=bent))
    flat = skin.poles.copy()
    flat[0, :, :2] *= [1, 0]
    with pytest.raises(ModelError, match=r"first section .* encloses no area"):
        loft_solid(dataclasses.replace(skin, poles=flat))


# ---- every check has a solid that fails it --------------------------------------------------
def test_a_section_that_crosses_itself_is_refused() -> None:
    skin = prism(SQUARE[[0, 2, 1, 3]] + [[0, 0], [0, 0.2], [0, 0], [0, 0]])
    with pytest.raises(ModelError, match=r"section at 0\.0% of the loft crosses itself"):
        check_sections(skin)


def test_sections_that_cross_themselves_only_between_are_refused() -> None:
    skin = prism(ELL / 10)
    poles = skin.poles.copy()
    # Simple sections at both ends, whose corners do not belong together: half-way the ring folds.
    poles[1, :, :2] = np.roll(poles[0, :-1, :2], 9, axis=0)[np.r_[: len(poles[0]) - 1, 0]]
    with pytest.raises(ModelError, match=r"crosses itself|turns over"):
        check_sections(dataclasses.replace(skin, poles=poles))


def test_a_loft_that_shrinks_to_a_point_is_refused() -> None:
    with pytest.raises(ModelError, match="turns over between 20% and 40%"):
        check_sections(prism(SQUARE, np.array([1.0, -1.0, -1.0]), np.array([0.0, 0.8, 1.0])))


def test_sections_out_of_order_tilted_or_in_unequal_proportion_are_refused() -> None:
    swapped = prism(SQUARE, np.ones(3), np.array([0.0, 1.0, 0.5]))
    with pytest.raises(ModelError, match="section 2 does not lie above section 1"):
        check_sections(swapped)
    tilted = prism(SQUARE, np.ones(3)).poles.copy()
    tilted[1, :, 2] += 0.1 * tilted[1, :, 0]
    with pytest.raises(ModelError, match="section 1 leaves its plane"):
        check_sections(dataclasses.replace(prism(SQUARE, np.ones(3)), poles=tilted))
    can = cylinder()
    assert can.weights is not None
    uneven = can.weights * [[1.0], [1.0]]
    uneven[1, 1::2] *= 1.2
    with pytest.raises(ModelError, match="unequal proportion"):
        check_sections(dataclasses.replace(can, weights=uneven))


def _solid_of(faces: list[object]) -> Solid:
    shell, solid, build = TopoDS_Shell(), TopoDS_Solid(), BRep_Builder()
    build.MakeShell(shell)
    for face in faces:
        build.Add(shell, face)
    shell.Closed(True)
    build.MakeSolid(solid)
    build.Add(solid, shell)
    return Solid(solid)


def test_an_open_solid_is_refused() -> None:
    skin = wavy()
    lidless = _solid_of(faces_of(loft_solid(skin).shape)[:-1])
    with pytest.raises(ModelError, match="open: 1 of its edges"):
        check_solid(lidless, skin)


def test_a_solid_with_a_face_turned_over_is_refused() -> None:
    faces = faces_of(loft_solid(prism(SQUARE)).shape)
    with pytest.raises(ModelError, match="4 of its edges do not join two faces back to back"):
        check_closed(_solid_of([faces[0].Reversed(), *faces[1:]]))


def test_a_solid_of_two_shells_is_refused() -> None:
    first, second = loft_solid(prism(SQUARE)).shape, loft_solid(moved(prism(SQUARE), (3, 0, 0))).shape
    solid, build = TopoDS_Solid(), BRep_Builder()
    build.MakeSolid(solid)
    for shape in (first, second):
        shell, shell_faces = TopoDS_Shell(), faces_of(shape)
        build.MakeShell(shell)
        for face in shell_faces:
            build.Add(shell, face)
        build.Add(solid, shell)
    with pytest.raises(ModelError, match="2 shells, expected one"):
        check_closed(Solid(solid))


def test_a_solid_inside_out_is_refused() -> None:
    skin = wavy()
    inside_out = Solid(TopoDS.Solid(loft_solid(skin).shape.Reversed()))
    assert solid_facts(inside_out).volume == pytest.approx(-section_volume(skin))
    with pytest.raises(ModelError, match=r"enclose a volume of -0\.\d+, its sections one of 0\.\d+"):
        check_solid(inside_out, skin)


def test_a_solid_that_the_kernel_rejects_is_refused() -> None:
    skin = prism(SQUARE)
    solid = loft_solid(skin)
    corner = vertices_of(solid.shape)[0]
    at = BRep_Tool.Pnt_s(corner)
    BRep_Builder().UpdateVertex(corner, gp_Pnt(at.X() + 0.1, at.Y(), at.Z()), 1e-7)
    with pytest.raises(ModelError, match="kernel finds the solid invalid"):
        check_solid(solid, skin)


def test_a_solid_of_another_volume_or_elsewhere_is_refused() -> None:
    skin = wavy()
    with pytest.raises(ModelError, match="its sections one of"):
        check_solid(loft_solid(wavy(9)), skin)
    with pytest.raises(ModelError, match=r"passes 0\.01 beside its sections"):
        check_solid(loft_solid(moved(skin, (0.01, 0, 0))), skin)


# ---- placing --------------------------------------------------------------------------------
def test_placed_moves_every_point_as_it_says() -> None:
    axes = np.array([(0.0, 1, 0), (0, 0, 1), (1, 0, 0)])
    origin = np.array([5.0, -7, 11])
    solid = placed(loft_solid(prism(SQUARE)), 3.0, origin, axes)
    corners = np.array([(-0.5, -0.5, 0), (0.5, 0.5, 1)]) @ axes * 3 + origin
    facts = solid_facts(solid)
    assert facts.bounds == pytest.approx(np.stack([corners.min(axis=0), corners.max(axis=0)]))
    assert facts.volume == pytest.approx(27, rel=1e-12)
    check_closed(solid)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e5])
@pytest.mark.parametrize("offset", [0.0, 1e4])
def test_placed_solids_stay_valid_at_any_scale(size: float, offset: float) -> None:
    skin = wavy()
    solid = placed(loft_solid(skin), size, np.array([1.0, -0.5, 0.3]) * offset * size)
    check_closed(solid)
    assert solid_facts(solid).volume == pytest.approx(section_volume(skin) * size**3, rel=1e-7)
    mesh = tessellate(solid, 1e-3, 0.3)
    assert mesh.volume == pytest.approx(section_volume(skin) * size**3, rel=5e-3)


def test_placing_refuses_what_is_no_placement() -> None:
    solid = loft_solid(prism(SQUARE))
    with pytest.raises(ModelError, match="scaled by -1"):
        placed(solid, -1.0, (0, 0, 0))
    for axes in (np.diag([1.0, 1, -1]), np.diag([1.0, 1, 2]), np.full((3, 3), np.nan)):
        with pytest.raises(ModelError, match="right-handed orthonormal"):
            placed(solid, 1.0, (0, 0, 0), axes)


# ---- primitives -----------------------------------------------------------------------------
def test_primitives_have_exact_faces_and_measures() -> None:
    ball = solid_facts(fuse([Ball((1.0, 2.0, 3.0), 2.0)]))
    assert ball.faces == {"SphericalSurface": 1}
    assert ball.volume == pytest.approx(4 / 3 * np.pi * 8)
    assert ball.bounds == pytest.approx(np.array([(-1, 0, 1), (3, 4, 5)]), abs=1e-6)
    can = solid_facts(fuse([Frustum((0.0, 0.0, 1.0), 2.0, 2.0, 3.0)]))
    assert can.faces == {"CylindricalSurface": 1, "Plane": 2}
    assert can.volume == pytest.approx(12 * np.pi)
    tip = solid_facts(fuse([Frustum((0.0, 0.0, 0.0), 2.0, 0.0, 3.0)]))
    assert tip.faces == {"ConicalSurface": 1, "Plane": 1}
    assert tip.volume == pytest.approx(4 * np.pi)
    ell = solid_facts(fuse([Prism(tuple((float(x), float(y)) for x, y in ELL), 0.0, 4.0)]))
    assert ell.faces == {"Plane": 8}
    assert (ell.volume, ell.area) == pytest.approx((256, 288))


def test_fused_balls_lose_what_they_share() -> None:
    facts = solid_facts(fuse([Ball((0.0, 0.0, 0.0), 1.0), Ball((0.0, 0.0, 1.0), 1.0)]))
    lens = np.pi * 5 / 12  # two caps of height 1/2
    assert facts.faces == {"SphericalSurface": 2}
    assert facts.volume == pytest.approx(8 / 3 * np.pi - lens, rel=1e-6)


def test_every_goal_becomes_one_valid_solid() -> None:
    for goal in GOALS.values():
        check_closed(fuse(goal.parts))


def test_parts_that_make_no_single_solid_are_refused() -> None:
    with pytest.raises(ModelError, match="2 solids, expected one"):
        fuse([Ball((0.0, 0.0, 0.0), 1.0), Ball((5.0, 0.0, 0.0), 1.0)])
    with pytest.raises(ModelError, match="no part"):
        fuse([])


# ---- triangles ------------------------------------------------------------------------------
def _is_watertight(mesh: Mesh) -> bool:
    edges = np.concatenate([mesh.triangles[:, [0, 1]], mesh.triangles[:, [1, 2]], mesh.triangles[:, [2, 0]]])
    _, counts = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    return bool((counts == 2).all()) and len(np.unique(edges, axis=0)) == len(edges)


@pytest.mark.parametrize("skin", SKINS.values(), ids=SKINS)
def test_triangles_of_lofts_are_watertight_and_close(skin: SkinSurface) -> None:
    solid = loft_solid(skin)
    mesh, face = tessellate_faces(solid, 1e-3, 0.3)
    assert _is_watertight(mesh)
    assert (mesh.areas > 0).all()
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)
    assert mesh.volume == pytest.approx(section_volume(skin), rel=5e-3)
    assert len(face) == len(mesh.triangles)
    assert np.array_equal(np.unique(face), np.arange(sum(solid_facts(solid).faces.values())))


def test_triangles_of_curved_faces_with_poles_and_seams_are_watertight() -> None:
    for parts in (
        [Ball((0.0, 0.0, 0.0), 2.0)],
        [Frustum((0.0, 0.0, 0.0), 2.0, 0.0, 3.0)],
        GOALS["lamp"].parts,
    ):
        solid = fuse(parts)
        mesh = tessellate(solid, 1e-3, 0.3)
        assert _is_watertight(mesh)
        assert mesh.volume == pytest.approx(solid_facts(solid).volume, rel=0.02)


def test_a_finer_chord_comes_closer() -> None:
    solid = fuse([Ball((0.0, 0.0, 0.0), 2.0)])
    exact = 4 / 3 * np.pi * 8
    errors = [exact - tessellate(solid, chord, 1.0).volume for chord in (1e-2, 1e-3, 1e-4)]
    assert errors[0] > 5 * errors[1] > 25 * errors[2] > 0


def test_triangulating_leaves_the_solid_as_it_was_and_repeats() -> None:
    solid = loft_solid(wavy())
    first, second = tessellate(solid, 1e-3, 0.3), tessellate(solid, 1e-3, 0.3)
    assert np.array_equal(first.vertices, second.vertices)
    assert np.array_equal(first.triangles, second.triangles)
    coarse = tessellate(solid, 1e-2, 0.8)
    assert len(coarse.triangles) < len(first.triangles)
