"""Report: one HTML file that tells how a model came about, and how far it is to be trusted."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

import numpy as np

from sketchloft import __version__
from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.measurement import Measurement
from sketchloft.output import beside
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.body_story import body_story
from sketchloft.report.goal_story import goal_story
from sketchloft.report.markup import figures, paragraph, section, table
from sketchloft.report.page import page
from sketchloft.report.verdict import trust, verdict
from sketchloft.report.words import counted, number, place

__all__ = ["write_report"]

STAGES_OF = {
    "exact": ("bodies", "direction", "exact"),
    "paper": ("bodies", "direction", "slice_planes", "work_points", "edge_points", "shapes", "loft"),
}
"""Stages that have parameters, by method."""


def write_report(
    reconstruction: Reconstruction,
    path: str | os.PathLike[str],
    *,
    unit: Unit,
    measurement: Measurement | None = None,
) -> None:
    """Write the report of a reconstruction.

    Parameters
    ----------
    reconstruction : Reconstruction
    path : path-like
        HTML file, replaced if it exists. It refers to nothing outside itself.
    unit : {"mm", "cm", "m", "in"}
        Unit of the cloud and of the measurement.
    measurement : Measurement, optional
        Of the model against its goal.

    Raises
    ------
    OutputError
        If the file cannot be written.

    Notes
    -----
    The same reconstruction gives the same bytes.
    """
    counted_parts = (
        "runs are counted from 1" if reconstruction.params.method == "exact" else "slices are counted from 0"
    )
    foot = (
        f"Made by sketchloft {__version__}. Lengths in {unit}; {counted_parts} along the slicing direction."
    )
    parts = list(_parts(reconstruction, unit, measurement))
    text = page(
        _title([body.name for body in reconstruction.bodies]),
        verdict(reconstruction, unit, measurement),
        {f"part-{i}": name for i, (name, _) in enumerate(parts)},
        [section(name, *content, anchor=f"part-{i}") for i, (name, content) in enumerate(parts)],
        foot,
    )
    with beside(Path(path)) as files:
        next(files).write_text(text, encoding="utf-8")


def _title(names: list[str]) -> str:
    if len(names) > 3:
        names = [*names[:2], f"{len(names) - 2} more"]
    return ", ".join(names)


def _parts(
    result: Reconstruction, unit: Unit, measurement: Measurement | None
) -> Iterator[tuple[str, list[str]]]:
    """Title and content of every part, in the order of the stages."""
    yield "How far to trust it", trust(result, unit)
    yield "Input", _input(result, unit)
    yield "Bodies", _bodies(result, unit)
    for i, body in enumerate(result.bodies):
        name = "From cloud to solid" if len(result.bodies) == 1 else f"Body {i + 1}: {body.name}"
        yield name, body_story(result, body, unit)
    if measurement is not None:
        yield "Measured against the goal", goal_story(measurement, unit)
    yield "Parameters", _parameters(result)


def _input(result: Reconstruction, unit: Unit) -> list[str]:
    cloud = result.cloud
    counts = {
        "read": cloud.n_read,
        "not finite, left out": cloud.n_not_finite,
        "repeated, left out": cloud.n_repeated,
        "used": len(cloud),
    }
    centre = ", ".join(place(float(c), cloud.size) for c in cloud.centre)
    size = f"{number(cloud.size)} {unit}"
    return [
        paragraph(f"The points lie around ({centre}), in a box with a diagonal of {size}."),
        figures({name: (f"{count:,}", "points") for name, count in counts.items()}),
    ]


def _bodies(result: Reconstruction, unit: Unit) -> list[str]:
    count = len(result.bodies)
    if result.params.bodies.bodies != "auto":
        how = f"{counted(count, 'body was', 'bodies were')} asked for."
    elif count == 1:
        how = "No gap runs through the cloud, so it was taken for one body."
    else:
        how = f"Gaps run through the cloud, so it was taken for {count} bodies."
    return [
        paragraph(how),
        table(
            ["body", "points", *(f"{axis} [{unit}]" for axis in "xyz")],
            [_body_row(body) for body in result.bodies],
            caption="Bodies, the one with the most points first, and where their solids lie.",
            numbers=[1, 2, 3, 4],
        ),
    ]


def _body_row(body: ExactBody | BodyModel) -> list[str]:
    size = float(np.ptp(body.facts.bounds, axis=0).max())
    spans = [f"{place(low, size)} to {place(high, size)}" for low, high in body.facts.bounds.T.tolist()]
    return [body.name, f"{len(body.points):,}", *spans]


def _parameters(result: Reconstruction) -> list[str]:
    params = result.params
    stages = {stage: asdict(getattr(params, stage)) for stage in STAGES_OF[params.method]}
    rows = [["method", "method", params.method], *_parameter_rows(stages)]
    return [
        paragraph("With these, the same cloud gives the same model again."),
        table(["stage", "parameter", "value"], rows, caption="Parameters of all stages.", numbers=[]),
    ]


def _parameter_rows(stages: dict[str, dict[str, object]]) -> Iterator[list[str]]:
    for stage, values in stages.items():
        for name, value in values.items():
            if isinstance(value, dict):
                yield from _parameter_rows({name: value})
            else:
                yield [stage.replace("_", " "), name.replace("_", " "), _value(value)]


def _value(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)
