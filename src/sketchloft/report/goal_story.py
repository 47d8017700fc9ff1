"""Story of the measurement: how far the model lies from its goal (paper, section 5.1)."""

from __future__ import annotations

from dataclasses import asdict, fields

from sketchloft.cloud import Unit
from sketchloft.measurement import ErrorFigures, Measurement
from sketchloft.report.camera import BEHIND, FRONT
from sketchloft.report.error_map import error_map_figure
from sketchloft.report.markup import paragraph, picture, table
from sketchloft.report.words import number

__all__ = ["goal_story"]


def goal_story(measured: Measurement, unit: Unit) -> list[str]:
    """Words, table and error map of a measurement."""
    names = [field.name for field in fields(ErrorFigures)]
    change = "larger" if measured.volume_error > 0 else "smaller"
    return [
        paragraph(
            f"Normal distance of {len(measured.distances):,} points, spread evenly over the model, from the "
            "goal's surface, positive outside, and the other way round. The model's volume is "
            f"{number(abs(100 * measured.volume_error), 3)} % {change} than the goal's."
        ),
        table(
            ["distance", *(f"{name} [{unit}]" for name in names), *(f"{name} [‰]" for name in names)],
            [
                ["model from goal", *_figures(measured.errors, measured.errors_in_thousandths)],
                ["goal from model", *_figures(measured.back_errors, measured.back_errors_in_thousandths)],
            ],
            caption="Errors, also in ‰ of the goal's diagonal. 95 % of the distances are no larger than p95.",
            numbers=list(range(1, 9)),
        ),
        picture(
            error_map_figure(measured, unit=unit, title="", cameras=(FRONT, BEHIND)),
            "The model coloured by its distance from the goal, and the histogram of the distance",
            "Error map and histogram: blue where the model lies inside the goal, red where it lies outside.",
        ),
    ]


def _figures(lengths: ErrorFigures, shares: ErrorFigures) -> list[str]:
    return [number(value, 3) for one in (lengths, shares) for value in asdict(one).values()]
