"""Find the slicing direction (paper, section 4.3 and figure 4).

Slices one L along x, y and z, lofts each, and draws the three results side by side with the value that the
target function of `--axis auto` gives their direction. Along z every section is the L itself, the direction
that the paper and the automatic choice take. Along x and y the sections are rectangles that jump at the
corner: the loft must cross the jump there, but between the jumps a rectangle is recognised and followed
closely, so that the measured errors, which are printed, can be smaller than along z.

    python examples/directions.py [FOLDER]
"""

from __future__ import annotations

from pathlib import Path

from sketchloft.direction import DirectionParams, parse_axis
from sketchloft.report.directions_figure import directions_figure
from sketchloft.report.picture import save_figure
from sketchloft.report.words import direction_words
from trial import UNIT, cloud_of, print_figures, run, trial

__all__ = ["main"]


def main(folder: Path, n: int) -> list[Path]:
    """Build, measure and draw the L along each axis."""
    cloud = cloud_of("l-shape", n)
    trials = {axis: trial(cloud, DirectionParams(parse_axis(axis))) for axis in ("x", "y", "z", "auto")}
    print_figures({f"along {axis}": one.measured for axis, one in trials.items()})
    print(f"auto is {direction_words(trials.pop('auto').lofted.direction.vector)}")
    picture = folder / "directions.png"
    save_figure(directions_figure([one.result for one in trials.values()], unit=UNIT), picture)
    return [picture]


if __name__ == "__main__":
    run(main, __doc__, "demo/directions")
