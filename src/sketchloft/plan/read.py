"""Read a plan: TOML, every key checked, and the model that it describes tried out."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import get_args

import numpy as np

from sketchloft.cloud import UNITS
from sketchloft.errors import InputError
from sketchloft.exact.model.exact_model import Join
from sketchloft.plan.numbers import numbers
from sketchloft.plan.plan import FITS, Numbers, Plan, PlannedBody, PlannedBreak, PlannedWall
from sketchloft.plan.read_walls import read_run
from sketchloft.plan.table import Table, check_keys, checked, one_of, tables
from sketchloft.plan.to_model import model_from_plan

__all__ = ["parse_plan", "read_plan"]

JOINS: tuple[Join, ...] = get_args(Join)
KEYS = ("name", "direction", "x_axis", "centre", "noise", "breaks", "run")


def read_plan(path: Path) -> Plan:
    """Read a plan.

    Raises
    ------
    InputError
        If the file cannot be read, or says what a plan cannot say; the message names the place.
    """
    try:
        return parse_plan(path.read_bytes().decode("utf-8-sig"))
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: is no text in UTF-8; give a plan that --save-plan has written") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def parse_plan(text: str) -> Plan:
    """Read the text of a plan, as `read_plan`."""
    try:
        top = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"is not valid TOML: {error}") from None
    check_keys(top, "", ("body",), ("fit", "unit"), what="a plan")
    bodies = [_body(table, f"body {i}") for i, table in enumerate(tables(top["body"], "body"), start=1)]
    unit = one_of(top.get("unit", UNITS[0]), UNITS, "unit")
    return Plan(unit, one_of(top.get("fit", FITS[0]), FITS, "fit"), tuple(bodies))


def _body(table: Table, place: str) -> PlannedBody:
    check_keys(table, f"{place}: ", KEYS, ("fit", "shared"), what="a body")
    name = table["name"]
    if not isinstance(name, str) or not name:
        raise InputError(f"{place}: name: found {name!r}, expected a text")
    direction, x_axis, centre = (
        checked(lambda raw: numbers(raw, (3,)), table[key], f"{place}: {key}")
        for key in ("direction", "x_axis", "centre")
    )
    across = np.linalg.norm(np.cross(direction, x_axis))
    if not across > 1e-6 * np.linalg.norm(direction) * np.linalg.norm(x_axis):
        raise InputError(f"{place}: x_axis: is along the direction, or one is zero; give one across it")
    noise = checked(lambda raw: numbers(raw, ()), table["noise"], f"{place}: noise")
    if noise <= 0:
        raise InputError(f"{place}: noise: found {noise!r}, expected a positive number")
    breaks, runs, shared = _along(table, place)
    fit = one_of(table["fit"], FITS, f"{place}: fit") if "fit" in table else None
    body = PlannedBody(name, direction, x_axis, centre, noise, breaks, runs, shared, fit)
    try:
        model_from_plan(body, 1.0)
    except InputError as error:
        raise InputError(f"{place}: {error}") from None
    return body


def _along(
    table: Table, place: str
) -> tuple[tuple[PlannedBreak, ...], tuple[tuple[PlannedWall, ...], ...], dict[str, Numbers]]:
    """Breaks, runs and shared values of a body."""
    breaks = tables(table["breaks"], f"{place}: breaks")
    runs = tables(table["run"], f"{place}: run")
    if len(breaks) != len(runs) + 1:
        raise InputError(
            f"{place}: breaks: found {len(breaks)} breaks and {len(runs)} runs, expected one break more than "
            "runs; take out a break with each run that is taken out"
        )
    written = table.get("shared", {})
    if not isinstance(written, dict):
        raise InputError(f"{place}: shared: found {written!r}, expected a table of names and values")
    read = [read_run(run, f"{place}, run {j}", written) for j, run in enumerate(runs, start=1)]
    shared = {name: value for _, used in read for name, value in used.items()}
    planned = [_break(item, f"{place}, break {k}: ") for k, item in enumerate(breaks, start=1)]
    return tuple(planned), tuple(walls for walls, _ in read), shared


def _break(table: Table, place: str) -> PlannedBreak:
    join = one_of(table.get("join", "step"), JOINS, f"{place}join")
    key = "height" if join == "step" else "near"
    check_keys(table, place, (key,), ("join",), what=f"a {join}")
    return PlannedBreak(join, checked(lambda raw: numbers(raw, ()), table[key], place + key))
