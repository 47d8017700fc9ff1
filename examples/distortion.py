"""Check for distortion (paper, section 5.2 and figure 12).

Covers a sphere of radius 3 with 10,000 points that all lie on its surface, as a scanner would, and lofts
it through circles. What is left of the error is what slicing and lofting itself distorts.

Shows what the paper found: the largest errors are at the top and at the bottom, and faint rings remain
where the circles are not quite concentric. Both are printed: the errors of the outer tenths of the height
beside those between, and how far the centres of the circles stray from the axis.

    python examples/distortion.py [FOLDER]
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from gallery import Panel, draw_gallery
from sketchloft.measurement import Measurement
from sketchloft.report.error_map import draw_error_map
from sketchloft.sample import FillParams
from sketchloft.shapes.circle import Circle
from trial import UNIT, cloud_of, print_figures, run, trial

__all__ = ["main"]

OUTER = 0.1
"""Share of the height that counts as the top, and as the bottom."""


def main(folder: Path, n: int) -> list[Path]:
    """Build, measure and draw the sphere."""
    cloud = cloud_of("sphere", n, FillParams("surface"))
    splines, circles = trial(cloud, shapes="off"), trial(cloud, shapes="circle")
    height = circles.measured.points[:, 2]
    low, high = np.quantile(height, [OUTER, 1 - OUTER])
    outer = (height < low) | (height > high)
    print_figures(
        {
            "splines": splines.measured,
            "circles": circles.measured,
            "  top and bottom": _part(circles.measured, outer),
            "  between": _part(circles.measured, ~outer),
        }
    )
    shapes = [section.shape for section in circles.lofted.sections]
    centres = np.array([shape.centre for shape in shapes if isinstance(shape, Circle)])
    stray = np.sqrt(np.square(centres - centres.mean(axis=0)).sum(axis=1).mean())
    print(f"centres of {len(centres)} circles: rms {stray:.4f} {UNIT} from their axis")
    draw_error_map(
        circles.measured,
        folder / "distortion-error.png",
        unit=UNIT,
        title=f"Sphere of radius 3, {n:,} points on its surface, sections as circles",
    )
    panels = [
        Panel("Cloud", f"{n:,} points on the surface", cloud),
        Panel("Sections as splines", splines.rms, splines.mesh),
        Panel("Sections as circles", circles.rms, circles.mesh),
    ]
    return [folder / "distortion-error.png", draw_gallery(panels, folder / "distortion-models.png")]


def _part(measured: Measurement, chosen: np.ndarray) -> Measurement:
    return replace(measured, points=measured.points[chosen], distances=measured.distances[chosen])


if __name__ == "__main__":
    run(main, __doc__, "demo/distortion")
