"""Contact sheet of slices: worked points, edge points and the shape fitted to them (paper, figures 8 and 9a)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle as Disc

from sketchloft.cloud import Floats, Unit
from sketchloft.edge_points import EdgePoints
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import heading, style_axes
from sketchloft.report.palette import CLOUD, EDGE, INK, PROBE
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.words import number, probe_words, shape_size
from sketchloft.report.thinning import thinned

__all__ = ["sections_figure"]

COLUMNS = 4
MOST = 1_500
"""Worked points of a slice that are drawn; an even sample stands for more."""
AROUND = np.arange(361) / 360
TOUCH = np.pi / 4
"""Towards this angle the probe is shown, where it touches the contour from outside."""


def sections_figure(result: Reconstruction, body: BodyModel, *, unit: Unit, most: int = 12) -> Figure:
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
    figure = new_figure(11.5, 3.1 * rows + 0.4)
    panels = figure.subplots(rows, COLUMNS, squeeze=False).ravel()
    for ax, index in zip(panels, chosen.tolist(), strict=False):
        _draw_slice(ax, body, index, pose, unit)
    for ax in panels[len(chosen) :]:
        ax.set_axis_off()
    figure.supxlabel(pose.labels(unit)[0], fontsize=9, color=INK)
    figure.supylabel(pose.labels(unit)[1], fontsize=9, color=INK)
    figure.legend(handles=_legend(), loc="outside upper center", ncols=4, frameon=False, fontsize=9)
    return figure


def _draw_slice(ax: Axes, body: BodyModel, index: int, pose: Pose, unit: Unit) -> None:
    edge, shape = body.edges[index], body.sections[index].shape
    worked = pose.in_plan(thinned(body.worked[index].points, MOST))
    on_edge, outline = pose.in_plan(edge.points), pose.in_plan(shape.evaluate(AROUND))
    ax.scatter(*worked.T, s=3, c=CLOUD, alpha=0.6, linewidths=0, rasterized=True, zorder=2)
    ax.plot(*outline.T, color=INK, linewidth=1.3, zorder=3)
    ax.scatter(*on_edge.T, s=9, c=EDGE, linewidths=0, rasterized=True, zorder=4)
    ball = _probe(edge)
    if ball is not None:
        ax.add_patch(
            Disc(tuple(pose.in_plan(ball[None])[0]), edge.probe_radius, fill=False, color=PROBE, zorder=5)
        )
    _fit(ax, np.concatenate([worked, outline]))
    style_axes(ax)
    ax.tick_params(labelsize=7)
    ax.locator_params(nbins=4)
    height = number(float(pose.height(np.float64(edge.height))))
    heading(
        ax,
        f"slice {index}: {shape.kind}",
        f"at {height} {unit} · probe {probe_words(edge.probe_radius, unit)}",
    )
    ax.annotate(
        shape_size(shape, unit),
        (0.5, 0.02),
        xycoords="axes fraction",
        ha="center",
        fontsize=7,
        color=INK,
        bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 1.5},
        zorder=6,
    )


def _probe(edge: EdgePoints) -> Floats | None:
    """Centre of the probe where it rests on two neighbouring edge points, towards the upper right."""
    if not np.isfinite(edge.probe_radius):
        return None
    ring = edge.points - edge.centre
    onward = np.roll(ring, -1, axis=0) - ring
    length = np.linalg.norm(onward, axis=1)
    middle = ring + onward / 2
    towards = middle @ [np.cos(TOUCH), np.sin(TOUCH)]
    at = int(np.argmax(np.where(length < 2 * edge.probe_radius, towards, -np.inf)))
    outward = np.array([onward[at, 1], -onward[at, 0]]) / length[at]
    rise = np.sqrt(max(edge.probe_radius**2 - (length[at] / 2) ** 2, 0.0))
    return np.asarray(edge.centre + middle[at] + rise * outward)


def _fit(ax: Axes, points: Floats) -> None:
    """Square limits that hold the points, with room for the line of text below."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, 0.6 * float((high - low).max())
    ax.set_xlim(middle[0] - half, middle[0] + half)
    ax.set_ylim(middle[1] - 1.15 * half, middle[1] + half)
    ax.set_aspect("equal")


def _legend() -> list[Line2D]:
    dot = {"linestyle": "none", "marker": "o"}
    return [
        Line2D([], [], color=CLOUD, markersize=4, label="worked points", **dot),
        Line2D([], [], color=EDGE, markersize=5, label="edge points", **dot),
        Line2D([], [], color=INK, linewidth=1.3, label="fitted shape"),
        Line2D([], [], color=PROBE, markersize=10, fillstyle="none", label="probe at rest", **dot),
    ]
