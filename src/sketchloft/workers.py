"""Workers: processes that do pieces of the work beside this one, where there are cores to spare."""

from __future__ import annotations

import contextlib
import itertools
import os
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Any, Generic, ParamSpec, TypeVar

from sketchloft.worker_process import WorkerProcess

__all__ = ["ALONE", "Job", "Workers", "hire"]

P = ParamSpec("P")
T = TypeVar("T")

MOST = 3
"""Workers at most: hardly ever are more pieces ready at a time."""


class Job(Generic[T]):
    """A piece of work that a worker is at, or that is done here once its result is wanted."""

    def __init__(self, work: Callable[[], T], workers: Workers) -> None:
        self.work = work
        self.begun = False
        self.elsewhere = False
        """Whether a worker has it, or has had it."""
        self.found: tuple[T, bool] | None = None
        """The result, and whether there is one: what is raised elsewhere is raised here once more."""
        self._workers = workers

    @property
    def waits(self) -> bool:
        """Whether a worker is at it still."""
        return self.elsewhere and self.found is None

    def result(self) -> T:
        """Wait for the result; what the work raises is raised here."""
        self._workers.finish([self])
        if self.found is not None and self.found[1]:
            return self.found[0]
        return self.work()


class Workers:
    """Some workers, or none.

    Pieces wait in a row. Each worker has a thread here that takes the first for it and waits for the result;
    and whoever wants the result of a piece that nobody has taken does it, one at a time.

    Parameters
    ----------
    count : int
    modules : sequence of str, optional
        What they load before there is work to do.
    """

    def __init__(self, count: int, modules: Sequence[str] = ()) -> None:
        self._changed = threading.Condition()
        self._row: deque[Job[Any]] = deque()
        self._busy_here = False
        self._idle = count
        self._stopped = False
        self._processes = [WorkerProcess(modules) for _ in range(count)]
        for process in self._processes:
            threading.Thread(target=self._serve, args=(process,), daemon=True).start()

    def begin(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> Job[T]:
        """Let a worker that is free do a piece of work.

        Parameters
        ----------
        function : callable
            Of a module, and one that depends on its arguments only.
        *args, **kwargs : object
            That can be pickled.
        """
        job = Job(partial(function, *args, **kwargs), self)
        self._put([job])
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
        jobs = [Job(partial(function, *part, **same), self) for part in parts]
        self._put(jobs)
        self.finish(jobs)
        return [job.result() for job in jobs]

    def beside(self, function: Callable[..., T], parts: Sequence[tuple[Any, ...]], **same: object) -> list[T]:
        """Do for each of some arguments at once what gives pieces of work to these workers in its turn.

        Parameters
        ----------
        function : callable
            It is called here, with ``workers=`` these, and may well do what is little work itself.
        parts : sequence of tuple
        **same : object

        Returns
        -------
        list
            Results, in the order of the arguments.
        """
        call = partial(function, workers=self, **same)
        if not self._processes or len(parts) < 2:
            return [call(*part) for part in parts]
        from concurrent.futures import ThreadPoolExecutor  # noqa: PLC0415

        with ThreadPoolExecutor(len(parts)) as pool:
            return list(pool.map(lambda part: call(*part), parts))

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
        jobs = (Job(partial(function, *part), self) for part in parts)
        ahead: deque[Job[T | None]] = deque()
        for place in itertools.count():
            job = ahead.popleft() if ahead else next(jobs, None)
            if job is None:
                break
            while self._wanting() and (other := next(jobs, None)) is not None:
                self._put([other])
                ahead.append(other)
            while job.waits and (other := _not_begun(ahead, jobs)) is not None:
                self.finish([other])
            found = job.result()
            if found is not None:
                with self._changed:
                    self._drop(ahead)
                return place, found
        return None

    def finish(self, jobs: Sequence[Job[Any]]) -> None:
        """Wait for pieces of work; those that nobody has begun are done here, one at a time."""
        while self._processes and (job := self._next_here(jobs)) is not None:
            try:
                job.found = job.work(), True
            finally:
                with self._changed:
                    self._busy_here = False
                    self._changed.notify_all()

    def _next_here(self, jobs: Sequence[Job[Any]]) -> Job[Any] | None:
        """Wait until one of some pieces is to be done here; None when all have been done."""
        with self._changed:
            while not all(job.found for job in jobs):
                job = next((job for job in jobs if not job.begun), None)
                if job is not None and not self._busy_here:
                    self._drop([job])
                    self._busy_here = job.begun = True
                    return job
                self._changed.wait()
        return None

    def _put(self, jobs: Iterable[Job[Any]]) -> None:
        """Let pieces of work wait in the row."""
        if self._processes:
            with self._changed:
                self._row.extend(jobs)
                self._changed.notify_all()

    def _drop(self, jobs: Iterable[Job[Any]]) -> None:
        """Let nobody begin some pieces that are in the row."""
        for job in jobs:
            if job in self._row:
                self._row.remove(job)

    def _wanting(self) -> bool:
        """Whether a worker has nothing to do, or will have nothing in the row when it ends."""
        return bool(self._processes) and len(self._row) <= self._idle

    def _serve(self, process: WorkerProcess) -> None:
        """Give a worker the pieces in the row, until it ends."""
        alive = True
        while alive:
            with self._changed:
                while not self._row and not self._stopped:
                    self._changed.wait()
                if self._stopped:
                    return
                job = self._row.popleft()
                job.begun = job.elsewhere = True
                self._idle -= 1
            try:
                found = process.found(job.work)
            except (EOFError, OSError):
                found, alive = (None, False), False
            except Exception:  # it cannot be sent
                found = None, False
            with self._changed:
                job.found = found
                self._idle += alive
                self._changed.notify_all()

    def stop(self) -> None:
        """End them, whatever they do."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()
        for process in self._processes:
            process.stop()


def _not_begun(ahead: deque[Job[T]], jobs: Iterator[Job[T]]) -> Job[T] | None:
    """A piece of work that nobody has begun: one of those ahead, or else the next one, which is then, too."""
    job = next((job for job in ahead if not job.begun), None)
    if job is None and (job := next(jobs, None)) is not None:
        ahead.append(job)
    return job


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
