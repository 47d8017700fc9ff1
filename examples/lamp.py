"""Example of the results: a lamp (paper, section 5.4 and figure 15).

Builds a lamp with a round base, a rectangular stand and a conical shade from 10,000 points, first through
free splines, then with shapes recognised on every slice. The paper chose those by hand; here the automatic
choice is made, and printed in the form in which `--shapes` takes a choice by hand.

    python examples/lamp.py [FOLDER]
"""

from __future__ import annotations

import itertools
from pathlib import Path

from gallery import Panel, draw_gallery
from sketchloft.report.error_map import draw_error_map
from trial import UNIT, Trial, cloud_of, print_figures, run, trial

__all__ = ["main"]


def main(folder: Path, n: int) -> list[Path]:
    """Build, measure and draw both lamps."""
    cloud = cloud_of("lamp", n)
    splines, recognised = trial(cloud, shapes="off"), trial(cloud, shapes="auto")
    print_figures({"splines": splines.measured, "recognised": recognised.measured})
    print(f"--shapes {_by_hand(recognised)}")
    draw_error_map(
        recognised.measured,
        folder / "lamp-error.png",
        unit=UNIT,
        title=f"Lamp, {n:,} points, shapes recognised",
    )
    panels = [
        Panel("Cloud", f"{n:,} points", cloud),
        Panel("Without shape recognition", f"splines, {splines.rms}", splines.mesh),
        Panel("With shape recognition", f"{recognised.shapes}, {recognised.rms}", recognised.mesh),
    ]
    return [folder / "lamp-error.png", draw_gallery(panels, folder / "lamp-models.png")]


def _by_hand(one: Trial) -> str:
    """Shapes of all slices as the command line takes them, such as 0-3:circle,4:rectangle."""
    kinds = ["off" if s.shape.kind == "spline" else s.shape.kind for s in one.lofted.sections]
    words, first = [], 0
    for kind, members in itertools.groupby(kinds):
        last = first + len(list(members)) - 1
        words.append(f"{first}-{last}:{kind}" if last > first else f"{first}:{kind}")
        first = last + 1
    return ",".join(words)


if __name__ == "__main__":
    run(main, __doc__, "demo/lamp")
