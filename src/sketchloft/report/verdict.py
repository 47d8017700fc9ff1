"""Verdict: what came out and how far it is to be trusted, on top of the report."""

from __future__ import annotations

from collections import Counter

import numpy as np

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.measurement import Measurement
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.remarks import remarks
from sketchloft.report.evidence import diagonal, slice_evidence, total_rms
from sketchloft.report.exact_trust import CHECKS, exact_trust
from sketchloft.report.markup import bullets, figures, paragraph, picture, table
from sketchloft.report.overview_figure import overview_figure
from sketchloft.report.words import FACE_WORDS, TIMES, number

__all__ = ["trust", "verdict"]

LOFT_CHECKS = (
    "Checked before it was given out: one closed shell without free edges, accepted by the CAD kernel, "
    "normals outwards, sections that do not cut themselves, a volume equal to that of the sections, and "
    "a surface that passes through all of them."
)


def verdict(result: Reconstruction, unit: Unit, measurement: Measurement | None) -> str:
    """Whether the model is valid, its key figures and its picture."""
    bodies = result.bodies
    found = "Valid solid" if len(bodies) == 1 else f"{len(bodies)} valid solids"
    cards = _measured(measurement, unit)
    summary = ""
    if len(bodies) == 1:
        cards = _key_figures(bodies[0], unit) | cards
    else:
        rows = [[body.name, *map(_joined, _key_figures(body, unit).values())] for body in bodies]
        head = ["body", *_key_figures(bodies[0], unit)]
        summary = table(head, rows, caption="Key figures of every body.", numbers=[2, 3, 4])
    figured = (figures(cards) if cards else "") + summary
    checks = CHECKS if isinstance(bodies[0], ExactBody) else LOFT_CHECKS
    names = ", ".join(body.name for body in bodies)
    shown = picture(
        overview_figure(result, unit=unit),
        f"The points of the cloud on the left, the model of {names} on the right",
        "The cloud as it was read, and the model that was made of it, from the same side at the same scale.",
    )
    return "\n".join([paragraph(found, "verdict"), figured, paragraph(checks), shown])


def trust(result: Reconstruction, unit: Unit) -> list[str]:
    """What was left out, and how well the shapes fit the points."""
    found = remarks(result)
    said = bullets(found, "remarks") if found else paragraph("Nothing was left out on the way.")
    exact = [body for body in result.bodies if isinstance(body, ExactBody)]
    if exact:
        return [said, *exact_trust(exact, unit)]
    rows = [_trust_row(body, unit) for body in result.bodies if isinstance(body, BodyModel)]
    head = [
        "body",
        "points",
        "slices",
        "fewest points",
        "fewest edge points",
        f"rms [{unit}]",
        "rms [‰]",
        "worst slice",
    ]
    grounds = table(
        head,
        rows,
        caption="What the model rests on. rms: distance of the edge points from the shapes fitted to them, "
        "also in thousandths of the model's diagonal; the worst slice is the one with the largest.",
        numbers=[1, 2, 3, 4, 5, 6, 7],
    )
    caution = paragraph(
        "These figures say how well the shapes fit the points that were found. How far the model is from "
        "what was meant, only a measurement against a goal can say. Between slices the model is lofted and "
        "has no evidence of its own: what is smaller than the distance of the slices is not in it."
    )
    return [said, grounds, caution]


def _key_figures(body: ExactBody | BodyModel, unit: Unit) -> dict[str, tuple[str, str]]:
    facts = body.facts
    kinds = Counter(facts.faces).most_common()
    box = f" {TIMES} ".join(number(float(c)) for c in facts.bounds[1] - facts.bounds[0])
    return {
        "faces": (
            str(sum(facts.faces.values())),
            ", ".join(f"{count} {FACE_WORDS.get(kind, kind)}" for kind, count in kinds),
        ),
        "volume": (f"{number(facts.volume, 5)} {unit}³", ""),
        "area": (f"{number(facts.area, 5)} {unit}²", ""),
        "box": (f"{box} {unit}", ""),
    }


def _joined(figure: tuple[str, str]) -> str:
    value, remark = figure
    return f"{value} ({remark})" if remark else value


def _measured(measurement: Measurement | None, unit: Unit) -> dict[str, tuple[str, str]]:
    if measurement is None:
        return {}
    share = number(measurement.errors_in_thousandths.rms, 3)
    error = f"{number(measurement.errors.rms, 3)} {unit}"
    return {"error against the goal": (error, f"rms, {share} ‰ of the goal's diagonal")}


def _trust_row(body: BodyModel, unit: Unit) -> list[str]:
    slices = slice_evidence(body)
    points, edges = [one.points for one in slices], [one.edge_points for one in slices]
    rms = total_rms(slices)
    worst = int(np.argmax([one.rms for one in slices]))
    return [
        body.name,
        f"{len(body.points):,}",
        str(len(slices)),
        f"{min(points):,} (slice {int(np.argmin(points))})",
        f"{min(edges):,} (slice {int(np.argmin(edges))})",
        number(rms, 3),
        number(1000 * rms / diagonal(body), 3),
        f"{worst}: {number(slices[worst].rms, 3)} {unit}",
    ]
