"""Console: progress and remarks on standard error, results on standard output."""

from __future__ import annotations

import contextlib
import json
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Annotated, Any

from cyclopts import Parameter

__all__ = ["Json", "Quiet", "Verbose", "progress", "remark", "show", "show_json"]

Json = Annotated[bool, Parameter(name="--json", negative="", help="Print the result as JSON.")]
Quiet = Annotated[
    bool, Parameter(name=["--quiet", "-q"], negative="", help="Say nothing but results and errors.")
]
Verbose = Annotated[
    bool, Parameter(name=["--verbose", "-v"], negative="", help="Say how long each stage took.")
]


@contextlib.contextmanager
def progress(stages: Sequence[str], *, quiet: bool, verbose: bool) -> Iterator[Callable[[str], None]]:
    """Show which stage is at work: a bar on a terminal, a line per stage with `verbose`.

    Yields
    ------
    callable
        To be called with the name of each stage when it begins.
    """
    if verbose and not quiet:
        with _lines() as begin:
            yield begin
    elif quiet or not sys.stderr.isatty():
        yield lambda _: None
    else:
        with _bar(stages) as begin:
            yield begin


@contextlib.contextmanager
def _lines() -> Iterator[Callable[[str], None]]:
    now: tuple[str, float] | None = None

    def begin(stage: str) -> None:
        nonlocal now
        if now is not None:
            remark(f"{now[0]}: {time.perf_counter() - now[1]:.2f} s")
        now = (stage, time.perf_counter())

    yield begin
    if now is not None:
        remark(f"{now[0]}: {time.perf_counter() - now[1]:.2f} s")


@contextlib.contextmanager
def _bar(stages: Sequence[str]) -> Iterator[Callable[[str], None]]:
    from rich.console import Console  # noqa: PLC0415  only where there is somebody to look at it
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn  # noqa: PLC0415

    columns = (TextColumn("{task.description:<16}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(stages[0], total=len(stages))

        def begin(stage: str) -> None:
            done = stages.index(stage) if stage in stages else 0
            bar.update(task, description=stage, completed=done)

        yield begin


def remark(text: str) -> None:
    """Say something beside the result."""
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()


def show(text: str) -> None:
    """Print a line of the result."""
    sys.stdout.write(f"{text}\n")


def show_json(value: Any) -> None:
    """Print the result for machines."""
    show(json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False))
