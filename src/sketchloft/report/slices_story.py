"""Story of the slices: which shape each one got, and what it rests on."""

from __future__ import annotations

from collections import Counter

from sketchloft.cloud import Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.evidence import SliceEvidence, diagonal, slice_evidence
from sketchloft.report.evidence_figure import evidence_figure
from sketchloft.report.markup import paragraph, picture, table
from sketchloft.report.pose import pose_of
from sketchloft.report.sections_figure import MOST_SLICES, sections_figure
from sketchloft.report.words import counted, number, probe_words, shape_size

__all__ = ["slices_story"]


def slices_story(result: Reconstruction, body: BodyModel, unit: Unit) -> list[str]:
    """Words, pictures and the table of all slices of a body."""
    slices = slice_evidence(body)
    kinds = Counter(one.shape.kind for one in slices).most_common()
    words = ", ".join(counted(count, kind) for kind, count in kinds)
    return [
        paragraph(
            f"Each contour is described by a shape, here {words}. The shape is then moved evenly until it "
            "encloses the area that the points of its slice account for. In a filled cloud that is a little "
            "more than the contour, since the wall lies beyond the outermost points: edge points a small, "
            "even distance inside their shape are no fault, scatter is."
        ),
        picture(
            sections_figure(result, body, unit=unit),
            "Slices with worked points, edge points and fitted shape",
            f"{min(MOST_SLICES, len(slices))} of {counted(len(slices), 'slice')}, evenly chosen, each at its "
            "own scale, seen against the slicing direction.",
        ),
        picture(
            evidence_figure(body, unit=unit),
            "Bars for every slice: its points, and the distance of its edge points from its shape",
            "What every slice rests on: the number of its points, and the distance of the edge points from "
            "the fitted shape. Pale: root mean square; strong: the scatter that is left without the mean.",
        ),
        _table(result, body, slices, unit),
    ]


def _table(result: Reconstruction, body: BodyModel, slices: tuple[SliceEvidence, ...], unit: Unit) -> str:
    pose, size = pose_of(result, body), diagonal(body)
    head = [
        "slice", f"height [{unit}]", "points", "edge points", "left out", "probe radius", "shape",
        f"rms [{unit}]", "rms [‰]", f"mean [{unit}]",
    ]  # fmt: skip
    return table(
        head,
        [_row(one, pose.height_words(one.height, body), size, unit) for one in slices],
        caption="Every slice. Left out: contours other than the outer one. rms and mean: distance of the "
        "edge points from the shape, negative inside; ‰ of the model's diagonal. A dot marks planes at ends, "
        "extrema and steps.",
        numbers=[0, 1, 2, 3, 4, 5, 7, 8, 9],
    )


def _row(one: SliceEvidence, height: str, size: float, unit: Unit) -> list[str]:
    return [
        f"{'• ' if one.is_key else ''}{one.index}",
        height,
        f"{one.points:,}",
        f"{one.edge_points:,}",
        str(one.left_out),
        probe_words(one.probe_radius, unit),
        f"{one.shape.kind}, {shape_size(one.shape, unit)}",
        number(one.rms, 3),
        number(1000 * one.rms / size, 3),
        number(one.mean, 3),
    ]
