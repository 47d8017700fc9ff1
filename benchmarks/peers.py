"""Sketchloft beside other methods on the same clouds: error, faces and time (`make bench`).

A row per cloud and method. The errors are root mean square normal distances in thousandths of the goal's
diagonal, from the model to the goal and from the goal to the model. The time is that of a whole process, from
the cloud's file to the model's. The peers are told the mean spacing of the points and shown at the best of
their settings (`meshers/`), that with the least of the larger of both errors; of their surface the largest
closed piece counts, so that islands and cavities are not held against them. They are extras: the row of one
that is not installed says how to install it.

    python benchmarks/peers.py [--n 10000,100000] [--goals lamp,sphere] [--clouds uniform,noisy]
"""

from __future__ import annotations

import argparse
import importlib.util
import itertools
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from meshers import MESHERS, Mesher
from outer_piece import outer_piece
from sketchloft import Mesh, PointCloud, SketchloftError, measure
from sketchloft.brep.files import load_mesh
from sketchloft.brep.primitives import fuse
from sketchloft.brep.tessellate import tessellate
from sketchloft.sample import GOALS, FillParams, sample_goal

__all__ = ["main", "peer_outcome", "sketchloft_outcome"]

SIZES, GOAL_NAMES = "10000", "three-spheres,sphere,l-shape,lamp"
CLOUDS = {"uniform": FillParams(), "noisy": FillParams(jitter=0.005, outliers=0.01)}
CHORD, ANGLE = 2e-5, 0.1
"""Fineness of the goals' triangles; the chord, in diagonals, is far below the errors to be seen."""
WARM_UP = 2_000
"""Points of the cloud that brings every package from the disk into memory before anything is timed."""
LIMIT = 900.0
"""Seconds after which a process is ended."""


@dataclass(frozen=True)
class Task:
    """A cloud, and what it should become.

    Parameters
    ----------
    cloud : Path
        Of a NumPy file.
    goal : Mesh
    spacing : float
        Cube root of the goal's volume per point.
    """

    cloud: Path
    goal: Mesh
    spacing: float


@dataclass(frozen=True)
class Outcome:
    """What a method made of a cloud.

    Parameters
    ----------
    there, back : float
        Root mean square distance from the model to the goal and from the goal to the model, in thousandths.
    faces : str
    seconds, busy : float
        Wall-clock time of the process, and processor time of all its threads.
    setting : str
    """

    there: float
    back: float
    faces: str
    seconds: float
    busy: float
    setting: str = ""

    @property
    def error(self) -> float:
        """The larger one."""
        return max(self.there, self.back)

    def __str__(self) -> str:
        """Cells of the table."""
        figures = f"{self.there:9.3f}{self.back:9.3f}{self.faces:>21}{self.seconds:9.2f}{self.busy:9.2f}"
        return f"{figures}  {self.setting}".rstrip()


class NoModelError(Exception):
    """A method made no model that can be measured; says why."""


def sketchloft_outcome(task: Task) -> Outcome:
    """Run `sketchloft build` as a user would."""
    model = task.cloud.with_suffix(".step")
    command = str(Path(sys.executable).with_name("sketchloft"))
    build = (command, "build", str(task.cloud), "-o", str(model), "--method", "exact", "--json", "--quiet")
    said, seconds, busy = _timed(*build)
    faces = sum(sum(body["faces"].values()) for body in json.loads(said)["bodies"])
    there, back = _errors(load_mesh(model, CHORD), task.goal)
    return Outcome(there, back, f"{faces} face{'s' * (faces != 1)}", seconds, busy)


def peer_outcome(mesher: Mesher, task: Task) -> Outcome:
    """Run a mesher at all its settings, and keep the best."""
    if importlib.util.find_spec(mesher.module) is None:
        raise NoModelError(f"not installed: {sys.executable} -m pip install {mesher.distribution}")
    found, reasons = [], []
    for setting in range(len(mesher.settings)):
        try:
            found.append(_at_setting(mesher, setting, task))
        except NoModelError as reason:
            reasons.append(reason)
    if not found:
        raise reasons[0]
    return min(found, key=lambda outcome: outcome.error)


