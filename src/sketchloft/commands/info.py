"""`sketchloft info`: what is in a file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

from sketchloft.brep.format import MODEL_FORMATS
from sketchloft.commands.console import Json, show, show_json
from sketchloft.io import format_of, read_cloud

__all__ = ["info"]


def info(
    file: Annotated[Path, Parameter(help="A cloud or a model.")],
    /,
    *,
    json: Json = False,
) -> None:
    """Tell what is in a file."""
    is_model = any(file.suffix.lower() in one.suffixes for one in MODEL_FORMATS)
    facts = _model(file) if is_model else _cloud(file)
    if json:
        show_json(facts)
        return
    show(str(file))
    for key, value in facts.items():
        show(f"  {key.replace('_', ' '):14} {_text(value)}")


def _cloud(file: Path) -> dict[str, Any]:
    points = read_cloud(file).points
    finite = points[np.isfinite(points).all(axis=1)]
    facts: dict[str, Any] = {
        "format": format_of(file).name,
        "points": len(points),
        "not_finite": len(points) - len(finite),
        "repeated": len(finite) - len(np.unique(finite, axis=0)),
    }
    if len(finite):
        low, high = finite.min(axis=0), finite.max(axis=0)
        facts |= {"lower": low.tolist(), "upper": high.tolist(), "extents": (high - low).tolist()}
    return facts


def _model(file: Path) -> dict[str, Any]:
    from sketchloft.brep.files import load_mesh, read_model  # noqa: PLC0415  the kernel only for models

    if next(one for one in MODEL_FORMATS if file.suffix.lower() in one.suffixes).reads != "solids":
        mesh = load_mesh(file)
        return {
            "triangles": len(mesh.triangles),
            "vertices": len(mesh.vertices),
            "volume": mesh.volume,
            "lower": mesh.vertices.min(axis=0).tolist(),
            "upper": mesh.vertices.max(axis=0).tolist(),
        }
    from sketchloft.brep.facts import solid_facts  # noqa: PLC0415  as above

    model = read_model(file)
    facts: dict[str, Any] = {"unit": model.unit, "solids": len(model.bodies)}
    for body in model.bodies:
        found = solid_facts(body.solid)
        facts[body.name] = {
            "faces": found.faces,
            "volume": found.volume,
            "area": found.area,
            "lower": found.bounds[0].tolist(),
            "upper": found.bounds[1].tolist(),
        }
    return facts


def _text(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {_text(one)}" for key, one in value.items())
    if isinstance(value, list):
        return "(" + ", ".join(f"{x:.6g}" for x in value) + ")"
    if value is None:
        return "not told"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
