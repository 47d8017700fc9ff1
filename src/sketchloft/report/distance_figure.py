"""Picture of the distance to the central axis, which locates the slice planes (paper, figures 5c, 6, 7a)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.axes_style import style_axes
from sketchloft.report.palette import INK, KEY, MUTED, PLANE, SURFACE
from sketchloft.report.picture import new_figure
from sketchloft.report.pose import pose_of
from sketchloft.report.thinning import thinned

__all__ = ["distance_figure"]

MOST = 12_000
"""Surface points that are drawn; an even sample stands for more."""
NUMBERS = 30
"""How many slices along the top can be numbered."""


def distance_figure(result: Reconstruction, body: BodyModel, *, unit: Unit) -> Figure:
    """Draw the distance of surface points to the central axis along it, with the planes it gave.

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
    pose, found = pose_of(result, body), body.planes.axis_distance
    planes, keys = pose.height(body.planes.heights), pose.height(body.planes.key_heights)
    heights, distance = pose.height(found.points[:, 2]), found.distance
    figure = new_figure(11.5, 4.2)
    ax = figure.subplots()
    ax.scatter(
        thinned(heights, MOST),
        thinned(distance, MOST),
        s=3,
        c=SURFACE,
        alpha=0.35,
        linewidths=0,
        rasterized=True,
        label="surface points",
        zorder=2,
    )
    ax.vlines(
        planes, 0, 1, PLANE, linewidth=0.7, transform=ax.get_xaxis_transform(), label="slice planes", zorder=1
    )
    at = pose.height(found.heights)
    ax.plot(at, found.profile, color=INK, linewidth=1.5, label="reach of the section", zorder=4)
    inner = keys[1:-1]
    ax.plot(
        inner,
        np.interp(inner, at, found.profile),
        linestyle="none",
        marker="o",
        markersize=6,
        color=KEY,
        markeredgecolor="white",
        label="extrema, steps and ends",
        zorder=5,
    )
    ax.vlines(keys, 0, 1, KEY, linewidth=1.2, transform=ax.get_xaxis_transform(), zorder=3)
    ax.set_ylim(0, 1.06 * float(distance.max()))
    style_axes(ax, grid=False)
    ax.set(xlabel=pose.labels(unit)[2], ylabel=f"distance to the central axis [{unit}]")
    _number_slices(ax, planes)
    counts = f"{len(planes)} slice planes, {len(keys)} of them at key heights"
    figure.suptitle(counts, fontsize=10, color=INK)
    figure.legend(loc="outside lower center", ncols=4, frameon=False, fontsize=8, markerscale=1.6)
    return figure


def _number_slices(ax: Axes, planes: Floats) -> None:
    """Number the slices along the top, as many as have room."""
    least = float(np.ptp(planes)) / NUMBERS
    numbered = [0]
    for i in range(1, len(planes) - 1):
        if planes[i] - planes[numbered[-1]] >= least:
            numbered.append(i)
    if planes[-1] - planes[numbered[-1]] < least:
        numbered.pop()
    numbered.append(len(planes) - 1)
    top = ax.secondary_xaxis("top")
    top.set_xticks(planes[numbered], [str(i) for i in numbered])
    top.tick_params(colors=MUTED, labelsize=7, length=2)
    top.set_xlabel("slice", fontsize=8, color=MUTED)
    top.spines["top"].set_visible(False)
