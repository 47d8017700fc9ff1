"""Trust in exact models: what they rest on, in one row per body."""

from __future__ import annotations

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.report.findings import noise_words, size_of, stray_words
from sketchloft.report.markup import paragraph, table
from sketchloft.report.precision import precision
from sketchloft.report.words import number

__all__ = ["CHECKS", "exact_trust"]

CHECKS = (
    "Checked before it was given out: one closed shell without free edges, accepted by the CAD kernel, "
    "normals outwards, walls that do not meet, a volume equal to that of the sections, faces that lie on the "
    "fitted walls and breaks, and the same solid when it is read back from STEP."
)


def exact_trust(bodies: list[ExactBody], unit: Unit) -> list[str]:
    """Table and words about noise, strays, and the error that they leave."""
    head = [
        "body",
        "points",
        "runs",
        "parameters",
        f"noise [{unit}]",
        "noise [‰]",
        "strays",
        f"error [{unit}]",
        "error [‰]",
    ]
    return [
        table(
            head,
            [_row(body) for body in bodies],
            caption="What the model rests on. noise: standard deviation of the points across the walls. "
            "error: how far a place on the walls is off by chance, root mean square, with so many points and "
            "parameters. ‰ of the model's diagonal.",
            numbers=[1, 2, 3, 4, 5, 7, 8],
        ),
        paragraph(
            "The error is what statistics leave open if the kinds of walls and the breaks are right. What is "
            "smaller than the noise, or holds a few points only, is not in the model. How far it is from "
            "what was meant, only a measurement against a goal can say."
        ),
    ]


def _row(body: ExactBody) -> list[str]:
    size, errors = size_of(body), precision(body)
    error, noise = errors.wall * body.scale, max(body.model.sigma, errors.gap) * body.scale
    return [
        body.name,
        f"{len(body.points):,}",
        str(len(body.model.stack.runs)),
        str(body.model.parameters),
        noise_words(body, errors),
        number(1000 * noise / size, 2),
        stray_words(body),
        number(error, 2),
        number(1000 * error / size, 2),
    ]
