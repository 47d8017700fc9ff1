"""Workers: what they do is what would have been done here."""

from __future__ import annotations

import operator
import os
import time
from collections.abc import Iterator

import numpy as np
import pytest

from scribbles import SCRIBBLED
from sketchloft import reconstruct
from sketchloft.exact.body import ExactBody
from sketchloft.sample import GOALS, FillParams, sample_goal
from sketchloft.workers import ALONE, Workers


@pytest.fixture(scope="module")
def team() -> Iterator[Workers]:
    team = Workers(1)
    yield team
    team.stop()


def _until_free(team: Workers) -> None:
    """Wait until work is begun elsewhere again."""
    for _ in range(200):
        job = team.begin(os.getpid)
        if job.elsewhere:
            assert job.result() != os.getpid()
            return
        time.sleep(0.05)
    raise AssertionError("the worker is never free")


def _slow_double(seconds: float, number: int) -> int:
    time.sleep(seconds)
    return 2 * number


def test_a_worker_is_another_process(team: Workers) -> None:
    job = team.begin(os.getpid)
    assert job.elsewhere
    assert job.result() != os.getpid()
    assert not ALONE.begin(os.getpid).elsewhere
    assert ALONE.begin(os.getpid).result() == os.getpid()


def test_results_come_in_order_whoever_found_them(team: Workers) -> None:
    asleep = team.begin(time.sleep, 0.3)
    assert team.each(pow, [(2, k) for k in range(5)]) == [1, 2, 4, 8, 16]
    asleep.result()
    assert team.each(_slow_double, [(0.2, 1), (0.0, 2), (0.3, 3)]) == [2, 4, 6]
    assert ALONE.each(_slow_double, [(0.0, 1), (0.0, 2)]) == [2, 4]


def test_the_last_piece_is_done_here_where_there_is_nothing_else_to_do(team: Workers) -> None:
    _until_free(team)
    first, last = team.each(os.getpid, [(), ()])
    assert last == os.getpid() != first
    assert team.each(os.getpid, [()]) == [os.getpid()]
    assert team.each(os.getpid, []) == []


def _large(number: int, least: int, seconds: float = 0.0) -> int | None:
    time.sleep(seconds)
    return 10 * number if number >= least else None


def test_the_first_that_has_a_result_is_the_first_in_order_not_in_time(team: Workers) -> None:
    for workers in (ALONE, team):
        assert workers.first(_large, [(1, 3), (2, 3), (3, 3), (4, 3), (5, 3)]) == (2, 30)
        assert workers.first(_large, [(5, 3, 0.3), (4, 3), (3, 3)]) == (0, 50)
        assert workers.first(_large, [(1, 3), (3, 3, 0.3), (4, 3)]) == (1, 30)
        assert workers.first(_large, [(1, 3), (2, 3)]) is None
        assert workers.first(_large, []) is None


def test_pieces_are_not_asked_for_long_before_they_are_begun(team: Workers) -> None:
    asked: list[int] = []

    def parts() -> Iterator[tuple[int, int]]:
        for number in range(100):
            asked.append(number)
            yield number, 3

    assert ALONE.first(_large, parts()) == (3, 30)
    assert asked == [0, 1, 2, 3]
    asked.clear()
    assert team.first(_large, parts()) == (3, 30)
    assert len(asked) < 100


def test_a_result_waits_until_it_is_wanted(team: Workers) -> None:
    first = team.begin(os.getpid)
    _until_free(team)
    second = team.begin(os.getpid)
    assert first.elsewhere
    assert second.elsewhere
    assert second.result() == first.result() == first.result() != os.getpid()


def test_what_is_raised_there_is_raised_here(team: Workers) -> None:
    job = team.begin(operator.truediv, 1, 0)
    assert job.elsewhere
    with pytest.raises(ZeroDivisionError):
        job.result()


def test_a_result_that_nobody_waits_for_is_dropped(team: Workers) -> None:
    assert team.begin(time.sleep, 0.2).elsewhere
    assert not team.begin(pow, 2, 2).elsewhere  # as the worker is at it still
    _until_free(team)


def test_work_of_a_worker_that_is_killed_is_done_here() -> None:
    team = Workers(1)
    asleep = team.begin(time.sleep, 0.3)
    assert asleep.elsewhere
    team.stop()
    begun = time.perf_counter()
    asleep.result()
    assert time.perf_counter() - begun >= 0.3
    assert team.begin(pow, 2, 3).result() == 8


@pytest.mark.parametrize("params", [FillParams(), pytest.param(SCRIBBLED, marks=pytest.mark.slow)])
def test_a_model_is_the_same_whoever_works_at_it(team: Workers, params: FillParams) -> None:
    cloud = sample_goal(GOALS["stepped-shaft"], 5000, params, seed=3)
    alone, helped = (reconstruct(cloud, workers=workers).bodies[0] for workers in (ALONE, team))
    assert isinstance(alone, ExactBody)
    assert isinstance(helped, ExactBody)
    np.testing.assert_array_equal(helped.model.vector, alone.model.vector)
    np.testing.assert_array_equal(helped.model.stack.breaks, alone.model.stack.breaks)
    np.testing.assert_array_equal(helped.frame.axes, alone.frame.axes)
