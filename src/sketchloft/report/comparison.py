"""Picture of a comparison: a row per method, a column per probe radius (paper, figures 13 and 14)."""

from __future__ import annotations

import math
import os
import textwrap
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sketchloft.cloud import Floats, Unit
from sketchloft.compare import METHODS, Comparison, Method, Row
from sketchloft.mesh import Mesh
from sketchloft.report.camera import FRONT, Camera, project
from sketchloft.report.picture import new_figure, save_figure
from sketchloft.report.view3d import draw_mesh, draw_points

__all__ = ["comparison_figure", "draw_comparison"]

COLOURS: dict[Method, str] = {"slice and loft": "#a3c1e6", "3D alpha shape": "#e6bf97", "octree": "#aecfa9"}
GOAL = "#d6d6da"
POINTS = "#4d5d78"
CREASE, FACETS = 30.0, 5.0
"""Degrees from which an edge is sharp: those of the alpha shape are facets, not samples of a surface."""
CELL = 2.8
"""Width of a picture in inches."""
FLATTEST, TALLEST = 0.5, 1.5
"""Limits of a picture's height, in widths."""
MARGIN, NAME, TITLE, HEADING, CAPTION, LINE = 0.1, 0.35, 0.4, 0.3, 0.5, 0.15
"""Inches around all, for a row's name, for the title, above and below a picture, for a further line."""
PIXELS = 540
"""Resolution of a picture along its longer side."""
INK, PALE = "0.12", "0.45"


@dataclass(frozen=True)
class _Cell:
    """One picture: a mesh, points, or why there is none, and the lines above and below it."""

    heading: str
    figure: str
    detail: str
    shown: Mesh | Floats | str
    colour: str
    crease: float = CREASE


