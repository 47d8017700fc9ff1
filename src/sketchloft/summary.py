"""Summary: the key figures of a reconstruction, for people and for machines."""

from __future__ import annotations

from collections import Counter
from typing import Any

from sketchloft.cloud import Unit
from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import BodyModel, Reconstruction
from sketchloft.remarks import remarks

__all__ = ["summary", "summary_lines"]


def summary(result: Reconstruction, unit: Unit) -> dict[str, Any]:
    """Key figures as plain values, ready for JSON.

    Parameters
    ----------
    result : Reconstruction
    unit : {"mm", "cm", "m", "in"}
        Of the cloud.
    """
    return {
        "unit": unit,
        "points": {
            "read": result.cloud.n_read,
            "not_finite": result.cloud.n_not_finite,
            "repeated": result.cloud.n_repeated,
            "used": len(result.cloud),
        },
        "bodies": [_body(body) for body in result.bodies],
        "remarks": list(remarks(result)),
    }


def _body(body: ExactBody | BodyModel) -> dict[str, Any]:
    if isinstance(body, ExactBody):
        vector = body.vector
        found: dict[str, Any] = {
            "runs": [run.kinds for run in body.model.stack.runs],
            "noise": body.model.sigma * body.scale,
        }
    else:
        vector = body.direction.vector
        shapes = Counter(section.shape.kind for section in body.sections)
        found = {"slices": len(body.sections), "shapes": dict(sorted(shapes.items()))}
    return {
        "name": body.name,
        "points": len(body.points),
        "direction": vector.tolist(),
        **found,
        "faces": body.facts.faces,
        "volume": body.facts.volume,
        "area": body.facts.area,
        "bounds": body.facts.bounds.tolist(),
        "valid": True,  # an invalid solid is not given out
    }


def summary_lines(result: Reconstruction, unit: Unit) -> list[str]:
    """Key figures as lines for people."""
    lines = []
    for body in result.bodies:
        facts = _body(body)
        if isinstance(body, ExactBody):
            kinds = ["+".join(run) for run in facts["runs"]]
            found = f"{len(kinds)} runs ({', '.join(kinds)})" if len(kinds) > 1 else kinds[0]
        else:
            shapes = ", ".join(f"{count} {kind}" for kind, count in facts["shapes"].items())
            found = f"{facts['slices']} slices ({shapes})"
        faces = ", ".join(f"{count} {kind}" for kind, count in facts["faces"].items())
        vector = ", ".join(f"{c:.3f}" for c in facts["direction"])
        size = " x ".join(f"{c:.5g}" for c in body.facts.bounds[1] - body.facts.bounds[0])
        lines += [
            f"{body.name}: valid solid of {sum(facts['faces'].values())} faces ({faces})",
            f"  from {facts['points']} points, {found} along ({vector})",
            f"  volume {facts['volume']:.6g} {unit}³, area {facts['area']:.6g} {unit}², box {size} {unit}",
        ]
    return lines
