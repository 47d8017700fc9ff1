"""Demo: three overlapping spheres, from the cloud to the measured CAD model (`make demo`).

Draws the paper's sample cloud (figure 3), builds the model with the defaults that `sketchloft build` has,
measures it against the exact solid, and leaves everything in one folder: the cloud, the model as STEP and
STL, the goal, a picture of every stage (figures 3 and 5 to 9), the error map (figure 11) and the report.

    python examples/demo.py [FOLDER]
"""

from __future__ import annotations

from pathlib import Path

from sketchloft import NamedSolid, Reconstruction, write_cloud, write_model
from sketchloft.brep.primitives import fuse
from sketchloft.direction import DirectionParams
from sketchloft.report.cloud_figure import cloud_figure
from sketchloft.report.distance_figure import distance_figure
from sketchloft.report.error_map import draw_error_map
from sketchloft.report.evidence_figure import evidence_figure
from sketchloft.report.html import write_report
from sketchloft.report.loft_figure import loft_figure
from sketchloft.report.overview_figure import overview_figure
from sketchloft.report.picture import save_figure
from sketchloft.report.sections_figure import sections_figure
from sketchloft.report.side_figure import side_figure
from sketchloft.sample import GOALS
from sketchloft.summary import summary_lines
from trial import UNIT, cloud_of, run, trial

__all__ = ["draw_stages", "main"]

NAME = "three-spheres"


def main(folder: Path, n: int) -> list[Path]:
    """Leave everything in the folder and print the key figures."""
    cloud = cloud_of(NAME, n)
    one = trial(cloud, DirectionParams())
    files = [folder / name for name in ("cloud.ply", "model.step", "model.stl", "goal.step", "report.html")]
    cloud_file, *models, goal_file, report = files
    write_cloud(cloud_file, cloud)
    write_model(models, [NamedSolid(body.name, body.solid) for body in one.result.bodies], UNIT)
    write_model(goal_file, [NamedSolid(f"{NAME}-goal", fuse(GOALS[NAME].parts))], UNIT)
    pictures = [*draw_stages(one.result, folder), folder / "error-map.png"]
    draw_error_map(one.measured, pictures[-1], unit=UNIT, title=f"Three spheres, {n:,} points")
    write_report(one.result, report, unit=UNIT, measurement=one.measured)
    for line in summary_lines(one.result, UNIT):
        print(line)
    error = f"{one.rms}, largest {one.measured.errors.max:.3g} {UNIT}"
    print(f"measured against the goal: {error}, volume error {100 * one.measured.volume_error:+.2f} %")
    return [*files, *pictures]


def draw_stages(result: Reconstruction, folder: Path) -> list[Path]:
    """Draw every stage of the first body, in the order of the stages."""
    body = result.bodies[0]
    figures = {
        "cloud": cloud_figure(result, body, unit=UNIT),
        "slice-planes": distance_figure(result, body, unit=UNIT),
        "edge-points": side_figure(result, body, unit=UNIT),
        "sections": sections_figure(result, body, unit=UNIT),
        "evidence": evidence_figure(body, unit=UNIT),
        "loft": loft_figure(result, body, unit=UNIT),
        "overview": overview_figure(result, unit=UNIT),
    }
    for name, figure in figures.items():
        save_figure(figure, folder / f"{name}.png")
    return [folder / f"{name}.png" for name in figures]


if __name__ == "__main__":
    run(main, __doc__, "demo")
