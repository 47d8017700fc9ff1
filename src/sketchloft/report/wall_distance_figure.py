"""Picture of how the points lie against the walls: a histogram beside what the model expects."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axes_style import heading, style_axes
from sketchloft.report.distance_outside import distance_from_walls, distance_outside
from sketchloft.report.findings import noise_words
from sketchloft.report.palette import CLOUD, INK, KEY, MUTED
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.precision import Precision
from sketchloft.report.thinning import thinned
from sketchloft.report.wall_counts import expected_counts

__all__ = ["wall_distance_figure"]

MOST = 60_000
"""Points that are looked at; an even sample stands for more."""
LEAST_WIDTH = 0.015
"""Least width on either side of the walls that is shown, as a share of the size."""
DEVIATIONS = 6.0
"""Width on either side, in deviations of the noise."""
BINS = 60


def wall_distance_figure(result: Reconstruction, body: ExactBody, errors: Precision, *, unit: Unit) -> Figure:
    """Draw the distances of the points from the walls, counted, and along the slicing direction.

    Parameters
    ----------
    result : Reconstruction
    body : ExactBody
        One of its bodies.
    errors : Precision
        Of the body.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    pose, points, scale = pose_of(result, body), thinned(body.points, MOST), body.scale
    distance = distance_outside(points, body.model.stack)
    width = max(DEVIATIONS * body.model.sigma, LEAST_WIDTH)
    figure = new_figure(11.5, 4.2)
    counts, along = figure.subplots(1, 2, width_ratios=[1, 1.25])
    edges = np.linspace(-width, width, BINS + 1)
    counts.hist(scale * distance, scale * edges, color=CLOUD, alpha=0.55, label="points", zorder=2)
    at, expected = expected_counts(body.model, edges, len(points) / len(body.points))
    counts.plot(scale * at, expected, color=INK, linewidth=1.5, label="expected by the model", zorder=4)
    counts.set(xlabel=f"distance from the walls, outwards [{unit}]", ylabel="points")
    heading(counts, "Points across the walls", f"noise {noise_words(body, errors)} {unit}")
    aside = distance_from_walls(points, body.model.stack)
    near = np.abs(aside) < width
    breaks = pose.height(body.model.stack.breaks)
    _draw_along(along, pose.height(points[near, 2]), scale * aside[near], breaks)
    for deviations in (-2, 2):
        along.axhline(
            deviations * scale * body.model.sigma, color=MUTED, linewidth=0.8, linestyle="--", zorder=3
        )
    along.set(xlabel=pose.labels(unit)[2], ylabel=f"outwards [{unit}]", ylim=(-scale * width, scale * width))
    heading(along, "Along the axis", "points beside walls, without ledges; dashed: twice the noise")
    for ax in (counts, along):
        style_axes(ax, grid=ax is counts)
    counts.axvline(0, color=KEY, linewidth=1.1, label="wall", zorder=3)
    figure.legend(
        handles=counts.get_legend_handles_labels()[0],
        loc="outside lower center",
        ncols=3,
        frameon=False,
        fontsize=8,
    )
    return figure


def _draw_along(ax: Axes, heights: Floats, distance: Floats, breaks: Floats) -> None:
    ax.scatter(heights, distance, s=3, c=CLOUD, alpha=0.6, linewidths=0, rasterized=True, zorder=2)
    ax.axhline(0, color=KEY, linewidth=1.1, zorder=4)
    ax.vlines(breaks, 0, 1, KEY, linewidth=0.8, alpha=0.6, transform=ax.get_xaxis_transform(), zorder=1)
    span = float(np.ptp(breaks))
    ax.set_xlim(breaks[0] - 0.05 * span, breaks[-1] + 0.05 * span)
