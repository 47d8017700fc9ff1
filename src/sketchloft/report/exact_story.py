"""Story of a body of exact walls: what was found in its cloud, in pictures, tables and plain words."""

from __future__ import annotations

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import Reconstruction
from sketchloft.report.axial_profile_figure import axial_profile_figure
from sketchloft.report.cuts_figure import cuts_figure
from sketchloft.report.exact_directions import exact_directions
from sketchloft.report.findings import density_words, noise_words, stray_words
from sketchloft.report.kinds_figure import kinds_figure
from sketchloft.report.markup import figures, paragraph, picture, section
from sketchloft.report.precision import Precision, precision
from sketchloft.report.run_tables import breaks_table, dimensions_table
from sketchloft.report.runs_figure import runs_figure
from sketchloft.report.wall_distance_figure import wall_distance_figure
from sketchloft.report.words import counted, number

__all__ = ["exact_story"]


def exact_story(result: Reconstruction, body: ExactBody, unit: Unit) -> list[str]:
    """Sections of the report about one body, from its cloud to its solid."""
    errors = precision(body)
    return [
        section("Slicing direction", *exact_directions(body), level=3),
        section("Cloud", *_cloud(result, body, errors, unit), level=3),
        section("Profile along the axis", *_profile(result, body, errors, unit), level=3),
        section("Sections of the runs", *_runs(result, body, errors, unit), level=3),
        section("Solid", *_solid(result, body, unit), level=3),
        section("Points against the walls", *_walls(result, body, errors, unit), level=3),
    ]


def _cloud(result: Reconstruction, body: ExactBody, errors: Precision, unit: Unit) -> list[str]:
    found = {
        "noise": (
            f"{noise_words(body, errors)} {unit}",
            "standard deviation of a point's place across a wall",
        ),
        "strays": (stray_words(body), "points that belong to nothing"),
        "density": (density_words(body, unit), "inside"),
    }
    return [
        figures(found),
        picture(
            cuts_figure(result, body, unit=unit),
            "Three panels: the points in space, and two slabs through them with the outline of the model",
            "The points, and two thin slabs through them along the slicing direction, one across the other. "
            "Black: where the slab's middle plane cuts the model; blue: points that are more likely strays.",
        ),
    ]


def _profile(result: Reconstruction, body: ExactBody, errors: Precision, unit: Unit) -> list[str]:
    runs = len(body.model.stack.runs)
    between = "It has no break between its ends." if runs == 1 else f"Breaks divide it into {runs} runs."
    return [
        paragraph(
            "How many points lie at a height tells the area of the section there. Between two breaks the "
            f"section stays or changes smoothly; each such run got walls of its own. {between}"
        ),
        picture(
            axial_profile_figure(result, body, unit=unit),
            "Size of the section against height, of the points and of the model, with breaks and runs",
            "Size of the section along the axis, as the radius of a circle of its area. Dots: from the "
            "number of points; line: the model. Close to a step the noise carries points across. Orange: "
            "breaks, with their height and kind. The colour under the line is that of the run's faces in the "
            "picture of the solid.",
        ),
        breaks_table(result, body, errors, unit),
    ]


def _runs(result: Reconstruction, body: ExactBody, errors: Precision, unit: Unit) -> list[str]:
    model = body.model
    together = (
        f" The points go together in groups of about {number(errors.together, 2)}, as those of strokes do, "
        "and each group was counted as one point."
        if errors.together > 1
        else ""
    )
    return [
        paragraph(
            "Which kind of wall a run has was decided by evidence: a kind with more parameters was taken "
            "only where the likelihood of the points rose by more than chance would make it. All walls and "
            f"breaks, with {counted(model.parameters, 'parameter')}, were then fitted together to all points."
        ),
        picture(
            runs_figure(result, body, errors, unit=unit),
            "Panels with the points near a height of each run and the outline of the walls there",
            "Sections of the runs, each at its own scale, seen against the slicing direction. The points of "
            "a thin slab are moved along the walls to its middle.",
        ),
        paragraph(
            "The error beside each dimension is a standard error: what chance leaves open with as many "
            f"points, this noise and these kinds of walls.{together}"
        ),
        dimensions_table(result, body, errors, unit),
    ]


def _solid(result: Reconstruction, body: ExactBody, unit: Unit) -> list[str]:
    return [
        paragraph(
            "Each wall became the surface that it is, neighbouring runs were joined, and flat ends and steps "
            "were closed by plane faces."
        ),
        picture(
            kinds_figure(result, body, unit=unit),
            "The solid from the front and from behind, its faces coloured by kind of surface",
            "The solid, its faces coloured by kind of surface.",
        ),
    ]


def _walls(result: Reconstruction, body: ExactBody, errors: Precision, unit: Unit) -> list[str]:
    return [
        paragraph(
            "If the model is right, the points thin out across its walls just as the noise makes them: where "
            "the bars follow the line there is nothing left to explain. Bars beyond the line outside, or a "
            "gap inside, at some height only, show a wall that is not where the points are."
        ),
        picture(
            wall_distance_figure(result, body, errors, unit=unit),
            "Histogram of the distance of points from the walls beside the expected one, and the distance by "
            "height",
            "Distance of the points from the nearest wall or ledge, negative inside: how many there are, "
            "beside what noise, density and strays make the model expect; and, for those beside walls, where "
            "they are along the axis.",
        ),
    ]
