"""Demo: three overlapping spheres, from the cloud to the measured CAD model (`make demo`).

Draws the paper's sample cloud (figure 3), builds the model with the defaults that `sketchloft build` has,
measures it against the exact solid, and leaves everything in one folder: the cloud, the model as STEP and
STL, the goal, pictures of what was found, from the points to the faces, the error map (figure 11) and the
report. The stages of the paper's own method are in `examples/slices.py`.

    python examples/demo.py [FOLDER]
"""

from __future__ import annotations

from pathlib import Path

from sketchloft import NamedSolid, Reconstruction, reconstruct, write_cloud, write_model
from sketchloft.brep.primitives import fuse
from sketchloft.exact.body import ExactBody
from sketchloft.report.axial_profile_figure import axial_profile_figure
from sketchloft.report.cuts_figure import cuts_figure
from sketchloft.report.error_map import draw_error_map
from sketchloft.report.html import write_report
from sketchloft.report.kinds_figure import kinds_figure
from sketchloft.report.overview_figure import overview_figure
from sketchloft.report.picture import save_figure
from sketchloft.report.precision import precision
from sketchloft.report.runs_figure import runs_figure
from sketchloft.report.wall_distance_figure import wall_distance_figure
from sketchloft.sample import GOALS
from sketchloft.summary import summary_lines
from trial import UNIT, Trial, cloud_of, run

__all__ = ["draw_findings", "main"]

NAME = "three-spheres"


def main(folder: Path, n: int) -> list[Path]:
    """Leave everything in the folder and print the key figures."""
    cloud = cloud_of(NAME, n)
    one = Trial.of(reconstruct(cloud), NAME)
    files = [folder / name for name in ("cloud.ply", "model.step", "model.stl", "goal.step", "report.html")]
    cloud_file, *models, goal_file, report = files
    write_cloud(cloud_file, cloud)
    write_model(models, [NamedSolid(body.name, body.solid) for body in one.result.bodies], UNIT)
    write_model(goal_file, [NamedSolid(f"{NAME}-goal", fuse(GOALS[NAME].parts))], UNIT)
    pictures = [*draw_findings(one.result, folder), folder / "error-map.png"]
    draw_error_map(one.measured, pictures[-1], unit=UNIT, title=f"Three spheres, {n:,} points")
    write_report(one.result, report, unit=UNIT, measurement=one.measured)
    for line in summary_lines(one.result, UNIT):
        print(line)
    error = f"{one.rms}, largest {one.measured.errors.max:.3g} {UNIT}"
    print(f"measured against the goal: {error}, volume error {100 * one.measured.volume_error:+.2f} %")
    return [*files, *pictures]


def draw_findings(result: Reconstruction, folder: Path) -> list[Path]:
    """Draw what was found of the first body, from its points to its faces."""
    body = result.bodies[0]
    if not isinstance(body, ExactBody):
        raise TypeError(f"found a loft, expected exact walls: {body.instead or 'the method is paper'}")
    errors = precision(body)
    figures = {
        "cuts": cuts_figure(result, body, unit=UNIT),
        "profile": axial_profile_figure(result, body, unit=UNIT),
        "runs": runs_figure(result, body, errors, unit=UNIT),
        "kinds": kinds_figure(result, body, unit=UNIT),
        "walls": wall_distance_figure(result, body, errors, unit=UNIT),
        "overview": overview_figure(result, unit=UNIT),
    }
    for name, figure in figures.items():
        save_figure(figure, folder / f"{name}.png")
    return [folder / f"{name}.png" for name in figures]


if __name__ == "__main__":
    run(main, __doc__, "demo")
