"""Story of a body: what every stage made of it, in pictures, tables and plain words."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.report.cloud_figure import cloud_figure
from sketchloft.report.distance_figure import distance_figure
from sketchloft.report.exact_story import exact_story
from sketchloft.report.loft_figure import loft_figure
from sketchloft.report.markup import paragraph, picture, section, table
from sketchloft.report.side_figure import side_figure
from sketchloft.report.slices_story import slices_story
from sketchloft.report.words import axis_name, counted, direction_words, number

__all__ = ["body_story"]


def body_story(result: Reconstruction, body: ExactBody | BodyModel, unit: Unit) -> list[str]:
    """Sections of the report about one body, in the order of the stages."""
    if isinstance(body, ExactBody):
        return exact_story(result, body, unit)
    return [
        section("Slicing direction", *_direction(body), level=3),
        section("Slice planes", *_planes(result, body, unit), level=3),
        section("Worked points and edge points", *_points(result, body, unit), level=3),
        section("Shapes of the sections", *slices_story(result, body, unit), level=3),
        section("Loft", *_loft(result, body, unit), level=3),
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
            f"Of {counted(len(rows), 'candidate')}, {words} was taken. The target function is small where "
            "the section changes least from one slab to the next and stays one simple contour. Values that "
            "differ by no more than chance explains count as equal; then an axis of the cloud is preferred, "
            "the one along which the body is longest first."
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
            "surface is. Their distance to the central axis tells where the body has its ends, its widest "
            f"and narrowest places and its steps: {keys} key heights. Planes go there first; the spaces "
            f"between are divided by the number of their points. That gives {planes} planes."
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
        counted(left_out, "further contour was", "further contours were") if left_out else "No contour was"
    )
    return [
        paragraph(
            f"Every point goes to the nearest plane, which puts {worked:,} points on {len(body.worked)} "
            "planes. On each, the probe of a 2D alpha shape is rolled around the points; those that it "
            f"touches from outside, {edges:,} in all, are in their order the contour of the section. "
            f"{others} left out. The points fill {100 * filled:.0f} % of the area within the contours."
        ),
        picture(
            side_figure(result, body, unit=unit),
            "Three panels: planes through the cloud, worked points with edge points, edge points in space",
            "From the side: the cloud and its slice planes, and the points worked onto them with the edge "
            "points in blue. On the right the edge points alone.",
        ),
    ]


def _loft(result: Reconstruction, body: BodyModel, unit: Unit) -> list[str]:
    between = (
        "Between neighbouring sections the surface runs along straight lines, so it never bulges beyond them."
        if result.params.loft.between == "straight"
        else "A cubic spline runs through all sections, so the surface is smooth along the slicing direction."
    )
    return [
        paragraph(
            f"The {len(body.sections)} sections are brought to a common start, so that nothing twists, "
            f"joined by one skin, and closed with plane caps. {between}"
        ),
        picture(
            loft_figure(result, body, unit=unit),
            "Three panels: section curves in space, the lofted solid, and the solid from behind",
            "The section curves by kind of shape, and the solid, its faces coloured by kind of surface.",
        ),
    ]
