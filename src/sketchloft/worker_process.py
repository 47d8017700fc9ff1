"""Worker process: one that does a piece of work at a time for another process."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from sketchloft.loading import load

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

__all__ = ["WorkerProcess"]


class WorkerProcess:
    """A process that does what it is sent.

    Parameters
    ----------
    modules : sequence of str
        What it loads before there is work to do.
    """

    def __init__(self, modules: Sequence[str]) -> None:
        context = multiprocessing.get_context("spawn")
        self._here, there = context.Pipe()
        self._process = context.Process(target=_work, args=(there, modules), daemon=True)
        with _interrupts_ignored():
            self._process.start()
        there.close()

    def found(self, work: Callable[[], Any]) -> tuple[Any, bool]:
        """Have a piece of work done: its result, and whether there is one.

        Raises
        ------
        OSError, EOFError
            If the process has ended.
        """
        self._here.send(work)
        found: tuple[Any, bool] = self._here.recv()
        return found

    def stop(self) -> None:
        """End it, whatever it does."""
        self._process.terminate()
        self._process.join()


def _work(orders: Connection, modules: Sequence[str]) -> None:
    """Do what is ordered, until there is nobody to order any more."""
    with contextlib.suppress(ImportError):  # what needs it will say so
        load(modules)
    with contextlib.suppress(EOFError, OSError):
        while True:
            work = orders.recv()
            try:
                found = work(), True
            except Exception:  # whoever waits does it again, and sees what is raised
                found = None, False
            orders.send(found)


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
