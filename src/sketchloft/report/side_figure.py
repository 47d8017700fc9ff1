"""Side views of the slice planes, the worked points and the edge points (paper, figures 7 and 8)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import heading, legend_below, style_axes
from sketchloft.report.camera import FRONT
from sketchloft.report.palette import CLOUD, EDGE, KEY, PLANE
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.thinning import thinned
from sketchloft.report.view3d import draw_points
from sketchloft.report.views import finish_views

__all__ = ["side_figure"]

MOST = 12_000
"""Points of a kind that are drawn; an even sample stands for more."""


def side_figure(result: Reconstruction, body: BodyModel, *, unit: Unit) -> Figure:
    """Draw the cloud with its slice planes, the worked points with the edge points, and these alone.

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
    worked = _stacked([w.points for w in body.worked], body.planes.heights)
    edges = _stacked([e.points for e in body.edges], body.planes.heights)
    figure = new_figure(11.5, 4.8)
    planes, side, space = figure.subplots(1, 3)
    _draw_side(planes, pose, body.points, CLOUD, "cloud")
    _draw_planes(planes, body, pose)
    heading(planes, "Slice planes", f"{len(body.planes.heights)} planes across the slicing direction")
    _draw_side(side, pose, worked, CLOUD, "worked points")
    _draw_side(side, pose, edges, EDGE, "edge points")
    heading(
        side, "Worked points and edge points", f"{len(worked):,} points moved onto {len(body.worked)} planes"
    )
    side.dataLim = planes.dataLim
    for ax in (planes, side):
        ax.set_aspect("equal", "datalim")
        style_axes(ax, grid=False)
        ax.set_xlabel(pose.labels(unit)[0])
        ax.locator_params(nbins=7)
        legend_below(ax, columns=3)
    planes.set_ylabel(pose.labels(unit)[2])
    draw_points(space, pose.in_space(thinned(edges, MOST)), FRONT, colour=EDGE, size=2.0)
    finish_views([(space, FRONT)], unit)
    heading(space, "Edge points alone", f"{len(edges):,} points that stand for the surface")
    return figure


def _stacked(parts: list[Floats], heights: Floats) -> Floats:
    """(n, 3) points of all slices, each on its plane."""
    rise = np.repeat(heights, [len(part) for part in parts])
    return np.column_stack([np.concatenate(parts), rise])


def _draw_side(ax: Axes, pose: Pose, points: Floats, colour: str, name: str) -> None:
    shown = thinned(points, MOST)
    right, up = pose.in_plan(shown[:, :2])[:, 0], pose.height(shown[:, 2])
    size = 5.0 if colour == EDGE else 2.0
    ax.scatter(right, up, s=size, c=colour, linewidths=0, rasterized=True, label=name, zorder=2)


def _draw_planes(ax: Axes, body: BodyModel, pose: Pose) -> None:
    right = pose.in_plan(body.points[:, :2])[:, 0]
    low, high = float(right.min()), float(right.max())
    reach = (low - 0.05 * (high - low), high + 0.05 * (high - low))
    keys = np.isin(body.planes.heights, body.planes.key_heights)
    heights = pose.height(body.planes.heights)
    for chosen, colour, name in ((~keys, PLANE, "slice plane"), (keys, KEY, "at a key height")):
        ax.hlines(heights[chosen], *reach, colour, linewidth=0.9, label=name, zorder=3)
