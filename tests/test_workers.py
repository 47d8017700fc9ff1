"""Workers: what they do is what would have been done here."""

from __future__ import annotations

import operator
import os
import threading
import time
from collections.abc import Iterator
from typing import TypeVar

import numpy as np
import pytest

from scribbles import SCRIBBLED
from sketchloft import reconstruct
from sketchloft.exact.body import ExactBody
from sketchloft.sample import GOALS, FillParams, sample_goal
from sketchloft.workers import ALONE, Job, Workers

T = TypeVar("T")


@pytest.fixture(scope="module")
def team() -> Iterator[Workers]:
    team = Workers(1)
    yield team
    team.stop()


def _taken(job: Job[T]) -> Job[T]:
    """Wait until a worker is at a piece of work."""
    for _ in range(400):
        if job.elsewhere:
            return job
        time.sleep(0.025)
    raise AssertionError("the worker is never free")


def _slow_double(seconds: float, number: int) -> int:
    time.sleep(seconds)
    return 2 * number


def test_a_worker_is_another_process(team: Workers) -> None:
    assert _taken(team.begin(os.getpid)).result() != os.getpid()
    assert ALONE.begin(os.getpid).result() == os.getpid()
    assert not ALONE.begin(os.getpid).elsewhere


def test_results_come_in_order_whoever_found_them(team: Workers) -> None:
    asleep = _taken(team.begin(time.sleep, 0.3))
    assert team.each(pow, [(2, k) for k in range(5)]) == [1, 2, 4, 8, 16]
    asleep.result()
    assert team.each(_slow_double, [(0.2, 1), (0.0, 2), (0.3, 3)]) == [2, 4, 6]
    assert ALONE.each(_slow_double, [(0.0, 1), (0.0, 2)]) == [2, 4]


def test_what_nobody_has_begun_is_done_here(team: Workers) -> None:
    asleep = _taken(team.begin(time.sleep, 0.3))
    assert team.each(os.getpid, [(), ()]) == [os.getpid()] * 2
    assert team.each(os.getpid, []) == []
    asleep.result()


def _pieces(number: int, *, workers: Workers) -> tuple[int, list[int]]:
    return threading.get_ident(), workers.each(_slow_double, [(0.05, number), (0.05, number + 1)])


def test_what_gives_pieces_of_work_goes_on_side_by_side(team: Workers) -> None:
    found = team.beside(_pieces, [(1,), (3,), (5,)])
    assert [numbers for _, numbers in found] == [[2, 4], [6, 8], [10, 12]]
    assert len({thread for thread, _ in found}) == 3
    alone = ALONE.beside(_pieces, [(1,), (3,)])
    assert alone == [(threading.get_ident(), [2, 4]), (threading.get_ident(), [6, 8])]


def _failing(number: int, *, workers: Workers) -> list[float]:
    return workers.each(operator.truediv, [(1, number), (2, number)])


def test_what_is_raised_beside_is_raised_here(team: Workers) -> None:
    for workers in (ALONE, team):
        with pytest.raises(ZeroDivisionError):
            workers.beside(_failing, [(1,), (0,), (2,)])
    assert team.each(pow, [(2, 2)]) == [4]


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
    first, second = (_taken(team.begin(os.getpid)) for _ in range(2))
    assert second.result() == first.result() == first.result() != os.getpid()


def test_what_is_raised_there_is_raised_here(team: Workers) -> None:
    job = _taken(team.begin(operator.truediv, 1, 0))
    with pytest.raises(ZeroDivisionError):
        job.result()


def test_what_cannot_be_sent_is_done_here(team: Workers) -> None:
    def here() -> int:
        return os.getpid()

    job = _taken(team.begin(here))
    assert job.result() == os.getpid()


def test_a_result_that_nobody_waits_for_is_dropped(team: Workers) -> None:
    _taken(team.begin(time.sleep, 0.2))
    later = team.begin(os.getpid)
    assert not later.elsewhere  # as the worker is at it still
    assert _taken(later).result() != os.getpid()


def test_work_of_a_worker_that_is_killed_is_done_here() -> None:
    team = Workers(1)
    asleep = _taken(team.begin(time.sleep, 0.3))
    team.stop()
    begun = time.perf_counter()
    asleep.result()
    assert time.perf_counter() - begun >= 0.3
    assert team.begin(pow, 2, 3).result() == 8


def test_a_worker_that_dies_leaves_its_work_to_the_others() -> None:
    team = Workers(2)
    deadly = _taken(team.begin(_die_elsewhere, os.getpid()))
    assert team.each(pow, [(2, k) for k in range(6)]) == [1, 2, 4, 8, 16, 32]
    assert deadly.result() == "alive"
    team.stop()


def _die_elsewhere(here: int) -> str:
    if os.getpid() != here:
        os._exit(1)
    return "alive"


@pytest.mark.parametrize("params", [FillParams(), pytest.param(SCRIBBLED, marks=pytest.mark.slow)])
def test_a_model_is_the_same_whoever_works_at_it(team: Workers, params: FillParams) -> None:
    cloud = sample_goal(GOALS["stepped-shaft"], 5000, params, seed=3)
    alone, helped = (reconstruct(cloud, workers=workers).bodies[0] for workers in (ALONE, team))
    assert isinstance(alone, ExactBody)
    assert isinstance(helped, ExactBody)
    np.testing.assert_array_equal(helped.model.vector, alone.model.vector)
    np.testing.assert_array_equal(helped.model.stack.breaks, alone.model.stack.breaks)
    np.testing.assert_array_equal(helped.frame.axes, alone.frame.axes)
