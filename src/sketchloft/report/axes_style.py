"""Axes: the calm look that all panels share."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.artist import Artist
from matplotlib.axes import Axes

from sketchloft.report.palette import GRID, INK, MUTED

__all__ = ["heading", "legend_below", "note", "style_axes"]

LABELS = 4.5
"""Room that tick labels and the axis label take below a panel, in sizes of the legend's letters."""


def style_axes(ax: Axes, *, grid: bool = True) -> None:
    """Take away what is not needed to read a plot."""
    ax.spines[["top", "right"]].set_visible(False)
    ax.spines[["left", "bottom"]].set_color(MUTED)
    ax.tick_params(colors=MUTED, labelsize=8, length=3)
    ax.ticklabel_format(scilimits=(-3, 6))
    ax.xaxis.get_offset_text().set(size=7, color=MUTED)
    ax.yaxis.get_offset_text().set(size=7, color=MUTED, x=-0.02, ha="right")
    ax.xaxis.label.set(color=INK, size=9)
    ax.yaxis.label.set(color=INK, size=9)
    if grid:
        ax.grid(color=GRID, linewidth=0.7)
        ax.set_axisbelow(True)


def heading(ax: Axes, title: str, below: str) -> None:
    """Title of a panel, and a second line in grey."""
    ax.set_title(title + "\n", fontsize=10, color=INK, pad=6)
    ax.annotate(
        below,
        (0.5, 1),
        (0, 6),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=8,
        color=MUTED,
        annotation_clip=False,
    )


def note(ax: Axes, text: str) -> None:
    """Small words at the bottom of a panel, on a pale ground."""
    ax.annotate(
        text,
        (0.5, 0.02),
        xycoords="axes fraction",
        ha="center",
        fontsize=7,
        color=INK,
        bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 1.5},
        zorder=6,
    )


def legend_below(ax: Axes, handles: Sequence[Artist] | None = None, *, columns: int) -> None:
    """Legend under a panel, of what is given or of all that has a label."""
    ax.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, 0),
        borderaxespad=LABELS if ax.axison else 0.5,
        ncols=columns,
        frameon=False,
        fontsize=8,
        handlelength=1.2,
        columnspacing=1.4,
        markerscale=2.0 if handles is None else 1.0,
    )
