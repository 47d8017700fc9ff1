"""Contact sheet of slices: worked points, edge points and fitted shapes (paper, figures 8 and 9a)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle as Disc

from sketchloft.cloud import Floats, Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import heading, note, style_axes
from sketchloft.report.contact_sheet import COLUMNS, contact_sheet, fit_panel
from sketchloft.report.palette import CLOUD, EDGE, INK, PROBE
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.thinning import thinned
from sketchloft.report.words import probe_words, shape_size

__all__ = ["MOST_SLICES", "sections_figure"]

MOST_SLICES = 12
MOST = 1_500
"""Worked points of a slice that are drawn; an even sample stands for more."""
AROUND = np.arange(361) / 360


def sections_figure(
    result: Reconstruction, body: BodyModel, *, unit: Unit, most: int = MOST_SLICES
) -> Figure:
    """Draw evenly chosen slices, each at its own scale.

    Parameters
    ----------
    result : Reconstruction
    body : BodyModel
        One of its bodies.
    unit : {"mm", "cm", "m", "in"}
    most : int
        How many slices are shown; the first and the last always are.

    Returns
    -------
    matplotlib.figure.Figure
    """
    pose = pose_of(result, body)
    chosen = np.unique(np.linspace(0, len(body.sections) - 1, most).round().astype(int))
    rows = -(-len(chosen) // COLUMNS)
    figure, panels = contact_sheet(rows)
    for ax, index in zip(panels, chosen.tolist(), strict=False):
        _draw_slice(ax, body, index, pose, unit)
    for ax in panels[len(chosen) :]:
        ax.set_axis_off()
    figure.supxlabel(pose.labels(unit)[0], fontsize=9, color=INK)
    figure.supylabel(pose.labels(unit)[1], fontsize=9, color=INK)
    with_probe = any(np.isfinite(body.edges[index].probe_radius) for index in chosen)
    figure.legend(handles=_legend(with_probe), loc="upper center", ncols=4, frameon=False, fontsize=9)
    return figure


def _draw_slice(ax: Axes, body: BodyModel, index: int, pose: Pose, unit: Unit) -> None:
    edge, shape = body.edges[index], body.sections[index].shape
    worked = pose.in_plan(thinned(body.worked[index].points, MOST))
    on_edge, outline = pose.in_plan(edge.points), pose.in_plan(shape.evaluate(AROUND))
    ax.scatter(worked[:, 0], worked[:, 1], s=3, c=CLOUD, alpha=0.6, linewidths=0, rasterized=True, zorder=2)
    ax.plot(outline[:, 0], outline[:, 1], color=INK, linewidth=1.3, zorder=3)
    ax.scatter(on_edge[:, 0], on_edge[:, 1], s=9, c=EDGE, linewidths=0, rasterized=True, zorder=4)
    if np.isfinite(edge.probe_radius):
        x, y = _probe(on_edge, edge.probe_radius)
        ax.add_patch(Disc((x, y), edge.probe_radius, fill=False, color=PROBE, zorder=5))
    fit_panel(ax, np.concatenate([worked, outline]))
    style_axes(ax)
    ax.tick_params(labelsize=7)
    ax.locator_params(nbins=3)
    height = pose.height_words(edge.height, body)
    probe = probe_words(edge.probe_radius, unit)
    heading(ax, f"slice {index}: {shape.kind}", f"at {height} {unit}, probe {probe}")
    note(ax, shape_size(shape, unit))


def _probe(ring: Floats, radius: float) -> Floats:
    """Centre of the probe where it rests on two neighbouring edge points, towards the upper right."""
    onward = np.roll(ring, -1, axis=0) - ring
    length = np.linalg.norm(onward, axis=1)
    middle = ring + onward / 2
    towards = np.where(length < 2 * radius, middle @ [1, 1], -np.inf)
    at = int(np.argmax(towards))
    outward = np.array([onward[at, 1], -onward[at, 0]]) / length[at]
    return np.asarray(middle[at] + np.sqrt(max(radius**2 - (length[at] / 2) ** 2, 0.0)) * outward)


def _legend(with_probe: bool) -> list[Line2D]:
    worked = Line2D([], [], color=CLOUD, marker="o", linestyle="none", markersize=4, label="worked points")
    edge = Line2D([], [], color=EDGE, marker="o", linestyle="none", markersize=5, label="edge points")
    shape = Line2D([], [], color=INK, linewidth=1.3, label="fitted shape")
    probe = Line2D(
        [],
        [],
        color=PROBE,
        marker="o",
        linestyle="none",
        markersize=10,
        fillstyle="none",
        label="probe at rest",
    )
    return [worked, edge, shape, *([probe] if with_probe else [])]
