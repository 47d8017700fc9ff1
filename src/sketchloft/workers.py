"""Workers: processes that do pieces of the work beside this one, where there are cores to spare."""

from __future__ import annotations

import contextlib
import importlib
import itertools
import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Generic, ParamSpec, TypeVar

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

__all__ = ["ALONE", "Job", "Workers", "hire"]

P = ParamSpec("P")
T = TypeVar("T")

MOST = 3
"""Workers at most: hardly ever are more pieces ready at a time."""


class Job(Generic[T]):
    """A piece of work that a worker is at, or that is done here once its result is wanted."""

    def __init__(self, work: Callable[[], T]) -> None:
        self.work = work
        self.worker: _Worker | None = None
        self.found: tuple[T, bool] | None = None
        """The result, and whether the worker that sent it found one."""

    @property
    def elsewhere(self) -> bool:
        """Whether a worker has it."""
        return self.worker is not None

    @property
    def waits(self) -> bool:
        """Whether there is a result still to come."""
        return self.worker is not None and self.found is None and not self.worker.done()

    def do(self) -> None:
        """Do the work here and now."""
        self.found = self.work(), True

    def result(self) -> T:
        """Wait for the result; what the work raises is raised here."""
        if self.worker is not None and self.found is None:
            self.worker.wait()
        if self.found is not None and self.found[1]:
            return self.found[0]
        return self.work()


class _Worker:
    """A process that does one job at a time."""

    def __init__(self, modules: Sequence[str]) -> None:
        context = multiprocessing.get_context("spawn")
        self._here, there = context.Pipe()
        self._process = context.Process(target=_work, args=(there, modules), daemon=True)
        with _interrupts_ignored():
            self._process.start()
        there.close()
        self._job: Job[Any] | None = None

    def done(self) -> bool:
        """Whether there is nothing to wait for."""
        if self._job is not None and self._here.poll():
            self.wait()
        return self._job is None

    def free(self) -> bool:
        """Whether work would be begun at once."""
        return self.done() and self._process.is_alive()

    def begin(self, job: Job[Any]) -> None:
        self._here.send(job.work)
        self._job, job.worker = job, self

    def wait(self) -> None:
        """Wait for what the job has come to; that of a worker that was killed has no result."""
        job, self._job = self._job, None
        if job is not None:
            try:
                job.found = self._here.recv()
            except (EOFError, OSError):
                job.found = None, False

    def stop(self) -> None:
        self._process.terminate()
        self._process.join()


class Workers:
    """Some workers, or none.

    Parameters
    ----------
    count : int
    modules : sequence of str, optional
        What they load before there is work to do.
    """

    def __init__(self, count: int, modules: Sequence[str] = ()) -> None:
        self._workers = [_Worker(modules) for _ in range(count)]

    def begin(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> Job[T]:
        """Let a worker that is free do a piece of work.

        Parameters
        ----------
        function : callable
            Of a module, and one that depends on its arguments only.
        *args, **kwargs : object
            That can be pickled.
        """
        job = Job(partial(function, *args, **kwargs))
        self._give(job)
        return job

    def each(self, function: Callable[..., T], parts: Iterable[tuple[Any, ...]], **same: object) -> list[T]:
        """Do a piece of work for each of some arguments, here and by whoever is free.

        Parameters
        ----------
        function : callable
            As for `begin`.
        parts : iterable of tuple
            Arguments; those of the longest pieces had better come first.
        **same : object
            Further ones, which all pieces have.

        Returns
        -------
        list
            Results, in the order of the arguments.
        """
        jobs = [Job(partial(function, *part, **same)) for part in parts]
        for job in jobs:
            if job is not jobs[-1]:  # with the last there is nothing else to do here meanwhile
                self._give(job)
            if not job.elsewhere:
                job.do()
        return [job.result() for job in jobs]

    def first(
        self, function: Callable[..., T | None], parts: Iterable[tuple[Any, ...]]
    ) -> tuple[int, T] | None:
        """Find the first of some pieces of work that has a result, in the order of the pieces.

        Parameters
        ----------
        function : callable
            As for `begin`.
        parts : iterable of tuple
            Arguments; a few after the one that is found are tried for nothing.

        Returns
        -------
        tuple of int and object, or None
            Which piece it is, and its result.
        """
        jobs = (Job(partial(function, *part)) for part in parts)
        ahead: deque[Job[T | None]] = deque()
        for place in itertools.count():
            job = ahead.popleft() if ahead else next(jobs, None)
            if job is None:
                break
            while self._free() and (other := next(jobs, None)) is not None:
                self._give(other)
                ahead.append(other)
            while job.waits and (other := next(jobs, None)) is not None:
                other.do()
                ahead.append(other)
            found = job.result()
            if found is not None:
                return place, found
        return None

    def _free(self) -> _Worker | None:
        return next((worker for worker in self._workers if worker.free()), None)

    def _give(self, job: Job[Any]) -> None:
        """Give a job to a worker that is free, if one is."""
        worker = self._free()
        if worker is not None:
            with contextlib.suppress(OSError):  # it may be killed just now
                worker.begin(job)

    def stop(self) -> None:
        """End them, whatever they do."""
        for worker in self._workers:
            worker.stop()


ALONE = Workers(0)
"""No workers: all is done here, in its turn."""


@contextlib.contextmanager
def hire(count: int | None = None, modules: Sequence[str] = ()) -> Iterator[Workers]:
    """Have so many workers until the context ends, or one on each core that is to spare, a few at most.

    Parameters
    ----------
    count : int, optional
    modules : sequence of str, optional
        What they load before there is work to do.

    Notes
    -----
    They import the main module anew, so that a script of whoever calls this needs the usual guard,
    ``if __name__ == "__main__"``. The command line has one.
    """
    try:
        team = Workers(min(_cores() - 1, MOST) if count is None else count, modules)
    except OSError:  # where no process may be started
        team = ALONE
    try:
        yield team
    finally:
        team.stop()


def _cores() -> int:
    """Cores that this process may run on."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _work(orders: Connection, modules: Sequence[str]) -> None:
    """Do what is ordered, until there is nobody to order any more."""
    # Beside what follows: whoever sends an order waits until it is taken.
    threading.Thread(target=_load, args=(modules,)).start()
    with contextlib.suppress(EOFError, OSError):
        while True:
            work = orders.recv()
            try:
                found = work(), True
            except Exception:  # whoever waits does it again, and sees what is raised
                found = None, False
            orders.send(found)


def _load(modules: Sequence[str]) -> None:
    for module in modules:
        importlib.import_module(module)


@contextlib.contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Start a process that ignores interrupts, which are for the one that started it."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
