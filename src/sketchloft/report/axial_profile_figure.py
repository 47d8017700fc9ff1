"""Picture of the profile along the axis: what the points and the model say of the size of the section."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axes_style import style_axes
from sketchloft.report.axial_counts import axial_counts
from sketchloft.report.palette import CLOUD, INK, KEY, MUTED
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.run_words import break_words, run_words
from sketchloft.report.spaced import spaced
from sketchloft.report.wall_colour import wall_colour
from sketchloft.report.words import place
from sketchloft.stack import Run

__all__ = ["axial_profile_figure"]

ALONG = np.linspace(0.0, 1.0, 129)
APART = 0.022
"""Least distance of the labels of breaks, as a share of the width."""
LETTER = 0.0066
"""Width of a letter of a run's name, as a share of the width."""
MOST_BEYOND = 2.0
"""How far a model that is larger than the points is shown, in their size."""
NARROW = 0.016
"""Width below which a run has no room for its name, not even upright."""


def axial_profile_figure(result: Reconstruction, body: ExactBody, *, unit: Unit) -> Figure:
    """Draw the size of the section against height, as the points and the model have it, and the breaks.

    Parameters
    ----------
    result : Reconstruction
    body : ExactBody
        One of its bodies.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    pose, stack, scale = pose_of(result, body), body.model.stack, body.scale
    figure = new_figure(11.5, 5.2)
    ax = figure.subplots()
    largest = 0.0
    for run, low, high in stack.slabs():
        z = low + (high - low) * ALONG
        up, radius = pose.height(z), scale * _equivalent_radius(run.area(z))
        ax.fill_between(up, radius, color=wall_colour(run.walls[0]), alpha=0.55, linewidth=0, zorder=1)
        ax.plot(up, radius, color=INK, linewidth=1.5, zorder=4, label="" if largest else "model")
        largest = max(largest, float(radius.max()))
    counts = axial_counts(body)
    radius = scale * _equivalent_radius(counts.areas)
    error = radius * np.divide(0.5 * counts.errors, counts.areas, out=0 * radius, where=counts.areas > 0)
    ax.errorbar(
        pose.height(counts.heights), radius, error, fmt="o", color=CLOUD, markersize=3.2, elinewidth=0.7,
        label="points, with the scatter that chance gives them", zorder=5,
    )  # fmt: skip
    breaks = pose.height(stack.breaks)
    ax.vlines(breaks, 0, 1, KEY, linewidth=1.1, transform=ax.get_xaxis_transform(), zorder=3, label="breaks")
    span = float(np.ptp(breaks))
    ax.set_xlim(breaks[0] - 0.05 * span, breaks[-1] + 0.05 * span)
    seen = float(np.quantile(radius, 0.98))
    ax.set_ylim(0, 1.12 * max(seen, min(largest, MOST_BEYOND * seen)))
    style_axes(ax, grid=False)
    ax.set(xlabel=pose.labels(unit)[2], ylabel=f"radius of a circle of the section's area [{unit}]")
    _name_breaks(ax, body, breaks)
    _name_runs(ax, stack.runs, breaks)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return figure


def _equivalent_radius(areas: Floats) -> Floats:
    return np.asarray(np.sqrt(np.maximum(areas, 0.0) / np.pi))


def _name_breaks(ax: Axes, body: ExactBody, breaks: Floats) -> None:
    """Height and kind of every break above the panel, upright, moved apart where they are close."""
    low, high = ax.get_xlim()
    at = spaced((breaks - low) / (high - low), APART)
    for k, (here, there) in enumerate(zip(breaks.tolist(), at.tolist(), strict=True)):
        ax.annotate(
            f"{place(here, float(np.ptp(breaks)))}  {break_words(body.model, k)}",
            (here, 1),
            (there, 1.05),
            xycoords=ax.get_xaxis_transform(),
            textcoords="axes fraction",
            rotation=90,
            ha="center",
            va="bottom",
            fontsize=8,
            color=INK,
            arrowprops={"arrowstyle": "-", "color": KEY, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0},
            annotation_clip=False,
        )


def _name_runs(ax: Axes, runs: tuple[Run, ...], breaks: Floats) -> None:
    """Number and kind of every run at the bottom of the panel, upright where it is narrow."""
    low, high = ax.get_xlim()
    for j, run in enumerate(runs):
        words, room = f"{j + 1}: {run_words(run)}", float(breaks[j + 1] - breaks[j]) / (high - low)
        upright = len(words) * LETTER > room
        ax.annotate(
            words if room > NARROW else str(j + 1),
            (float(breaks[j] + breaks[j + 1]) / 2, 0.025),
            xycoords=ax.get_xaxis_transform(),
            rotation=90 if upright and room > NARROW else 0,
            ha="center",
            va="bottom",
            fontsize=8,
            color=INK if room > NARROW else MUTED,
            bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 1.5},
            zorder=6,
        )
