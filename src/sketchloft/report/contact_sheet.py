"""Contact sheet: rows of small square panels, each at its own scale."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats
from sketchloft.report.picture import new_figure

__all__ = ["COLUMNS", "contact_sheet", "fit_panel"]

COLUMNS = 4


def contact_sheet(rows: int) -> tuple[Figure, list[Axes]]:
    """Figure with square panels; placing them by hand is faster than by their texts."""
    width, height = 11.5, 3.05 * rows + 0.75
    left, right, bottom, top, panel = 0.7, 0.15, 0.6, 0.85, 2.35
    across = (width - left - right - COLUMNS * panel) / (COLUMNS - 1)
    down = (height - bottom - top - rows * panel) / max(rows - 1, 1)
    figure = new_figure(width, height)
    figure.set_layout_engine("none")
    place = {
        "left": left / width,
        "right": 1 - right / width,
        "bottom": bottom / height,
        "top": 1 - top / height,
        "wspace": across / panel,
        "hspace": down / panel,
    }
    return figure, figure.subplots(rows, COLUMNS, squeeze=False, gridspec_kw=place).ravel().tolist()


def fit_panel(ax: Axes, points: Floats, below: float = 0.15) -> None:
    """Square limits that hold the points, and room for text below, as a share of their half width."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, 0.6 * float((high - low).max())
    ax.set_xlim(middle[0] - half, middle[0] + half)
    ax.set_ylim(middle[1] - (1 + below) * half, middle[1] + half)
    ax.set_aspect("equal")
