"""Error map: the signed normal error as colours on the model, beside its histogram (paper, figure 11)."""

from __future__ import annotations

import os

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure, SubFigure

from sketchloft.cloud import Unit
from sketchloft.measurement import Measurement, vertex_errors
from sketchloft.report.camera import BEHIND, FRONT, Camera
from sketchloft.report.picture import new_figure, save_figure
from sketchloft.report.view3d import draw_mesh

__all__ = ["draw_error_map", "error_map_figure"]

COLOURS = LinearSegmentedColormap.from_list("error", colormaps["RdBu_r"](np.linspace(0.06, 0.94, 255)))
"""Blue inside the goal, white on it, red outside; without the darkest ends, which shadows turn black."""
RANGE_QUANTILE = 0.99
"""Share of the errors, signs left aside, that the colours tell apart; larger ones get the end colours."""
PIXELS = 540
"""Resolution of a view along its longer side."""
BINS = 61
"""An odd number, so that the middle bar is the one about 0."""


def draw_error_map(
    measurement: Measurement,
    path: str | os.PathLike[str],
    *,
    unit: Unit = "mm",
    title: str = "",
    cameras: tuple[Camera, Camera] = (FRONT, BEHIND),
) -> None:
    """Write the error map of a model as PNG.

    Parameters
    ----------
    measurement : Measurement
    path : path-like
        Ends in .png; replaced if it exists.
    unit : {"mm", "cm", "m", "in"}
        Unit of the meshes.
    title : str
        What was measured; the figures stand under it.
    cameras : pair of Camera
        The two sides that are shown.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    save_figure(error_map_figure(measurement, unit=unit, title=title, cameras=cameras), path)


def error_map_figure(
    measurement: Measurement, *, unit: Unit, title: str, cameras: tuple[Camera, Camera]
) -> Figure:
    """Draw what `draw_error_map` writes."""
    figure = new_figure(11.5, 5.0)
    reach = _reach(measurement)
    grid = figure.add_gridspec(1, 2, width_ratios=(1.25, 1))
    left, right = figure.add_subfigure(grid[0]), figure.add_subfigure(grid[1])
    views = [left.add_subplot(1, 2, i) for i in (1, 2)]
    mesh, errors = vertex_errors(measurement)
    for ax, camera in zip(views, cameras, strict=True):
        draw_mesh(ax, mesh, camera, values=errors, cmap=COLOURS, limits=(-reach, reach), pixels=PIXELS)
    _draw_scale(left, views, measurement, reach, unit)
    _draw_histogram(right.subplots(), measurement, reach, unit)
    figure.suptitle(_headline(measurement, unit, title), fontsize=10)
    return figure


def _reach(measurement: Measurement) -> float:
    """Half the width of the colour scale."""
    reach = float(np.quantile(np.abs(measurement.distances), RANGE_QUANTILE))
    return max(reach, 1e-9 * measurement.goal.size)


def _draw_scale(
    figure: SubFigure, views: list[Axes], measured: Measurement, reach: float, unit: Unit
) -> None:
    """Draw the colour scale below the views: the unit below it, thousandths of the diagonal above."""
    beyond = measured.distances.min() < -reach, measured.distances.max() > reach
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[
        beyond
    ]
    bar = figure.colorbar(
        ScalarMappable(Normalize(-reach, reach), COLOURS),
        ax=views,
        location="bottom",
        extend=extend,
        aspect=40,
        shrink=0.85,
        pad=0.02,
    )
    bar.set_label(f"←  inside the goal      normal distance [{unit}]      outside  →")
    bar.ax.locator_params(axis="x", nbins=6)
    bar.outline.set_visible(False)
    above = bar.ax.secondary_xaxis(
        "top",
        functions=(
            lambda d: np.asarray(d) / measured.thousandth,
            lambda d: np.asarray(d) * measured.thousandth,
        ),
    )
    above.set_xlabel("thousandths of the goal's diagonal", fontsize=8)
    above.tick_params(labelsize=8)


def _draw_histogram(ax: Axes, measured: Measurement, reach: float, unit: Unit) -> None:
    """Share of the model's area per bar, in the colours of the map; the outermost bars hold the rest."""
    edges = np.linspace(-reach, reach, BINS + 1)
    counts, _ = np.histogram(np.clip(measured.distances, -reach, reach), edges)
    middles = (edges[:-1] + edges[1:]) / 2
    paint = COLOURS(0.5 + middles / (2 * reach))
    share = 100 * counts / len(measured.distances)
    ax.bar(middles, share, np.diff(edges), color=paint, edgecolor="0.35", linewidth=0.4, zorder=2)
    ax.axvline(0, color="0.25", linewidth=0.8, zorder=3)
    mean = measured.errors.mean
    ax.axvline(
        mean, color="0.25", linewidth=1.0, linestyle=(0, (4, 3)), zorder=3, label=f"mean {mean:+.2g} {unit}"
    )
    ax.set_xlim(-1.03 * reach, 1.03 * reach)
    ax.locator_params(axis="x", nbins=6)
    ax.set_xlabel(f"normal distance [{unit}]")
    ax.set_ylabel("share of the model's surface [%]")
    ax.grid(axis="y", color="0.9", zorder=0)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(frameon=False, fontsize=8)


def _headline(measured: Measurement, unit: Unit, title: str) -> str:
    figures, shares = measured.errors, measured.errors_in_thousandths
    parts = [
        f"{name} {getattr(figures, name):.3g} {unit} ({getattr(shares, name):.3g} ‰)"
        for name in ("rms", "mean", "p95", "max")
    ]
    lines = [title] * bool(title) + ["    ".join(parts) + f"    volume {100 * measured.volume_error:+.2g} %"]
    return "\n".join(lines)
