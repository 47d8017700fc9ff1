"""Views: panels in parallel projection at one scale, each with the axes of the cloud as a measure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.transforms import Bbox

from sketchloft.cloud import Floats, Unit
from sketchloft.report.camera import Camera, project
from sketchloft.report.palette import MUTED

__all__ = ["finish_views", "round_length"]

ARM = 0.17
"""About how long the arm of an axis is, as a share of what is drawn."""
SHORTEST = 0.2
"""Arms that are foreshortened to less than this share are left out."""


def finish_views(views: Sequence[tuple[Axes, Camera]], unit: Unit) -> None:
    """Bring views to the same scale and draw x, y and z beside each, as orientation and scale in one.

    Parameters
    ----------
    views : sequence of (Axes, Camera)
        All that they show is drawn already.
    unit : {"mm", "cm", "m", "in"}
    """
    sizes = np.array([ax.dataLim.size for ax, _ in views])
    length = round_length(ARM * float(sizes.max()))
    for ax, camera in views:
        middle = np.add(ax.dataLim.min, ax.dataLim.max) / 2
        half = sizes.max(axis=0) / 2
        ax.dataLim = Bbox([middle - half, middle + half])
        ax.set_anchor("N")
        _draw_axes(ax, camera, length, unit)
        ax.autoscale_view()


def _draw_axes(ax: Axes, camera: Camera, length: float, unit: Unit) -> None:
    """Below the left corner of what is drawn, so that nothing is hidden."""
    arms = length * project(camera, np.eye(3))[:, :2]
    low, high = arms.min(axis=0).clip(max=0), arms.max(axis=0)
    corner = ax.dataLim.min - low - np.array([0, high[1] + 0.3 * length])

    def write(at: Floats, text: str, side: Literal["left", "center"]) -> None:
        ax.text(at[0], at[1], text, ha=side, va="center", color=MUTED, fontsize=8, zorder=4)

    for name, arm in zip("xyz", arms, strict=True):
        if np.linalg.norm(arm) >= SHORTEST * length:
            ax.plot(*np.stack([corner, corner + arm], axis=1), color=MUTED, linewidth=1.1, zorder=4)
            write(corner + arm * (1 + 0.28 * length / np.linalg.norm(arm)), name, "center")
    write(corner + np.array([high[0] + 0.6 * length, low[1] / 2]), f"each {length:g} {unit}", "left")
    ax.update_datalim(np.stack([corner + 1.4 * low, corner + low - np.array([0, 0.3 * length])]))


def round_length(length: float) -> float:
    """1, 2, 3 or 5 times a power of ten, the largest that is not longer."""
    power = 10 ** np.floor(np.log10(length))
    return float(power * max(step for step in (1, 2, 3, 5) if step * power <= length * (1 + 1e-9)))
