"""Comparison to the 3D alpha shape (paper, section 5.3 and figures 13 and 14).

Builds the L and the three spheres by slice-and-loft, by the 3D alpha shape and by the octree's boundary,
with probe radii of 0.5, 1 and infinity, and without shape recognition, so that nothing but the radius
makes the difference. Prints the table of each and draws all models side by side.

Shows what the paper found: with a small probe the 3D alpha shape takes points within the thing for its
surface and is uneven, while the loft holds; with an infinite one both lose the inner corner of the L, and
only the 3D alpha shape loses the necks of the spheres, which lie across the slices. Of the three radii, 1 is
the best for the L and infinity for the spheres.

    python examples/comparison.py [FOLDER]
"""

from __future__ import annotations

import math
from pathlib import Path

from sketchloft import Params
from sketchloft.compare import Comparison, compare, slice_and_loft
from sketchloft.report.comparison import draw_comparison
from trial import ALONG_Z, UNIT, cloud_of, goal_mesh, run

__all__ = ["main"]

RADII = (0.5, 1.0, math.inf)
TITLES = {"l-shape": "L", "three-spheres": "Three overlapping spheres"}


def main(folder: Path, n: int) -> list[Path]:
    """Compare the methods on both goals."""
    written = []
    for name, title in TITLES.items():
        cloud = cloud_of(name, n)
        loft = slice_and_loft(cloud, Params(method="paper", direction=ALONG_Z))
        found = compare(cloud, RADII, loft, goal=goal_mesh(name))
        _print_table(found, title)
        written.append(folder / f"comparison-{name}.png")
        draw_comparison(found, written[-1], unit=UNIT, title=title)
    return written


def _print_table(found: Comparison, title: str) -> None:
    print(f"{title}\n  {'method':14}  probe     rms   rms ‰    max  missed  volume   faces shells seconds")
    for row in found.rows:
        radius = "" if row.probe_radius is None else f"{row.probe_radius:g}"
        figures = f"  {row.remark}"
        if row.errors and row.missed and row.surface and row.volume_error is not None:
            lengths = f"{row.errors.rms:7.4f} {row.rms_thousandths:7.2f} {row.errors.max:6.3f}"
            counts = f"{row.faces:7} {row.surface.shells:6} {row.seconds:7.2f}"
            figures = f"{lengths} {row.missed.rms:7.4f} {100 * row.volume_error:+6.1f}% {counts}"
        print(f"  {row.method:14} {radius:>6} {figures}")


if __name__ == "__main__":
    run(main, __doc__, "demo/comparison")
