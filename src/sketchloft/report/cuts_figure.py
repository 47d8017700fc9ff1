"""Picture of the cloud with its stray points, and of two slabs through it with the model's outline."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from sketchloft.cloud import Floats, Unit
from sketchloft.exact.body import ExactBody
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axes_style import heading, style_axes
from sketchloft.report.camera import FRONT
from sketchloft.report.distance_outside import distance_outside
from sketchloft.report.palette import CLOUD, INK, KEY, SURFACE
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import Pose, pose_of
from sketchloft.report.thinning import thinned
from sketchloft.report.view3d import draw_points
from sketchloft.report.views import finish_views
from sketchloft.report.words import axis_name, counted

__all__ = ["cuts_figure", "likely_strays"]

MOST = 12_000
"""Points that are drawn; an even sample stands for more."""
SLAB = 0.05
"""Thickness of a slab, as a share of the cloud's size."""
CELLS = 220
"""Cells across the picture of a cut through the model."""
MARGIN = 0.04


def cuts_figure(result: Reconstruction, body: ExactBody, *, unit: Unit) -> Figure:
    """Draw a body's points, and two slabs along the slicing direction with the cut through the model.

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
    pose, points = pose_of(result, body), thinned(body.points, MOST)
    stray = likely_strays(points, body.model)
    figure = new_figure(11.5, 4.8)
    cloud, *cuts = figure.subplots(1, 3)
    draw_points(cloud, pose.in_space(points[~stray]), FRONT, colour=CLOUD, size=1.6, opacity=0.7)
    draw_points(cloud, pose.in_space(points[stray]), FRONT, colour=SURFACE, size=2.6, haze=0)
    shown = "" if len(points) == len(body.points) else f", {len(points):,} shown"
    heading(cloud, "Cloud", counted(len(body.points), "point") + shown)
    finish_views([(cloud, FRONT)], unit)
    for ax, across, name in zip(cuts, (0, 1), ("Slab through it", "Slab across that"), strict=True):
        _draw_cut(ax, body, pose, stray_points=points[stray], across=across)
        style_axes(ax, grid=False)
        ax.set_xlabel(f"across, from the middle [{unit}]")
        ax.locator_params(nbins=7)
        heading(ax, name, f"{100 * SLAB:g} % of the size thick, and the cut through the model")
    cuts[0].set_ylabel(f"{axis_name(pose.frame.direction) or 'height'} [{unit}]")
    _legend(figure, cuts)
    return figure


def _legend(figure: Figure, cuts: list[Axes]) -> None:
    """Name everything that is in either cut."""
    named = {
        label: handle for ax in cuts for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    figure.legend(
        handles=list(named.values()),
        loc="outside lower center",
        ncols=4,
        frameon=False,
        fontsize=8,
        markerscale=2,
    )


def likely_strays(points: Floats, model: ExactModel) -> NDArray[np.bool_]:
    """(n,) whether points (n, 3) are more likely to be strays than to belong to the thing."""
    from scipy.special import ndtr  # noqa: PLC0415

    inside = ndtr(-distance_outside(points, model.stack) / model.sigma)
    return np.asarray(model.density.at(points) * inside < model.stray)


def _draw_cut(ax: Axes, body: ExactBody, pose: Pose, *, stray_points: Floats, across: int) -> None:
    """Points near the middle plane that holds an axis across the body and the slicing direction."""
    middle = np.quantile(body.points, [0.01, 0.99], axis=0).mean(axis=0)
    low, high = np.quantile(body.points, [0.002, 0.998], axis=0)[:, [across, 2]]
    low, high = low - MARGIN * (high - low).max(), high + MARGIN * (high - low).max()

    def near(points: Floats) -> Floats:
        """Place across and height of the points in the slab, in the unit of the cloud."""
        flat = points[:, [across, 2]]
        held = np.abs(points[:, 1 - across] - middle[1 - across]) < SLAB / 2
        kept = flat[held & (flat > low).all(axis=1) & (flat < high).all(axis=1)]
        return np.column_stack([body.scale * (kept[:, 0] - middle[across]), pose.height(kept[:, 1])])

    for points, colour, size, name in (
        (thinned(near(body.points), MOST), CLOUD, 2.6, "points"),
        (near(stray_points), SURFACE, 7.0, "probably strays"),
    ):
        if not len(points) and colour == SURFACE:
            continue
        ax.scatter(
            points[:, 0], points[:, 1], s=size, c=colour, linewidths=0, label=name, rasterized=True, zorder=2
        )
    right, up = np.linspace(low[0], high[0], CELLS), np.linspace(low[1], high[1], CELLS)
    cells = np.full((CELLS, CELLS, 3), middle)
    cells[..., across], cells[..., 2] = right, up[:, None]
    outside = distance_outside(cells.reshape(-1, 3), body.model.stack).reshape(CELLS, CELLS)
    place = body.scale * (right - middle[across]), pose.height(up)
    ax.contour(*place, outside, levels=[0.0], colors=INK, linewidths=1.2, zorder=3)
    ax.plot([], [], color=INK, linewidth=1.2, label="model")
    breaks = pose.height(body.model.stack.breaks)
    ax.hlines(breaks, 0, 1, KEY, linewidth=0.8, transform=ax.get_yaxis_transform(), zorder=1, label="breaks")
    ax.set(xlim=place[0][[0, -1]], ylim=place[1][[0, -1]], aspect="equal", anchor="N")
