"""Contact sheet of the runs: points near a height, and the section of the walls there."""

from __future__ import annotations

import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sketchloft.cloud import Floats, Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axes_style import heading, note, style_axes
from sketchloft.report.contact_sheet import COLUMNS, contact_sheet, fit_panel
from sketchloft.report.dimensions import dimensions
from sketchloft.report.nearby import nearby
from sketchloft.report.palette import CLOUD, INK, SURFACE
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.precision import Precision, spreads
from sketchloft.report.run_words import dimension_value, run_words, turn_of
from sketchloft.report.section_path import section_path
from sketchloft.report.words import counted, number, place

__all__ = ["runs_figure"]

MOST_PANELS = 16
"""Panels at most; of more runs an even choice is shown."""
LINE = 34
"""Letters in a line of a panel's text."""
LINES = 3
TITLE = 32
"""Letters in its title."""
BELOW = 0.38
"""Room for the text below a section, as a share of its half width."""
NO_BREAK = "\N{NO-BREAK SPACE}"


def runs_figure(result: Reconstruction, body: ExactBody, errors: Precision, *, unit: Unit) -> Figure:
    """Draw a section of every run, each at its own scale; several of the longest while there is room.

    Parameters
    ----------
    result : Reconstruction
    body : ExactBody
        One of its bodies.
    errors : Precision
        Of the body; they decide how many digits are shown.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    pose = pose_of(result, body)
    chosen = _chosen(body.model.stack.breaks)
    figure, panels = contact_sheet(-(-len(chosen) // COLUMNS))
    for ax, (run, height) in zip(panels, chosen, strict=False):
        _draw_section(ax, body, run, height, pose)
        note(ax, _sizes(body, errors, run, pose, unit))
    for ax in panels[len(chosen) :]:
        ax.set_axis_off()
    figure.supxlabel(pose.labels(unit)[0], fontsize=9, color=INK)
    figure.supylabel(pose.labels(unit)[1], fontsize=9, color=INK)
    figure.legend(handles=_legend(body), loc="upper center", ncols=4, frameon=False, fontsize=9)
    return figure


def _chosen(breaks: Floats) -> list[tuple[int, float]]:
    """Run and height of every panel, rising."""
    lengths = np.diff(breaks)
    runs = np.unique(np.linspace(0, len(lengths) - 1, MOST_PANELS).round().astype(int))
    count = np.zeros(len(lengths), dtype=int)
    count[runs] = 1
    while count.sum() % COLUMNS:
        count[np.argmax(lengths / np.maximum(count, 1))] += 1
    return [
        (j, float(breaks[j] + lengths[j] * (i + 0.5) / count[j]))
        for j in np.flatnonzero(count).tolist()
        for i in range(count[j])
    ]


def _draw_section(ax: Axes, body: ExactBody, index: int, height: float, pose: Pose) -> None:
    stack = body.model.stack
    run, (low, high) = stack.runs[index], stack.breaks[[index, index + 1]].tolist()
    flat, half = nearby(body.points, run, height, low, high)
    points = pose.in_plan(flat)
    paths = [pose.in_plan(section_path(wall, height)) for wall in run.walls]
    ax.scatter(points[:, 0], points[:, 1], s=3, c=CLOUD, alpha=0.6, linewidths=0, rasterized=True, zorder=2)
    for i, path in enumerate(paths):
        ax.plot(*path.T, color=INK if run.sign(i) > 0 else SURFACE, linewidth=1.4, zorder=3)
    fit_panel(ax, np.concatenate(paths), BELOW)
    style_axes(ax)
    ax.tick_params(labelsize=7)
    ax.locator_params(nbins=3)
    at = place(float(pose.height(np.array(height))), float(np.ptp(pose.height(stack.breaks))))
    title = textwrap.shorten(f"run {index + 1}: {run_words(run)}", TITLE, placeholder=" …")
    heading(
        ax, title, f"at {at} ± {number(half * body.scale, 2)}, {counted(_free(body, index), 'parameter')}"
    )


def _free(body: ExactBody, index: int) -> int:
    """Number of parameters of a run's walls, shared ones counted once."""
    return len(np.unique(np.concatenate(body.model.slots[index])))


def _sizes(body: ExactBody, errors: Precision, index: int, pose: Pose, unit: Unit) -> str:
    """Dimensions of the walls of a run, in few lines that break between them."""
    low, high = body.model.stack.breaks[[index, index + 1]].tolist()
    turn, words = turn_of(pose), []
    for i, wall in enumerate(body.model.stack.runs[index].walls):
        spread = spreads(body.model, errors, index, i).tolist()
        parts = [
            f"{one.name} {dimension_value(one, error, body.scale, turn, unit)}".replace(" ", NO_BREAK)
            for one, error in zip(dimensions(wall, low, high), spread, strict=True)
        ]
        words.append(", ".join(parts))
    lines = textwrap.wrap("; ".join(dict.fromkeys(words)), LINE, max_lines=LINES, placeholder=" …")
    return "\n".join(lines)


def _legend(body: ExactBody) -> list[Line2D]:
    points = Line2D([], [], color=CLOUD, marker="o", linestyle="none", markersize=4, label="points near by")
    wall = Line2D([], [], color=INK, linewidth=1.4, label="wall")
    hole = Line2D([], [], color=SURFACE, linewidth=1.4, label="wall of a hole")
    return [points, wall, *([hole] if any(run.holes for run in body.model.stack.runs) else [])]
