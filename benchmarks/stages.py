"""Times of every stage at 10^4, 10^5 and 10^6 points, and how they grow (`make bench`).

Fills a goal with points, and for each number of points, in a process of its own, reads the cloud from a
PLY file, builds the solid and writes it as STEP. Each stage ends when the next begins. The processes load
and use every module once before they are timed, so that the table shows the work alone; what a command
takes as a whole, with loading, stands below it.

    python benchmarks/stages.py [--goal lamp] [--sizes 10000,100000,1000000] [--method exact]
"""

from __future__ import annotations

import argparse
import itertools
import math
import multiprocessing
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sketchloft.pipeline import Method

# Sketchloft is imported in the processes that are timed: memory that this one holds would count as theirs.

__all__ = ["Timing", "table", "timed"]

GOAL, SIZES, METHOD = "lamp", "10000,100000,1000000", "exact"
SEED = 1
WARM_UP = 2_000
"""Points of the cloud that loads all modules."""
REPEATS = 5
MEBI = 1 << 20
TINY = 5e-3
"""Seconds below which growth is not told: it would be that of the clock."""


@dataclass(frozen=True)
class Timing:
    """What one number of points took.

    Parameters
    ----------
    points : int
    seconds : dict of str to float
        By stage, from reading to writing, in their order.
    memory, before : int
        Peak memory of the process at the end, and when reading began, in bytes.
    """

    points: int
    seconds: dict[str, float]
    memory: int
    before: int

    @property
    def total(self) -> float:
        """Seconds from the cloud's file to the model's."""
        return sum(self.seconds.values())


def draw(goal: str, points: int, cloud: Path) -> None:
    """Write a cloud."""
    from sketchloft import write_cloud  # noqa: PLC0415
    from sketchloft.sample import GOALS, sample_goal  # noqa: PLC0415

    write_cloud(cloud, sample_goal(GOALS[goal], points, seed=SEED))


def timed(method: Method, cloud: Path, warm_up: Path | None = None) -> Timing:
    """Time every stage from a cloud's file to a STEP file beside it, after a warm-up with another cloud."""
    from sketchloft import NamedSolid, Params, read_cloud, reconstruct, write_model  # noqa: PLC0415

    if warm_up is not None:
        timed(method, warm_up)
    before = _peak_memory()
    marks: list[tuple[str, float]] = []

    def begin(stage: str) -> None:
        marks.append((stage, time.perf_counter()))

    begin("read")
    points = read_cloud(cloud)
    result = reconstruct(points, Params(method=method), begin)
    begin("write")
    write_model(cloud.with_suffix(".step"), [NamedSolid(body.name, body.solid) for body in result.bodies])
    begin("end")
    seconds: dict[str, float] = {}
    for (stage, start), (_, end) in itertools.pairwise(marks):
        seconds[stage] = seconds.get(stage, 0.0) + end - start
    return Timing(len(points), seconds, _peak_memory(), before)


def table(timings: list[Timing]) -> str:
    """Lay out seconds by stage and size, with the factor from size to size and the exponent of growth."""
    stages = dict.fromkeys(stage for one in timings for stage in one.seconds)
    rows = {stage: [one.seconds.get(stage, 0.0) for one in timings] for stage in stages}
    rows["total"] = [one.total for one in timings]
    sizes = [one.points for one in timings]
    head = [f"{size:,}" for size in sizes] + [f"x{b / a:g}" for a, b in itertools.pairwise(sizes)]
    lines = [f"{'seconds':14}" + "".join(f"{word:>11}" for word in [*head, "exponent"])]
    for stage, seconds in rows.items():
        cells = [f"{s:.3f}" for s in seconds]
        cells += [_factor(a, b) for a, b in itertools.pairwise(seconds)]
        lines.append(f"{stage:14}" + "".join(f"{cell:>11}" for cell in [*cells, _exponent(sizes, seconds)]))
    for name, memory in (
        ("peak MiB", [t.memory for t in timings]),
        ("  before", [t.before for t in timings]),
    ):
        lines.append(f"{name:14}" + "".join(f"{b / MEBI:11.0f}" for b in memory))
    return "\n".join(lines)


def _factor(before: float, after: float) -> str:
    return f"{after / before:.1f}" if before > TINY else "-"


def _exponent(sizes: list[int], seconds: list[float]) -> str:
    """Of the power of the number of points that grows as much as the last step does."""
    if len(sizes) < 2 or seconds[-2] <= TINY:
        return "-"
    return f"{math.log(seconds[-1] / seconds[-2]) / math.log(sizes[-1] / sizes[-2]):.2f}"


def _peak_memory() -> int:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else peak * 1024


def command_seconds(*arguments: str) -> float:
    """Median wall time of a whole command."""
    command = [str(Path(sys.executable).with_name("sketchloft")), *arguments]

    def once() -> float:
        begun = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        return time.perf_counter() - begun

    return statistics.median(once() for _ in range(REPEATS))


def main(goal: str, sizes: list[int], method: Method) -> None:
    """Run the benchmark and print it."""
    fresh = multiprocessing.get_context("spawn")
    timings = []
    with (
        tempfile.TemporaryDirectory() as folder,
        ProcessPoolExecutor(1, mp_context=fresh, max_tasks_per_child=1) as pool,
    ):
        clouds = {size: Path(folder) / f"{size}.ply" for size in (WARM_UP, *sizes)}
        for size, cloud in clouds.items():
            pool.submit(draw, goal, size, cloud).result()
        for size in sizes:
            timings.append(pool.submit(timed, method, clouds[size], clouds[WARM_UP]).result())
            said = f"{goal}, {method}, {size:,} points: {timings[-1].total:.2f} s"
            print(said, file=sys.stderr, flush=True)
        print(table(timings))
        print(f"\nwhole commands, median of {REPEATS}:")
        print(f"  sketchloft --help                 {command_seconds('--help'):6.2f} s")
        model = str(Path(folder) / "model.step")
        built = command_seconds("build", str(clouds[sizes[0]]), "-o", model, "--method", method)
        print(f"  sketchloft build, {sizes[0]:>7,} points {built:8.2f} s")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--goal", default=GOAL, help="[default: %(default)s]")
    parser.add_argument("--sizes", default=SIZES, help="[default: %(default)s]")
    parser.add_argument("--method", default=METHOD, help="exact or paper [default: %(default)s]")
    asked = parser.parse_args()
    main(asked.goal, [int(size) for size in asked.sizes.split(",")], asked.method)
