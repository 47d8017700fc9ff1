"""Read the runs of a plan: their walls, each with the fields of its kind."""

from __future__ import annotations

from typing import Any

from sketchloft.errors import InputError
from sketchloft.plan.field import Field, Number
from sketchloft.plan.plan import Numbers, PlannedWall, Shared, Value
from sketchloft.plan.table import Table, check_keys, checked, listed, one_of, tables
from sketchloft.plan.walls import FORMS

__all__ = ["read_run"]


def read_run(table: Table, place: str, written: Table) -> tuple[tuple[PlannedWall, ...], dict[str, Numbers]]:
    """Read a run.

    Parameters
    ----------
    table : mapping
    place : str
        What messages begin with.
    written : mapping
        The body's shared values.

    Returns
    -------
    tuple of PlannedWall
    dict of str to float or float array
        The shared values that these walls name.
    """
    check_keys(table, f"{place}: ", ("wall",), what="a run")
    shared: dict[str, Numbers] = {}
    walls = tuple(
        _wall(item, f"{place}, wall {i}: ", written, shared)
        for i, item in enumerate(tables(table["wall"], f"{place}: wall"), start=1)
    )
    holes = [wall.hole for wall in walls]
    if holes[0] or holes != sorted(holes):
        raise InputError(f"{place}: expected walls that are no holes, one or more, and the holes after them")
    return walls, shared


def _wall(table: Table, place: str, written: Table, shared: dict[str, Numbers]) -> PlannedWall:
    if "kind" not in table:
        raise InputError(f"{place}the key 'kind' is missing; expected one of {listed(FORMS)}")
    kind = one_of(table["kind"], tuple(FORMS), f"{place}kind")
    fields = FORMS[kind].fields
    required = ["kind", *(field.name for field in fields if field.required)]
    optional = [*(field.name for field in fields if not field.required), "hole"]
    check_keys(table, place, required, optional, what=f"a wall of kind '{kind}'")
    hole = table.get("hole", False)
    if not isinstance(hole, bool):
        raise InputError(f"{place}hole: found {hole!r}, expected true or false")
    values = {
        field.name: _value(field, table[field.name], place + field.name, written, shared)
        for field in fields
        if field.name in table
    }
    return PlannedWall(kind, values, hole)


def _value(field: Field, raw: Any, place: str, written: Table, shared: dict[str, Numbers]) -> Value:
    if not isinstance(field, Number):
        return checked(field.parse, raw, place)
    if not isinstance(raw, str):
        return checked(field.parse, raw, place)
    if raw not in written:
        known = listed(written) or "which is empty"
        raise InputError(f"{place}: found {raw!r}, expected a value, or a name of [body.shared]: {known}")
    shared[raw] = checked(field.parse, written[raw], f"{place}: {raw}")
    return Shared(raw)
