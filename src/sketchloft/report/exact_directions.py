"""Directions of the exact method: which ones were compared, and what decided."""

from __future__ import annotations

from sketchloft.exact.body import ExactBody
from sketchloft.report.markup import paragraph, table
from sketchloft.report.words import counted, direction_words, number

__all__ = ["exact_directions"]

SOURCES = {
    "extrusion": "most of the wall lies along it",
    "revolution": "the normals of the wall meet an axis along it",
    "caps": "much of the wall lies across it",
    "ball": "from a ball to what sticks out of it",
    "principal": "principal axis of the points",
}
"""Why directions are candidates."""


def exact_directions(body: ExactBody) -> list[str]:
    """Words about the slicing direction, and a table of the directions that were compared."""
    words = direction_words(body.vector)
    if not body.candidates:
        return [paragraph(f"The slicing direction was given: {words}. What follows is seen along it.")]
    rows = [
        [direction_words(one.vector), SOURCES.get(one.source, one.source), number(one.value, 5)]
        for one in body.candidates
    ]
    return [
        paragraph(
            f"Of {counted(len(rows), 'direction')}, the one along which the points are most likely was "
            "taken, or of several about as likely the one whose first walls explain them best, and then "
            f"fitted together with the walls: {words}. What follows is seen along it."
        ),
        table(
            ["direction", "why it was looked at", "log likelihood per point"],
            rows,
            caption="Candidates for the slicing direction, the one that was taken first.",
            numbers=[2],
        ),
    ]
