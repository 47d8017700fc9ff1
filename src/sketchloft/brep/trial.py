"""Trial: what might crash the process is tried in a child first."""

from __future__ import annotations

import contextlib
import faulthandler
import os
import resource
import signal
import time
import warnings
from collections.abc import Callable
from typing import NoReturn, TypeVar

from sketchloft.errors import InputError

__all__ = ["tried"]

Result = TypeVar("Result")


def tried(read: Callable[[], Result], seconds: float) -> Result:
    """Read something with the CAD kernel, after a child process has come through it alive.

    Parameters
    ----------
    read : callable
        Without side effects.
    seconds : float
        How long it may take.

    Raises
    ------
    InputError
        If the child crashes, fails or does not come to an end.

    Notes
    -----
    On damaged files the kernel's readers crash, run forever or print to standard output, none of which can be
    caught. A forked child costs a few milliseconds, and reading is short beside what follows it.
    """
    with warnings.catch_warnings():
        # Python 3.12 warns of forking beside threads; the child runs the kernel's reader and ends.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if not child:
        _run(read)
    status = _wait(child, seconds)
    if status is None:
        raise InputError(
            f"keeps the CAD kernel busy for over {seconds:.0f} s; it may be damaged, export it again"
        )
    if status != 0:
        raise InputError("is damaged, the CAD kernel cannot read it; export it again")
    return read()


def _run(read: Callable[[], object]) -> NoReturn:
    """Read, silently, and end this process with exit code 0 if it worked."""
    code = 1
    with contextlib.suppress(BaseException):
        faulthandler.disable()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        read()
        code = 0
    os._exit(code)


def _wait(child: int, seconds: float) -> int | None:
    """Status that the child ended with; None, and no child any more, if it does not in time."""
    end, pause = time.monotonic() + seconds, 1e-3
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return status
        time.sleep(pause)
        pause = min(2 * pause, 0.05)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None
