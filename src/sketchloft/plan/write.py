"""Write a plan: TOML that reads well, every number with all the digits it has."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from sketchloft.output import beside
from sketchloft.plan.legend import LEGEND
from sketchloft.plan.plan import Numbers, Plan, PlannedBody, PlannedBreak, PlannedWall, Shared, Value
from sketchloft.plan.walls import FORMS

__all__ = ["plan_text", "write_plan"]


def write_plan(plan: Plan, path: Path) -> None:
    """Write a plan, whole or not at all.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    with beside(path) as parts:
        next(parts).write_bytes(plan_text(plan).encode("utf-8", "replace"))


def plan_text(plan: Plan) -> str:
    """Text of a plan; the same plan gives the same text."""
    lines = [LEGEND, f"fit = {_text(plan.fit)}", f"unit = {_text(plan.unit)}"]
    for body in plan.bodies:
        lines.extend(_body(body))
    return "\n".join(lines) + "\n"


def _body(body: PlannedBody) -> Iterator[str]:
    yield from ("", "[[body]]", f"name = {_text(body.name)}")
    if body.fit is not None:
        yield f"fit = {_text(body.fit)}"
    yield from (f"{key} = {_value(getattr(body, key))}" for key in ("direction", "x_axis", "centre", "noise"))
    yield from ("breaks = [", *(f"    {_break(at)}," for at in body.breaks), "]")
    if body.shared:
        yield from ("", "[body.shared]")
        yield from (f"{_key(name)} = {_value(value)}" for name, value in body.shared.items())
    for j, (run, (low, high)) in enumerate(zip(body.runs, pairwise(body.breaks), strict=True), start=1):
        yield from ("", f"# run {j}, from {low.height:.6g} to {high.height:.6g}", "[[body.run]]")
        for wall in run:
            yield from ("[[body.run.wall]]", f"kind = {_text(wall.kind)}", *_fields(wall))


def _break(at: PlannedBreak) -> str:
    key = "height" if at.join == "step" else "near"
    return f"{{ {key} = {at.height!r}, join = {_text(at.join)} }}"


def _fields(wall: PlannedWall) -> Iterator[str]:
    if wall.hole:
        yield "hole = true"
    for field in FORMS[wall.kind].fields:
        if field.name in wall.values:
            value = wall.values[field.name]
            yield f"{field.name} = {_value(value)}{_aside(field.name, value)}"


def _aside(name: str, value: Value) -> str:
    if name != "slope" or not isinstance(value, float):
        return ""
    return f"  # half angle {np.degrees(np.arctan(abs(value))):.4g} degrees"


def _value(value: Value | Numbers) -> str:
    if isinstance(value, Shared):
        return _text(value.name)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (int, float)):
        return repr(value)
    return _list(value.tolist(), "")


def _list(items: list[Any], indent: str) -> str:
    if not isinstance(items[0], list):
        return "[" + ", ".join(map(repr, items)) + "]"
    inner = "".join(f"{indent}    {_list(item, indent + '    ')},\n" for item in items)
    return f"[\n{inner}{indent}]"


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
