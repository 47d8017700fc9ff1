"""Trial: the cloud of a known goal, the model made of it, and how far that lies from the goal."""

from __future__ import annotations

import argparse
import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from sketchloft import Measurement, Mesh, Params, PointCloud, Reconstruction, measure, reconstruct
from sketchloft.brep.primitives import fuse
from sketchloft.brep.tessellate import tessellate
from sketchloft.cloud import Unit
from sketchloft.direction import DirectionParams
from sketchloft.pipeline import BodyModel
from sketchloft.sample import GOALS, FillParams, sample_goal
from sketchloft.shapes.choice import ShapesParams

__all__ = ["ALONG_Z", "UNIT", "Trial", "cloud_of", "goal_mesh", "print_figures", "run", "trial"]

UNIT: Unit = "mm"
N, SEED = 10_000, 1
CHORD = 1e-4
"""Largest distance between a surface and its triangles, in diagonals: far below the errors to be seen."""
ALONG_Z = DirectionParams((0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Trial:
    """A model and its measurement against the goal."""

    result: Reconstruction
    measured: Measurement

    @classmethod
    def of(cls, result: Reconstruction, goal: str) -> Self:
        """Measure the model of a goal's cloud."""
        return cls(result, measure(tessellate(result.bodies[0].solid, CHORD), goal_mesh(goal)))

    @property
    def lofted(self) -> BodyModel:
        """The body, which was sliced and lofted."""
        body = self.result.bodies[0]
        if not isinstance(body, BodyModel):
            raise TypeError(f"found the method {self.result.params.method}, expected paper")
        return body

    @property
    def mesh(self) -> Mesh:
        """Triangles of the model."""
        return self.measured.model

    @property
    def shapes(self) -> str:
        """Kinds of sections that it was lofted through."""
        kinds = {section.shape.kind for section in self.lofted.sections}
        return " and ".join(f"{kind}s" for kind in sorted(kinds))

    @property
    def rms(self) -> str:
        """Error in one line, for pictures."""
        length, share = self.measured.errors.rms, self.measured.errors_in_thousandths.rms
        return f"rms {length:#.3g} {UNIT} ({share:#.2g} ‰)"


def cloud_of(name: str, n: int = N, fill: FillParams | None = None) -> PointCloud:
    """Draw the cloud of a goal, always the same one."""
    return sample_goal(GOALS[name], n, fill, seed=SEED)


@functools.cache
def goal_mesh(name: str) -> Mesh:
    """Triangles of a goal's exact solid."""
    return tessellate(fuse(GOALS[name].parts), CHORD)


def trial(cloud: PointCloud, direction: DirectionParams = ALONG_Z, shapes: str = "auto") -> Trial:
    """Build a model of a goal's cloud by the paper's method and measure it."""
    params = Params(method="paper", direction=direction, shapes=ShapesParams(shapes))
    return Trial.of(reconstruct(cloud, params), cloud.name)


def print_figures(rows: dict[str, Measurement]) -> None:
    """Print a row of figures for each of several models."""
    width = max(map(len, rows))
    print(f"{'':{width}}    rms    mean     p95     max   rms ‰  back ‰  volume")
    for name, found in rows.items():
        one, share, back = found.errors, found.errors_in_thousandths.rms, found.back_errors_in_thousandths.rms
        lengths = f"{one.rms:7.4f} {one.mean:+7.4f} {one.p95:7.4f} {one.max:7.4f}"
        print(f"{name:{width}} {lengths} {share:7.2f} {back:7.2f} {100 * found.volume_error:+6.2f}%")


def run(main: Callable[[Path, int], Sequence[Path]], text: str | None, folder: str) -> None:
    """Call an example with the folder and the number of points that the command line asks for."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=Path(folder), help="[default: %(default)s]")
    parser.add_argument("-n", type=int, default=N, help="number of points [default: %(default)s]")
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    print("written: " + ", ".join(map(str, main(asked.folder, asked.n))))
