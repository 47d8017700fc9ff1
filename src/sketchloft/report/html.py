"""Report: one HTML file that tells how a model came about, and how far it is to be trusted."""

from __future__ import annotations

import os
from dataclasses import asdict, fields
from pathlib import Path

import numpy as np

from sketchloft import __version__
from sketchloft.cloud import Unit
from sketchloft.measure import ErrorFigures, Measurement
from sketchloft.output import write_all
from sketchloft.pipeline import Reconstruction
from sketchloft.report.body_story import body_story
from sketchloft.report.camera import BEHIND, FRONT
from sketchloft.report.error_map import error_map_figure
from sketchloft.report.markup import figures, paragraph, picture, section, table
from sketchloft.report.page import page
from sketchloft.report.verdict import trust, verdict
from sketchloft.report.words import counted, number, place

__all__ = ["write_report"]


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
    write_all({Path(path): report(reconstruction, unit, measurement).encode("utf-8")})


def report(result: Reconstruction, unit: Unit, measurement: Measurement | None) -> str:
    """Text of the report."""
    bodies = result.bodies
    contents = {"trust": "How far to trust it", "input": "Input", "bodies": "Bodies"}
    content = [
        verdict(result, unit, measurement),
        trust(result, unit),
        _input(result, unit),
        _bodies(result, unit),
    ]
    for i, body in enumerate(bodies):
        anchor = f"body-{i + 1}"
        contents[anchor] = "Stages" if len(bodies) == 1 else f"{i + 1}: {body.name}"
        title = "From cloud to solid, stage by stage" if len(bodies) == 1 else f"Body {i + 1}: {body.name}"
        content.append(section(title, *body_story(result, body, unit, level=3), anchor=anchor))
    if measurement is not None:
        contents["goal"] = "Measured against the goal"
        content.append(_measured(measurement, unit))
    contents["parameters"] = "Parameters"
    content.append(_parameters(result))
    foot = (
        f"Made by sketchloft {__version__}. Lengths in {unit}; slices are counted from 0 along the slicing "
        "direction."
    )
    return page(_title(result), content, contents, foot)


def _title(result: Reconstruction) -> str:
    first = result.bodies[0].name
    return (
        first
        if len(result.bodies) == 1
        else f"{first} and {counted(len(result.bodies) - 1, 'more body', 'more bodies')}"
    )


def _input(result: Reconstruction, unit: Unit) -> str:
    cloud = result.cloud
    counts = {
        "read": cloud.n_read,
        "not finite, left out": cloud.n_not_finite,
        "repeated, left out": cloud.n_repeated,
        "used": len(cloud),
    }
    centre = ", ".join(place(float(c), cloud.size) for c in cloud.centre)
    return section(
        "Input",
        paragraph(
            f"The points lie around ({centre}); the box that holds them has a diagonal of {number(cloud.size)} {unit}."
        ),
        figures({name: (f"{count:,}", "points") for name, count in counts.items()}),
        anchor="input",
    )


def _bodies(result: Reconstruction, unit: Unit) -> str:
    bodies = result.bodies
    if result.params.bodies.bodies != "auto":
        how = f"{counted(len(bodies), 'body was', 'bodies were')} asked for."
    elif len(bodies) == 1:
        how = "No gap runs through the cloud, so it was taken for one body."
    else:
        how = f"Gaps run through the cloud, so it was taken for {len(bodies)} bodies."
    rows = [
        [
            body.name,
            f"{len(body.points):,}",
            *(f"{place(float(a), s)} to {place(float(b), s)}" for a, b in body.facts.bounds.T),
        ]
        for body in bodies
        for s in [float(np.ptp(body.facts.bounds, axis=0).max())]
    ]
    return section(
        "Bodies",
        paragraph(how),
        table(
            ["body", "points", *(f"{axis} [{unit}]" for axis in "xyz")],
            rows,
            caption="Bodies, the one with the most points first, and where their solids lie.",
            numbers=[1, 2, 3, 4],
        ),
        anchor="bodies",
    )


def _measured(measured: Measurement, unit: Unit) -> str:
    rows = [
        ["model from goal", *_errors(measured.errors, measured.errors_in_thousandths)],
        ["goal from model", *_errors(measured.back_errors, measured.back_errors_in_thousandths)],
    ]
    names = [field.name for field in fields(ErrorFigures)]
    excess = f"{number(abs(100 * measured.volume_error), 3)} % {'larger' if measured.volume_error > 0 else 'smaller'}"
    return section(
        "Measured against the goal",
        paragraph(
            f"Normal distance of {len(measured.distances):,} points spread evenly over the model from the goal's "
            f"surface, positive outside, and the other way round. The model's volume is {excess} than the goal's."
        ),
        table(
            ["distance", *(f"{name} [{unit}]" for name in names), *(f"{name} [‰]" for name in names)],
            rows,
            caption="Errors; ‰ of the goal's diagonal.",
            numbers=list(range(1, 9)),
        ),
        picture(
            error_map_figure(measured, unit=unit, title="", cameras=(FRONT, BEHIND)),
            "The model coloured by its distance from the goal, and the histogram of the distance",
            "Blue where the model lies inside the goal, red where it lies outside.",
        ),
        anchor="goal",
    )


def _errors(lengths: ErrorFigures, shares: ErrorFigures) -> list[str]:
    return [number(value, 3) for one in (lengths, shares) for value in asdict(one).values()]


def _parameters(result: Reconstruction) -> str:
    rows = [
        [stage.replace("_", " "), name.replace("_", " "), _value(value)]
        for stage, values in asdict(result.params).items()
        for name, value in values.items()
    ]
    return section(
        "Parameters",
        paragraph("With these, the same cloud gives the same model again."),
        table(["stage", "parameter", "value"], rows, caption="Parameters of all stages.", numbers=[]),
        anchor="parameters",
    )


def _value(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)
