"""Every stage of the paper's method (paper, section 4 and figures 3 and 5 to 9).

Slices and lofts the cloud of three overlapping spheres with `--method paper` and draws what each stage made
of it: the surface points and the central axis, the slice planes at the extrema of the distance between
them, the worked points and the edge points, the shapes fitted to these, how well they fit, and the loft.

    python examples/slices.py [FOLDER]
"""

from __future__ import annotations

from pathlib import Path

from sketchloft.direction import DirectionParams
from sketchloft.report.cloud_figure import cloud_figure
from sketchloft.report.distance_figure import distance_figure
from sketchloft.report.evidence_figure import evidence_figure
from sketchloft.report.loft_figure import loft_figure
from sketchloft.report.picture import save_figure
from sketchloft.report.sections_figure import sections_figure
from sketchloft.report.side_figure import side_figure
from sketchloft.summary import summary_lines
from trial import UNIT, cloud_of, run, trial

__all__ = ["main"]


def main(folder: Path, n: int) -> list[Path]:
    """Draw every stage, in the order of the stages."""
    one = trial(cloud_of("three-spheres", n), DirectionParams())
    result, body = one.result, one.lofted
    figures = {
        "cloud": cloud_figure(result, body, unit=UNIT),
        "slice-planes": distance_figure(result, body, unit=UNIT),
        "edge-points": side_figure(result, body, unit=UNIT),
        "sections": sections_figure(result, body, unit=UNIT),
        "evidence": evidence_figure(body, unit=UNIT),
        "loft": loft_figure(result, body, unit=UNIT),
    }
    for name, figure in figures.items():
        save_figure(figure, folder / f"{name}.png")
    for line in summary_lines(result, UNIT):
        print(line)
    print(f"measured against the goal: {one.rms}")
    return [folder / f"{name}.png" for name in figures]


if __name__ == "__main__":
    run(main, __doc__, "demo/slices")
