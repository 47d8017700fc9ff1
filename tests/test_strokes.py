"""Scribbled things: strokes that drift blur every direction alike, and yet the right one is found."""

from __future__ import annotations

import numpy as np
import pytest

from scribbles import scribbled
from sketchloft import Params, PointCloud, reconstruct
from sketchloft.cloud import Floats
from sketchloft.exact.body import ExactBody
from sketchloft.exact.start.first_look import first_look
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.outline.divided_circle import DividedCircle
from sketchloft.outline.fitted_loop import fitted_loop
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle, RoundedRectangle
from sketchloft.outline.rectilinear import RectilinearPolygon
from sketchloft.outline.stadium import Stadium
from sketchloft.stack import Run, Stack, Wall
from sketchloft.stack_volume import stack_volume
from sketchloft.wall.filleted import Filleted
from sketchloft.wall.ruled import Ruled
from sketchloft.wall.swept import Swept

N = 10_000
ORIGIN = np.zeros(2)
ANGLES = np.arange(720) / 720 * 2 * np.pi
AROUND = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
SLOW = pytest.mark.slow


def prism(outline: Outline, twist: float = 0.0) -> Swept:
    return Swept(outline, 2.5, ORIGIN, ORIGIN, 0.0, twist, ("twist",) if twist else ())


SQUARE = Rectangle(ORIGIN, 6.0, 6.0, 0.3)
ROUNDED = RoundedRectangle(ORIGIN, 6.0, 4.0, 0.2, 0.9)
STAIRS = RectilinearPolygon(np.array([-3.0, 4.0, 3.0, 2.0, 1.5, 0.0, 0.0, -2.0, -1.5, -4.0]), 0.3)
BEAN = (3 + 0.9 * np.cos(2 * ANGLES) - 0.5 * np.sin(ANGLES))[:, None] * AROUND * [1.0, 0.8]
WALLS: dict[str, tuple[Wall, float]] = {
    "square to round": (Ruled(SQUARE, DividedCircle(ORIGIN, 2.6, 0.3 + np.pi / 4, 0.0), 0.0, 6.0), 6.0),
    "round to square": (Ruled(DividedCircle(ORIGIN, 2.0, 0.3 + np.pi / 4, 0.0), SQUARE, 0.0, 6.0), 6.0),
    "square to round, half as wide": (
        Ruled(SQUARE, DividedCircle(ORIGIN, 2.0, 0.3 + np.pi / 4, 0.0), 0.0, 7.0),
        7.0,
    ),
    "hopper": (Ruled(Rectangle(ORIGIN, 6.0, 3.0, 0.0), Rectangle(ORIGIN, 3.0, 2.4, 0.0), 0.0, 6.0), 6.0),
    "slot": (prism(Stadium(ORIGIN, 6.0, 2.0, 0.3)), 2.5),
    "bean": (prism(fitted_loop(BEAN, 40)), 5.0),
    "edges rounded": (prism(ROUNDED), 5.0),
    "all edges rounded": (
        Filleted(RoundedRectangle(ORIGIN, 6.0, 4.0, 0.2, 0.9), None, "both", 0.0, 5.0),
        5.0,
    ),
    "one face rounded": (Filleted(Rectangle(ORIGIN, 6.0, 4.0, 0.2), 0.9, "top", 0.0, 5.0), 5.0),
    "four waves": (prism(fitted_loop((3 + 0.7 * np.cos(4 * ANGLES))[:, None] * AROUND, 24)), 3.0),
    "five waves": (prism(fitted_loop((3 + 0.8 * np.cos(5 * ANGLES))[:, None] * AROUND, 30)), 4.0),
    "stairs": (prism(STAIRS), 4.0),
    "twisted": (prism(Rectangle(ORIGIN, 6.0, 3.5, 0.2), 0.08), 5.0),
}
KINDS = {
    "square to round": "ruled",
    "round to square": "ruled",
    "hopper": "ruled",
    "slot": "stadium",
    "bean": "spline",
    "edges rounded": "rounded rectangle",
    "all edges rounded": "filleted prism",
    "one face rounded": "filleted prism",
    "four waves": "spline",
    "five waves": "spline",
    "stairs": "rectilinear polygon",
}


def points_in(name: str, seed: int = 1) -> Floats:
    wall, height = WALLS[name]

    def inside(points: Floats) -> np.ndarray:
        within = (points[:, 2] > 0) & (points[:, 2] < height)
        within[within] = wall.foot(points[within]).distance < 0
        return within

    return scribbled(inside, np.array([-5.0, -5.0, 0.0]), np.array([5.0, 5.0, height]), N, seed)


def model(name: str, seed: int = 1) -> ExactBody:
    (body,) = reconstruct(PointCloud.of(points_in(name, seed)), Params("exact")).bodies
    assert isinstance(body, ExactBody), body.instead
    return body


@pytest.mark.parametrize(
    "name", ["square to round", *(pytest.param(name, marks=SLOW) for name in [*KINDS][1:])]
)
def test_what_was_scribbled_is_recognised(name: str) -> None:
    body = model(name)
    assert [[wall.kind for wall in run.walls] for run in body.model.stack.runs] == [[KINDS[name]]]
    wall, height = WALLS[name]
    true = Stack(np.array([0.0, height]), (Run((wall,)),))
    assert body.facts.volume == pytest.approx(stack_volume(true), rel=0.03)


@SLOW
@pytest.mark.parametrize("seed", [2, 5])
def test_a_wall_far_from_the_points_is_tried_as_a_ruled_one(seed: int) -> None:
    """A tapered rectangle, which promises little by slopes and yet is not blurred enough to be given up."""
    body = model("square to round, half as wide", seed)
    assert [wall.kind for wall in body.model.stack.walls] == ["ruled"]


@pytest.mark.parametrize("seed", [2, 3, 6, 8])
def test_a_twisted_scribble_shows_its_direction_at_the_first_look(seed: int) -> None:
    """Its moments turn by half as much again, or by half, and its faces seen from the side are flat."""
    points = points_in("twisted", seed)
    points = points[np.random.default_rng(0).permutation(len(points))]
    likeliest = first_look(points, SegmentsParams()).candidates[0]
    assert abs(likeliest.vector[2]) > np.cos(np.radians(4))


@SLOW
def test_the_direction_of_a_twisted_scribble_is_found() -> None:
    assert abs(model("twisted").vector[2]) > np.cos(np.radians(2))