def draw_comparison(
    comparison: Comparison,
    path: str | os.PathLike[str],
    *,
    unit: Unit = "mm",
    title: str = "",
    camera: Camera = FRONT,
) -> None:
    """Write the models of a comparison side by side as PNG.

    Parameters
    ----------
    comparison : Comparison
    path : path-like
        Ends in .png; replaced if it exists.
    unit : {"mm", "cm", "m", "in"}
        Unit of the cloud.
    title : str
        What was compared.
    camera : Camera
        From where all are seen, at one scale.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    save_figure(comparison_figure(comparison, unit=unit, title=title, camera=camera), path)


def comparison_figure(comparison: Comparison, *, unit: Unit, title: str, camera: Camera) -> Figure:
    """Draw what `draw_comparison` writes."""
    bands = _bands(comparison, unit)
    low, high = _frame(comparison, camera)
    tall = CELL * float(np.clip((high - low)[1] / (high - low)[0], FLATTEST, TALLEST))
    columns = max(len(cells) for _, cells in bands)
    above = [HEADING * any(cell.heading for cell in cells) + MARGIN for _, cells in bands]
    below = [CAPTION + LINE * max(cell.detail.count("\n") for cell in cells) for _, cells in bands]
    width = NAME + CELL * columns + 2 * MARGIN
    top = sum(above) + sum(below) + tall * len(bands) + TITLE * bool(title)
    figure = new_figure(width, top)
    figure.set_layout_engine("none")  # all places are known
    if title:
        figure.text(0.5, 1 - MARGIN / top, title, ha="center", va="top", fontsize=13, color=INK)
    y = top - TITLE * bool(title)
    for (name, cells), head, foot in zip(bands, above, below, strict=True):
        y -= head + tall
        middle = (MARGIN + NAME / 2) / width, (y + tall / 2) / top
        figure.text(*middle, name, rotation=90, ha="center", va="center", fontsize=12, color=INK)
        for k, cell in enumerate(cells):
            x = MARGIN + NAME + CELL * (k + (columns - len(cells)) / 2)
            ax = figure.add_axes((x / width, y / top, CELL / width, tall / top))
            _draw(ax, cell, camera, (low, high))
        y -= foot
    return figure


def _bands(comparison: Comparison, unit: Unit) -> list[tuple[str, list[_Cell]]]:
    """What stands in each row of the picture, and its name."""
    models: dict[str, list[_Cell]] = {method: [] for method in METHODS}
    for row, mesh in zip(comparison.rows, comparison.meshes, strict=True):
        models[row.method].append(_model(row, mesh, unit))
    cloud = comparison.cloud
    last = [
        _Cell("cloud", f"{len(cloud):,} points", "", cloud.points + cloud.centre, POINTS),
        *models.pop("octree"),
    ]
    if comparison.goal is not None:
        volume = f"volume {comparison.goal.volume:.4g} {unit}³"
        last.append(_Cell("goal", volume, "", comparison.goal, GOAL))
    return [*models.items(), ("", last)]


def _model(row: Row, mesh: Mesh | None, unit: Unit) -> _Cell:
    heading, colour = _heading(row, unit), COLOURS[row.method]
    if mesh is None:
        return _Cell(heading, "", "", row.remark, colour)
    figure = f"volume {row.volume:.4g} {unit}³"
    if row.errors is not None:
        figure = f"rms {_three(row.errors.rms)} {unit}  ({_three(row.rms_thousandths or 0.0)} ‰)"
    voids = "" if row.voids_inside is None else f",  {row.voids_inside:,} voids inside"
    detail = f"{row.faces:,} faces{voids},  {row.seconds:.2g} s"
    if row.remark and row.probe_radius is not None:  # the octree's remark is too long for a picture
        detail += "\n" + textwrap.fill(row.remark, 42)
    return _Cell(heading, figure, detail, mesh, colour, FACETS if row.method == "3D alpha shape" else CREASE)


def _three(length: float) -> str:
    """Three digits, zeros too, so that figures beside each other are of one length."""
    return f"{length:#.3g}".rstrip(".")


def _heading(row: Row, unit: Unit) -> str:
    """What stands above a picture: the radii above the first row of pictures only."""
    if row.probe_radius is None:
        return row.method
    if row.method != METHODS[0]:
        return ""
    return "probe radius ∞" if math.isinf(row.probe_radius) else f"probe radius {row.probe_radius:g} {unit}"


def _frame(comparison: Comparison, camera: Camera) -> tuple[Floats, Floats]:
    """Lowest and highest corner (2,) of all that is drawn, as the camera sees it, with a margin."""
    meshes = [mesh for mesh in (*comparison.meshes, comparison.goal) if mesh is not None]
    seen = [comparison.cloud.points + comparison.cloud.centre, *(mesh.vertices for mesh in meshes)]
    flat = np.concatenate([project(camera, points)[:, :2] for points in seen])
    low, high = flat.min(axis=0), flat.max(axis=0)
    margin = 0.03 * float((high - low).max())
    return low - margin, high + margin


def _draw(ax: Axes, cell: _Cell, camera: Camera, frame: tuple[Floats, Floats]) -> None:
    if isinstance(cell.shown, Mesh):
        draw_mesh(ax, cell.shown, camera, colour=cell.colour, crease=cell.crease, pixels=PIXELS)
    elif isinstance(cell.shown, str):
        _write(ax, "no model", (0.5, 0.5), lift=16, size=11, colour=INK)
        _write(ax, textwrap.fill(cell.shown, 34), (0.5, 0.5), lift=-4, size=8, colour=PALE)
    else:
        draw_points(ax, cell.shown, camera, colour=cell.colour, size=1.1)
    low, high = frame
    ax.set_axis_off()
    ax.set_aspect("equal")
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    ax.set_title(cell.heading, fontsize=11, color=INK, pad=4)
    _write(ax, cell.figure, (0.5, 0), lift=-3, size=10, colour=INK)
    _write(ax, cell.detail, (0.5, 0), lift=-18, size=8.5, colour=PALE)


def _write(ax: Axes, text: str, at: tuple[float, float], *, lift: float, size: float, colour: str) -> None:
    """Write text below a place in shares of the axes, lifted by typographic points."""
    ax.annotate(
        text,
        at,
        (0, lift),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=size,
        color=colour,
    )
