"""The first look at a cloud: its bodies, their directions, and what is seen along the likeliest."""

from __future__ import annotations

import numpy as np

from sketchloft.bodies import BodiesParams
from sketchloft.cloud import PointCloud, clean
from sketchloft.direction import DirectionParams
from sketchloft.exact.body import ExactBody
from sketchloft.exact.start.first_look import looked_over
from sketchloft.exact.start.segments import SegmentsParams
from sketchloft.exact.start.start import start_along
from sketchloft.pipeline import Params, reconstruct
from sketchloft.robust_size import middle_and_size
from sketchloft.sample import GOALS, sample_goal


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
