"""Picture of the cloud, its surface points and its central axis (paper, figures 3, 5a and 5b)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import heading, legend_below, style_axes
from sketchloft.report.camera import FRONT
from sketchloft.report.palette import CLOUD, INK, SURFACE
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.thinning import thinned
from sketchloft.report.view3d import draw_lines, draw_points
from sketchloft.report.views import finish_views

__all__ = ["cloud_figure"]

MOST = 12_000
"""Points that are drawn; an even sample stands for more."""
SLAB = 0.08
"""Thickness of the slab through the central axis, as a share of the body's width."""
BEYOND = 0.06
"""How far the central axis is drawn beyond the body, as a share of its height."""


def cloud_figure(result: Reconstruction, body: BodyModel, *, unit: Unit) -> Figure:
    """Draw a body's points, its surface points with the central axis, and a slab cut through both.

    Parameters
    ----------
    result : Reconstruction
    body : BodyModel
        One of its bodies.
    unit : {"mm", "cm", "m", "in"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    pose = pose_of(result, body)
    surface = body.planes.axis_distance.points
    figure = new_figure(11.5, 4.8)
    whole, skin, cut = figure.subplots(1, 3)
    draw_points(whole, pose.in_space(thinned(body.points, MOST)), FRONT, colour=CLOUD, size=1.6, opacity=0.7)
    heading(whole, "Cloud", f"{len(body.points):,} points")
    draw_points(skin, pose.in_space(thinned(surface, MOST)), FRONT, colour=SURFACE, size=1.8, opacity=0.8)
    draw_lines(skin, [pose.in_space(_axis(body))], FRONT, colour=INK, width=1.4, haze=0)
    heading(skin, "Surface points and central axis", f"{len(surface):,} points that a small ball touches")
    finish_views([(whole, FRONT), (skin, FRONT)], unit)
    _draw_slab(cut, body, pose, unit)
    return figure


def _axis(body: BodyModel) -> Floats:
    """(2, 3) ends of the central axis as it is drawn."""
    low, high = body.planes.heights[[0, -1]]
    beyond = BEYOND * (high - low)
    return np.column_stack([np.tile(body.planes.axis_distance.axis, (2, 1)), [low - beyond, high + beyond]])


def _draw_slab(ax: Axes, body: BodyModel, pose: Pose, unit: Unit) -> None:
    """Points near the plane through the central axis in which the body is widest."""
    axis = body.planes.axis_distance.axis
    half = SLAB / 2 * float(np.ptp(body.points[:, 0]))
    for points, colour, size, name in (
        (body.points, CLOUD, 1.8, "cloud"),
        (body.planes.axis_distance.points, SURFACE, 3.0, "surface points"),
    ):
        near = thinned(points[np.abs(points[:, 1] - axis[1]) <= half], MOST)
        right, up = near[:, 0] - axis[0], pose.height(near[:, 2])
        ax.scatter(right, up, s=size**2, c=colour, linewidths=0, label=name, rasterized=True, zorder=2)
    ends = pose.height(_axis(body)[:, 2])
    ax.plot([0, 0], ends, color=INK, linewidth=1.2, label="central axis", zorder=3)
    ax.set_aspect("equal", "datalim")
    style_axes(ax)
    ax.set(xlabel=f"across, from the central axis [{unit}]", ylabel=pose.labels(unit)[2])
    heading(ax, "Slab through the axis", f"{100 * SLAB:g} % of the width thick")
    ax.locator_params(nbins=7)
    legend_below(ax, columns=3)
