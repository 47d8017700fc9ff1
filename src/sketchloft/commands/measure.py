"""`sketchloft measure`: how far a model lies from its goal."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from sketchloft.brep.files import load_mesh
from sketchloft.cloud import Unit
from sketchloft.commands.console import Json, show, show_json
from sketchloft.errors import UsageError
from sketchloft.measurement import Measurement
from sketchloft.measurement import measure as measured

__all__ = ["measure"]

CHORD = 2e-5
"""Largest distance between a surface and its triangles, in diagonals: far below the errors to be seen."""


def measure(
    model: Annotated[Path, Parameter(help="The model: step, iges, brep or stl.")],
    goal: Annotated[Path, Parameter(help="What it should be, in any of these formats.")],
    /,
    *,
    picture: Annotated[
        Path | None, Parameter(name=["--picture", "-p"], help="PNG with the error map and the histogram.")
    ] = None,
    unit: Annotated[Unit, Parameter(help="Unit to measure in.")] = "mm",
    n: Annotated[int, Parameter(name=["--n", "-n"], help="Points on each surface.")] = 20_000,
    seed: Annotated[int, Parameter(help="The same seed gives the same points.")] = 0,
    json: Json = False,
) -> None:
    """Measure a model against its goal."""
    if n < 1:
        raise UsageError(f"n: found {n} points asked for, expected at least 1")
    result = measured(load_mesh(model, CHORD, unit=unit), load_mesh(goal, CHORD, unit=unit), n=n, seed=seed)
    if picture is not None:
        from sketchloft.report.error_map import draw_error_map  # noqa: PLC0415  matplotlib takes a second

        draw_error_map(result, picture, unit=unit, title=f"{model.stem} against {goal.stem}")
    if json:
        show_json({"unit": unit, **result.summary})
        return
    for line in _lines(result, unit):
        show(line)
    if picture is not None:
        show(f"written: {picture}")


def _lines(result: Measurement, unit: Unit) -> list[str]:
    rows = [
        ("model from goal", result.errors, result.errors_in_thousandths),
        ("goal from model", result.back_errors, result.back_errors_in_thousandths),
    ]
    head = f"{'normal distance, + outside':28}{'rms':>10}{'mean':>10}{'p95':>10}{'max':>10}"
    lines = [head]
    for name, length, share in rows:
        lines.append(f"{name + ', ' + unit:28}" + "".join(f"{x:10.4g}" for x in _figures(length)))
        lines.append(f"{'  thousandths of diagonal':28}" + "".join(f"{x:10.3f}" for x in _figures(share)))
    return [*lines, f"volume error {100 * result.volume_error:+.3f} %"]


def _figures(errors: object) -> list[float]:
    return [float(getattr(errors, name)) for name in ("rms", "mean", "p95", "max")]
