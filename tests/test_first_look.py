"""The first look at a cloud: its bodies, their directions, and what is seen along the likeliest."""

from __future__ import annotations

import numpy as np
import pytest

from sketchloft.bodies import BodiesParams
from sketchloft.cloud import PointCloud, clean
from sketchloft.direction import DirectionParams
from sketchloft.exact.body import ExactBody
from sketchloft.exact.model.density import Density
from sketchloft.exact.model.exact_model import model_of
from sketchloft.exact.model.soundness import sound
from sketchloft.exact.start import start
from sketchloft.exact.start.direction import Candidate
from sketchloft.exact.start.first_look import looked_over
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import start_along
from sketchloft.outline.circle import Circle
from sketchloft.outline.outline import Outline
from sketchloft.outline.placed_polygons import Rectangle
from sketchloft.pipeline import Params, reconstruct
from sketchloft.robust_size import middle_and_size
from sketchloft.sample import GOALS, sample_goal
from sketchloft.stack import Run, Stack
from sketchloft.wall.swept import Swept

N = 6000


def test_what_was_seen_before_makes_the_same_first_stack() -> None:
    points = clean(sample_goal(GOALS["cone"], 3000, seed=4)).points
    ((part, look),) = looked_over(points, BodiesParams(), SegmentsParams())
    assert look is not None
    middle, size = middle_and_size(points[part])
    unit, vector = (points[part] - middle) / size, look.candidates[0].vector
    known = start_along(unit, vector, look.candidates, SegmentsParams(), seen=look.seen)
    fresh = start_along(unit, vector, look.candidates, SegmentsParams())
    np.testing.assert_array_equal(known.cuts, fresh.cuts)
    np.testing.assert_array_equal(known.first.vector, fresh.first.vector)
    np.testing.assert_array_equal(known.merged.vector, fresh.merged.vector)


def test_a_first_stack_that_makes_no_solid_is_fitted_when_it_is_merged(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Near the ends of a prism that leans, the points of a section may seem to be two things that overlap."""
    points = np.random.default_rng(3).uniform(-0.5, 0.5, (N, 3)) * [0.9, 0.6, 0.7]
    vector = np.array([0.05, 0.0, 1.0]) / np.hypot(1, 0.05)
    outlines: list[Outline] = [Rectangle(np.zeros(2), 0.9, 0.6, 0.0)]
    outlines += [Circle(np.array([x, 0.0]), 0.25) for x in (-0.1, 0.1)]
    walls = tuple(Swept(outline, 0.0, np.zeros(2), np.zeros(2)) for outline in outlines)
    stack = Stack(np.array([-0.36, 0.25, 0.36]), (Run(walls[:1]), Run(walls[1:])))
    model = model_of(stack, 0.006, Density(np.log([N / 0.378])), 1.0, 1.0)
    assert not sound(model)
    monkeypatch.setattr(start, "first_stack", lambda *_, **__: model)
    found = start_along(points, vector, (Candidate(vector, 0.0, 0.0, "principal"),), SegmentsParams())
    assert [wall.kind for wall in found.merged.stack.walls] == ["rectangle"]
    assert sound(found.settled)
    assert abs(found.direction[2]) > np.cos(np.radians(0.2))


def test_every_body_is_looked_at() -> None:
    points = sample_goal(GOALS["box"], 1500, seed=5).points
    both = np.concatenate([points, points + [40.0, 0.0, 0.0]])
    looks = looked_over(clean(PointCloud.of(both)).points, BodiesParams(), SegmentsParams())
    assert len(looks) == 2
    assert all(look is not None and len(look.candidates) > 0 for _, look in looks)


def test_a_body_too_small_to_look_at_is_left_to_be_refused() -> None:
    rng = np.random.default_rng(6)
    few = rng.normal(size=(12, 3))
    ((part, look),) = looked_over(few, BodiesParams(1), SegmentsParams())
    assert len(part) == 12
    assert look is None


def test_a_given_direction_needs_no_look() -> None:
    cloud = sample_goal(GOALS["box"], 1500, seed=7)
    (body,) = reconstruct(cloud, Params(direction=DirectionParams((0, 0, 1)))).bodies
    assert isinstance(body, ExactBody)
    assert body.candidates == ()
