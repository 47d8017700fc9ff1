"""Story of a body: what every stage made of it, in pictures, tables and plain words."""

from __future__ import annotations

from collections import Counter

import numpy as np

from sketchloft.cloud import Unit
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.cloud_figure import cloud_figure
from sketchloft.report.distance_figure import distance_figure
from sketchloft.report.evidence import SliceEvidence, diagonal, slice_evidence
from sketchloft.report.evidence_figure import evidence_figure
from sketchloft.report.loft_figure import loft_figure
from sketchloft.report.markup import paragraph, picture, section, table
from sketchloft.report.pose import pose_of
from sketchloft.report.sections_figure import sections_figure
from sketchloft.report.side_figure import side_figure
from sketchloft.report.words import axis_name, counted, direction_words, number, probe_words, shape_size

__all__ = ["body_story"]


def body_story(result: Reconstruction, body: BodyModel, unit: Unit, *, level: int) -> list[str]:
    """Sections of the report about one body, in the order of the stages."""
    return [
        section("Slicing direction", *_direction(body), level=level),
        section("Slice planes", *_planes(result, body, unit), level=level),
        section("Worked points and edge points", *_points(result, body, unit), level=level),
        section("Shapes of the sections", *_shapes(result, body, unit), level=level),
        section("Loft", *_loft(result, body, unit), level=level),
    ]


def _direction(body: BodyModel) -> list[str]:
    found = body.direction
    words = direction_words(found.vector)
    if not len(found.candidates):
        return [paragraph(f"The direction was given: {words}.")]
    rows = [
        [
            direction_words(vector),
            "axis of the cloud" if axis_name(vector) else "principal axis",
            number(float(target), 3),
            "taken" if np.array_equal(vector, found.vector) else "",
        ]
        for vector, target in zip(found.candidates, found.targets, strict=True)
    ]
    return [
        paragraph(
            f"Of {counted(len(rows), 'candidate')}, {words} was taken. The target function is small where the "
            "section changes least from one slab to the next and stays one simple contour. Values that chance "
            "alone could tell apart count as equal; then the axis of the cloud along which the body is longest "
            "is taken."
        ),
        table(
            ["direction", "kind", "target function", ""],
            rows,
            caption="Candidates for the slicing direction; smaller is better.",
            numbers=[2],
        ),
    ]


def _planes(result: Reconstruction, body: BodyModel, unit: Unit) -> list[str]:
    found = body.planes
    planes, keys, surface = len(found.heights), len(found.key_heights), len(found.axis_distance.points)
    return [
        paragraph(
            f"A small ball rolled around the cloud touches {surface:,} of its points: these show where the "
            "surface is. Their distance to the central axis tells where the body has its ends, its widest and "
            f"narrowest places and its steps. Planes go there first ({keys}); the spaces between are divided by "
            f"the number of points, which gives {planes} planes."
        ),
        picture(
            cloud_figure(result, body, unit=unit),
            "Three panels: the points, the surface points with the central axis, and a slab through both",
            "The points of the body, those that the 3D alpha shape finds on its surface, and a slab through "
            "the central axis that shows both.",
        ),
        picture(
            distance_figure(result, body, unit=unit),
            "Distance of the surface points to the central axis against height, with all slice planes",
            "Distance to the central axis along it. The line is the reach of the section; orange marks its "
            "extrema and steps, and the ends; every vertical line is a slice plane.",
        ),
    ]


def _points(result: Reconstruction, body: BodyModel, unit: Unit) -> list[str]:
    worked = sum(len(one.points) for one in body.worked)
    edges = sum(len(one.points) for one in body.edges)
    left_out = sum(one.left_out for one in body.edges)
    area = np.array([one.area for one in body.edges])
    filled = float(np.array([one.filled for one in body.edges]) @ area / area.sum())
    others = (
        f"{counted(left_out, 'further contour')} were left out." if left_out else "No contour was left out."
    )
    return [
        paragraph(
            f"Every point goes to the nearest plane, which puts {worked:,} points on {len(body.worked)} planes. "
            f"On each, the probe of a 2D alpha shape is rolled around the points; the {edges:,} that it touches "
            f"from outside, in order, are the contour of the section. {others} The points fill {100 * filled:.0f} % of the "
            "area within the contours."
        ),
        picture(
            side_figure(result, body, unit=unit),
            "Three panels: slice planes through the cloud, worked points with edge points, edge points in space",
            "From the side: the cloud and its slice planes, the points worked onto them with the edge points in "
            "blue, and the edge points alone.",
        ),
    ]


def _shapes(result: Reconstruction, body: BodyModel, unit: Unit) -> list[str]:
    slices = slice_evidence(body)
    kinds = Counter(one.shape.kind for one in slices).most_common()
    words = " and ".join(counted(count, kind) for kind, count in kinds)
    pose, size = pose_of(result, body), diagonal(body)
    rows = [_slice_row(one, pose.height_words(one.height, body), size, unit) for one in slices]
    return [
        paragraph(
            f"Each contour is described by a shape, here {words}. The edge points are the outermost "
            "ones that were drawn, so the wall lies a little beyond them: the shape is moved outwards until it "
            "encloses the area that the points account for. Edge points inside their shape by a small, even "
            "distance are therefore no fault; scatter is."
        ),
        picture(
            sections_figure(result, body, unit=unit),
            "Slices with worked points, edge points and fitted shape",
            f"{min(12, len(slices))} of {len(slices)} slices, evenly chosen, each at its own scale, seen against "
            "the slicing direction.",
        ),
        picture(
            evidence_figure(body, unit=unit),
            "Bars for every slice: its points, and the distance of its edge points from its shape",
            "What every slice rests on: its number of points, and the distance of the edge points from the "
            "fitted shape. Pale: root mean square; strong: the scatter that is left without the mean.",
        ),
        table(
            [
                "slice", f"height [{unit}]", "points", "edge points", "left out", "probe radius",
                "shape", f"rms [{unit}]", "rms [‰]", f"mean [{unit}]",
            ],
            rows,
            caption="Every slice. Left out: contours other than the outer one. rms and mean: distance of the edge "
            "points from the shape, negative inside; ‰ of the model's diagonal. A dot marks planes at ends, "
            "extrema and steps.",
            numbers=[0, 1, 2, 3, 4, 5, 7, 8, 9],
        ),
    ]  # fmt: skip


def _slice_row(one: SliceEvidence, height: str, size: float, unit: Unit) -> list[str]:
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


def _loft(result: Reconstruction, body: BodyModel, unit: Unit) -> list[str]:
    between = result.params.loft.between
    how = (
        "Between neighbouring sections the surface runs along straight lines, so it never bulges beyond them."
        if between == "straight"
        else "A cubic spline runs through all sections, so the surface is smooth along the slicing direction."
    )
    return [
        paragraph(
            f"The {len(body.sections)} sections are brought to a common start so that nothing twists, skinned, and "
            f"closed with plane caps. {how}"
        ),
        picture(
            loft_figure(result, body, unit=unit),
            "Three panels: section curves in space, the lofted solid, and the solid from behind",
            "The section curves by kind of shape, and the solid, its faces coloured by kind of surface.",
        ),
    ]
