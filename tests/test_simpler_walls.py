"""What a wall could be instead."""

from __future__ import annotations

import numpy as np
import pytest

from sketchloft.cloud import Floats
from sketchloft.exact.changes.simpler_walls import walls_like
from sketchloft.exact.changes.turning import turning
from sketchloft.outline.ellipse import Ellipse
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.outline.polygons import LineArc, Polygon
from sketchloft.outline.simpler_chains import simpler_chains
from sketchloft.outline.stadium import Stadium
from sketchloft.outline.with_arc import with_an_arc
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

ORIGIN = np.zeros(2)
ELL = np.array([[0, 0], [10, 0], [10, 4], [4, 4], [4, 10], [0, 10.0]]) / 10


def cut(vertices: Floats, k: int, share: float) -> Floats:
    """A polygon with one corner cut off at a share of the edges beside it."""
    before, corner, after = vertices[k - 1], vertices[k], vertices[(k + 1) % len(vertices)]
    ends = corner + share * (before - corner), corner + share * (after - corner)
    return np.vstack([vertices[:k], *ends, vertices[k + 1 :]])


@pytest.mark.parametrize("corner", range(len(ELL)))
def test_a_cut_corner_is_tried_whole(corner: int) -> None:
    wall = Swept(Polygon(cut(ELL, corner, 0.05)), 0.0, ORIGIN, ORIGIN)
    others = [other.outline for other in walls_like(wall, -0.2, 0.2) if isinstance(other, Swept)]
    whole = [other.vertices for other in others if isinstance(other, Polygon) and len(other.vertices) == 6]
    gaps = [np.linalg.norm(found[:, None] - ELL, axis=2).min(axis=0).max() for found in whole]
    assert min(gaps) < 1e-12


@pytest.mark.parametrize("sweep", [1.5, 2.5, np.pi])
def test_chords_of_an_arc_are_tried_as_that_arc(sweep: float) -> None:
    """Three equal chords on the top of a block stand for an arc that swells or is cut out."""
    half = np.sin(sweep / 2)
    for side in (1, -1):
        along = (np.arange(4) / 3 - 0.5) * sweep
        arc = np.column_stack([-np.sin(along[::-1]), side * (np.cos(along) - np.cos(sweep / 2))])[::-1]
        block = np.array([[-half, 0.0], [-half, -2.0], [half, -2.0]])
        vertices = np.vstack([block, arc[:-1]])
        found = [o for o in with_an_arc(vertices) if len(o.vertices) == len(vertices) - 2]
        bulges = np.concatenate([o.bulges[o.curved] for o in found])
        assert np.abs(bulges - side * np.tan(sweep / 4)).min() < 1e-9


@pytest.mark.parametrize("turn", [-0.6, 0.0, 0.4])
@pytest.mark.parametrize("growth", [0.7, 1.0, 1.3])
def test_a_ruled_wall_whose_ends_are_alike_turns(turn: float, growth: float) -> None:
    below = Rectangle(np.array([0.1, 0.2]), 0.6, 0.4, 0.3)
    above = Rectangle(np.array([0.15, 0.1]), 0.6 * growth, 0.4 * growth, 0.3 + turn)
    ends = Polygon(below.chain()[0]), Polygon(above.chain()[0])
    found = list(turning(Ruled(*ends, -0.2, 0.6)))
    assert [type(wall.outline) for wall in found] == [Rectangle, Polygon]
    for wall in found:
        for end, height in zip(ends, (-0.2, 0.6), strict=True):
            at = np.column_stack([end.vertices, np.full(4, height)])
            assert np.abs(wall.foot(at).distance) == pytest.approx(
                0, abs=4e-3
            )  # rectangles are started to a degree
            assert wall.area(np.array([height]))[0] == pytest.approx(end.area, rel=2e-2)


def test_a_ruled_wall_from_one_shape_to_another_does_not_turn() -> None:
    ends = (
        Polygon(Rectangle(ORIGIN, 0.6, 0.2, 0.0).chain()[0]),
        Polygon(Rectangle(ORIGIN, 0.3, 0.4, 0.0).chain()[0]),
    )
    assert not list(turning(Ruled(*ends, -0.2, 0.6)))


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.0])
def test_an_ellipse_may_be_a_stadium(turn: float) -> None:
    ellipse = Ellipse(np.array([0.1, 0.2]), 0.4, 0.25, turn)
    others = [other.outline for other in walls_like(Swept(ellipse, 0.0, ORIGIN, ORIGIN), -0.2, 0.2)]  # type: ignore[union-attr]
    stadium = next(other for other in others if isinstance(other, Stadium))
    assert stadium.centre == pytest.approx(ellipse.centre, abs=1e-3)
    assert np.cos(2 * (stadium.angle - turn)) == pytest.approx(1, abs=1e-3)  # to a degree
    assert stadium.area == pytest.approx(ellipse.area, rel=0.12)


def test_two_arcs_that_go_on_are_joined_to_one() -> None:
    """A contour of an arch may be cut in the middle of its round end."""
    vertices = np.array([[1.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [-1.0, -1.0]])
    bulges = np.array([0.0, np.tan(np.pi / 8), np.tan(np.pi / 8), 0.0, 0.0])
    arch = LineArc(vertices, bulges, bulges != 0)
    fewer = [*simpler_chains(arch)]
    assert all(len(each.vertices) == 4 for each in fewer)
    assert fewer[0].bulges == pytest.approx([0.0, 1.0, 0.0, 0.0])
    assert fewer[0].area == pytest.approx(arch.area)


def test_an_arc_that_hardly_bulges_may_be_a_line() -> None:
    vertices = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    bulges = np.array([0.02, 1.0, 0.0, 0.0])
    first = next(simpler_chains(LineArc(vertices, bulges, bulges != 0)))
    assert first.bulges == pytest.approx([0.0, 1.0, 0.0, 0.0])
    assert first.curved.tolist() == [False, True, False, False]
    sole = np.array([0.02, 0.0, 0.0, 0.0])
    assert all(each.curved.any() for each in simpler_chains(LineArc(vertices, sole, sole != 0)))


def test_the_smallest_chain_has_no_corner_to_spare() -> None:
    disc = LineArc(np.array([[1.0, 0.0], [-1.0, 0.0]]), np.ones(2), np.ones(2, dtype=bool))
    assert not [*simpler_chains(disc)]
