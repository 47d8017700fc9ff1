"""`sketchloft compare`: slice-and-loft beside the 3D alpha shape and the octree boundary."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from sketchloft.cloud import Unit
from sketchloft.commands.console import Json, Quiet, Verbose, progress, show, show_json
from sketchloft.compare import METHODS, Row, parse_radii, slice_and_loft
from sketchloft.compare import compare as compared
from sketchloft.direction import DirectionParams, parse_axis
from sketchloft.io import read_cloud
from sketchloft.output import check_writable
from sketchloft.pipeline import Params

__all__ = ["compare"]

CHORD = 2e-5
"""Largest distance between the goal and its triangles, in diagonals: far below the errors to be seen."""
COLUMNS = "method probe rms mean max missed volume faces closed seconds"


def compare(
    cloud: Annotated[Path, Parameter(help="Cloud of points.")],
    /,
    *,
    goal: Annotated[Path | None, Parameter(help="What it should be: step, iges, brep or stl.")] = None,
    radii: Annotated[str, Parameter(help="Probe radii in the unit of the cloud.")] = "0.5,1,inf",
    axis: Annotated[str, Parameter(help="Slicing direction: auto, x, y, z or a vector.")] = "auto",
    picture: Annotated[
        Path | None, Parameter(name=["--picture", "-p"], help="PNG with all models side by side.")
    ] = None,
    unit: Annotated[Unit, Parameter(help="Unit of the cloud.")] = "mm",
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Compare slice-and-loft with the 3D alpha shape and the octree boundary."""
    probes = parse_radii(radii)
    params = Params(direction=DirectionParams(parse_axis(axis)))
    if picture is not None:
        check_writable(picture)
    with progress(("read", *METHODS, "picture"), quiet=quiet, verbose=verbose) as begin:
        begin("read")
        points = read_cloud(cloud, unit=unit)
        mesh = None
        if goal is not None:
            from sketchloft.brep.files import load_mesh  # noqa: PLC0415  the kernel only where it is needed

            mesh = load_mesh(goal, CHORD, unit=unit)
        result = compared(points, probes, slice_and_loft(points, params), goal=mesh, progress=begin)
        if picture is not None:
            from sketchloft.report.comparison import draw_comparison  # noqa: PLC0415  matplotlib: a second

            begin("picture")
            draw_comparison(result, picture, unit=unit, title=cloud.stem)
    if json:
        show_json({"unit": unit, **result.summary})
        return
    table = [tuple(COLUMNS.split()), *map(_cells, result.rows)]
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    for line in table:
        show("  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip())
    for remark in dict.fromkeys(row.remark for row in result.rows if row.remark):
        show(f"* {remark}")
    show(f"rms, mean, max, missed (rms from the goal to the model): normal distances in {unit}")
    if picture is not None:
        show(f"written: {picture}")


def _cells(row: Row) -> tuple[str, ...]:
    errors: tuple[str, ...] = ("-",) * 4
    if row.errors is not None and row.missed is not None:
        errors = tuple(f"{x:.4g}" for x in (row.errors.rms, row.errors.mean, row.errors.max, row.missed.rms))
    return (
        row.method + (" *" if row.remark else ""),
        "-" if row.probe_radius is None else f"{row.probe_radius:g}",
        *errors,
        "-" if row.volume is None else f"{row.volume:.5g}",
        "-" if row.faces is None else str(row.faces),
        "-" if row.surface is None else "yes" if row.surface.closed else "no",
        f"{row.seconds:.2f}",
    )