def _at_setting(mesher: Mesher, setting: int, task: Task) -> Outcome:
    model = task.cloud.with_suffix(".npz")
    asked = (mesher.name, str(setting), str(task.spacing), str(task.cloud), str(model))
    _, seconds, busy = _timed(sys.executable, "-m", "meshers", *asked)
    with np.load(model) as arrays:
        mesh = Mesh(arrays["vertices"].astype(float), arrays["triangles"])
    if len(mesh.triangles) == 0:
        raise NoModelError("no triangles")
    piece = outer_piece(mesh)
    there, back = _errors(piece, task.goal)
    said = ", ".join(f"{name} {value:g}" for name, value in mesher.settings[setting].items())
    return Outcome(there, back, f"{len(piece.triangles):,} triangles", seconds, busy, said)


def _errors(model: Mesh, goal: Mesh) -> tuple[float, float]:
    try:
        found = measure(model, goal)
    except SketchloftError as error:
        raise NoModelError(str(error)) from None
    return found.errors_in_thousandths.rms, found.back_errors_in_thousandths.rms


def _timed(*command: str) -> tuple[str, float, float]:
    """What a command prints, its wall-clock seconds and its processor seconds."""
    busy, begun = _processor_seconds(), time.perf_counter()
    try:
        done = subprocess.run(
            command, cwd=Path(__file__).parent, check=True, capture_output=True, text=True, timeout=LIMIT
        )
    except subprocess.TimeoutExpired:
        raise NoModelError(f"not done after {LIMIT:.0f} s") from None
    except subprocess.CalledProcessError as error:
        said = error.stderr.strip().splitlines() or [f"ended with {error.returncode}"]
        raise NoModelError(said[-1]) from None
    return done.stdout, time.perf_counter() - begun, _processor_seconds() - busy


def _processor_seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


METHODS: dict[str, Callable[[Task], Outcome]] = {
    "sketchloft": sketchloft_outcome,
    **{mesher.name: partial(peer_outcome, mesher) for mesher in MESHERS},
}


def _outcomes(task: Task) -> Iterator[tuple[str, Outcome | NoModelError]]:
    """The outcome of each method, in turn."""
    for name, outcome in METHODS.items():
        try:
            yield name, outcome(task)
        except NoModelError as reason:
            yield name, reason


def _task(cloud: PointCloud, goal: Mesh, folder: Path) -> Task:
    path = folder / "cloud.npy"
    np.save(path, cloud.points)
    return Task(path, goal, float(np.cbrt(goal.volume / len(cloud))))


def main(sizes: list[int], goals: list[str], clouds: list[str], seed: int) -> None:
    """Print the table."""
    print(f"{len(os.sched_getaffinity(0))} cores; rms in thousandths of the diagonal; seconds of a process")
    head = f"{'goal':15}{'cloud':9}{'points':>9}  {'method':28}{'to goal':>9}{'back':>9}{'model':>21}"
    print(f"{head}{'seconds':>9}{'busy':>9}  best setting")
    with tempfile.TemporaryDirectory() as where:
        folder = Path(where)
        sphere = GOALS["sphere"]
        tuple(_outcomes(_task(sample_goal(sphere, WARM_UP), tessellate(fuse(sphere.parts)), folder)))
        for name in goals:
            goal = tessellate(fuse(GOALS[name].parts), CHORD, ANGLE)
            for n, cloud in itertools.product(sizes, clouds):
                task = _task(sample_goal(GOALS[name], n, CLOUDS[cloud], seed=seed), goal, folder)
                for method, outcome in _outcomes(task):
                    print(f"{name:15}{cloud:9}{n:9,}  {method:28}{outcome}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--n", default=SIZES, help="numbers of points [default: %(default)s]")
    parser.add_argument("--goals", default=GOAL_NAMES, help="[default: %(default)s]")
    parser.add_argument("--clouds", default=",".join(CLOUDS), help="[default: %(default)s]")
    parser.add_argument("--seed", type=int, default=1, help="of the clouds [default: %(default)s]")
    asked = parser.parse_args()
    main([int(n) for n in asked.n.split(",")], asked.goals.split(","), asked.clouds.split(","), asked.seed)
