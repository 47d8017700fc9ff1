"""Results quantification (paper, section 5.1 and figures 10 and 11).

Builds the three overlapping spheres from 10,000 points twice, with sections as free splines and with
sections recognised as circles, and measures the signed normal distance of each model from the goal.

Shows what the paper found: recognising the circles takes the unevenness away (figure 10), the errors are
small nearly everywhere, and the largest lie where the spheres meet, on the outside (figure 11).

    python examples/quantify.py [FOLDER]
"""

from __future__ import annotations

from pathlib import Path

from gallery import Panel, draw_gallery
from sketchloft.report.error_map import draw_error_map
from trial import UNIT, cloud_of, print_figures, run, trial

__all__ = ["main"]


def main(folder: Path, n: int) -> list[Path]:
    """Build, measure and draw both models."""
    cloud = cloud_of("three-spheres", n)
    trials = {
        kind: trial(cloud, shapes=shapes) for kind, shapes in (("splines", "off"), ("circles", "circle"))
    }
    print_figures({kind: one.measured for kind, one in trials.items()})
    written = [folder / f"quantify-{kind}.png" for kind in trials]
    for path, (kind, one) in zip(written, trials.items(), strict=True):
        draw_error_map(
            one.measured, path, unit=UNIT, title=f"Three spheres, {n:,} points, sections as {kind}"
        )
    panels = [
        Panel("Cloud", f"{n:,} points", cloud),
        Panel(
            "Without curve recognition",
            f"sections as splines, {trials['splines'].rms}",
            trials["splines"].mesh,
        ),
        Panel(
            "With curve recognition", f"sections as circles, {trials['circles'].rms}", trials["circles"].mesh
        ),
    ]
    return [*written, draw_gallery(panels, folder / "quantify-models.png")]


if __name__ == "__main__":
    run(main, __doc__, "demo/quantify")
