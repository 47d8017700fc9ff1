"""Picture of what every slice rests on: its points, and their distance from the fitted shape."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from sketchloft.cloud import Unit
from sketchloft.pipeline import BodyModel
from sketchloft.report.axes_style import style_axes
from sketchloft.report.evidence import SliceEvidence, diagonal, slice_evidence
from sketchloft.report.palette import CLOUD, CURVES, EDGE, MUTED, QUIET
from sketchloft.report.picture import new_figure

__all__ = ["evidence_figure"]


def evidence_figure(body: BodyModel, *, unit: Unit) -> Figure:
    """Draw the number of points of every slice, and how far its edge points lie from its shape.

    Parameters
    ----------
    body : BodyModel
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    slices = slice_evidence(body)
    figure = new_figure(11.5, 4.2)
    counts, residuals = figure.subplots(1, 2)
    index = [one.index for one in slices]
    counts.bar(
        index, [one.points for one in slices], color=CLOUD, alpha=0.55, label="worked points", zorder=2
    )
    counts.bar(index, [one.edge_points for one in slices], 0.5, color=EDGE, label="edge points", zorder=3)
    counts.set(xlabel="slice", ylabel="points")
    _draw_residuals(residuals, slices, diagonal(body), unit)
    for ax in (counts, residuals):
        style_axes(ax)
        ax.grid(visible=False, axis="x")
        ax.legend(
            handles=ax.get_legend_handles_labels()[0] if ax is counts else _legend(slices),
            loc="lower right",
            bbox_to_anchor=(1, 1),
            ncols=6,
            frameon=False,
            fontsize=8,
        )
        ax.xaxis.get_major_locator().set_params(integer=True)
    return figure


def _draw_residuals(ax: Axes, slices: tuple[SliceEvidence, ...], size: float, unit: Unit) -> None:
    """Pale bars for the whole distance, strong ones inside for the part that is scatter."""
    index = [one.index for one in slices]
    paint = [CURVES[one.shape.kind] for one in slices]
    ax.bar(index, [one.rms for one in slices], color=paint, alpha=0.4, zorder=2)
    ax.bar(index, [one.scatter for one in slices], 0.5, color=paint, zorder=3)
    ax.set(xlabel="slice", ylabel=f"edge points from their shape [{unit}]")
    beside = ax.secondary_yaxis(
        "right",
        functions=(lambda d: 1000 * np.asarray(d) / size, lambda d: np.asarray(d) * size / 1000),
    )
    beside.set_ylabel("thousandths of the model's diagonal", fontsize=8, color=MUTED)
    beside.tick_params(colors=MUTED, labelsize=8)
    beside.spines["right"].set_visible(False)


def _legend(slices: tuple[SliceEvidence, ...]) -> list[Patch]:
    kinds = sorted({one.shape.kind for one in slices})
    meaning = [
        Patch(color=QUIET, label="pale: rms"),
        Patch(color=MUTED, label="strong: scatter about the mean"),
    ]
    return [*(Patch(color=CURVES[kind], label=kind) for kind in kinds), *meaning]
