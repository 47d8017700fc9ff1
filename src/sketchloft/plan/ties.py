"""Ties: values that several walls share, as parameters of a model and as names in a plan."""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from sketchloft.cloud import Ints
from sketchloft.errors import InputError
from sketchloft.exact.model.exact_model import ExactModel
from sketchloft.plan.field import Number
from sketchloft.plan.plan import PlannedBody, Shared
from sketchloft.plan.walls import FORMS, kind_of
from sketchloft.stack import Wall
from sketchloft.wall.swept import MOVEMENTS, Swept

__all__ = ["Place", "shared_names", "tied_pairs"]

Place = tuple[int, int, str]
"""Run, wall and field."""


def fields_in_vector(wall: Wall) -> dict[str, Ints]:
    """Where in a wall's vector the parameters of each of its fields are."""
    form = FORMS[kind_of(wall)]
    values = form.read(wall)
    fields = [f for f in form.fields if values.get(f.name) is not None]
    if isinstance(wall, Swept):
        moves = wall.free
        fields = [f for f in fields if f.name not in MOVEMENTS or f.name in moves]
        fields.sort(key=lambda f: moves.index(f.name) if f.name in moves else -1)
    found, at = {}, 0
    for field in fields:
        count = field.entries(values[field.name])
        if count:
            found[field.name] = np.arange(at, at + count)
        at += count
    return found


def shared_names(model: ExactModel) -> dict[Place, str]:
    """Names for the fields whose parameters are all tied to those of another field.

    Returns
    -------
    dict of (run, wall, field) to str
        Runs and walls counted from 0. A field of which single parameters only are tied is left out.
    """
    groups: dict[tuple[int, ...], list[Place]] = defaultdict(list)
    for j, (run, slots) in enumerate(zip(model.stack.runs, model.slots, strict=True)):
        for i, (wall, slot) in enumerate(zip(run.walls, slots, strict=True)):
            for field, where in fields_in_vector(wall).items():
                groups[tuple(slot[where].tolist())].append((j, i, field))
    names: dict[Place, str] = {}
    taken: set[str] = set()
    for places in groups.values():
        if len(places) < 2:
            continue
        stem = "axis" if places[0][2] == "centre" else places[0][2]
        name = next(n for n in (stem, *(f"{stem}_{k}" for k in range(2, 10**6))) if n not in taken)
        taken.add(name)
        names.update(dict.fromkeys(places, name))
    return names


Parameter = tuple[int, int, int]


def tied_pairs(body: PlannedBody, walls: list[list[Wall]]) -> list[tuple[Parameter, Parameter]]:
    """Pairs of parameters, for `tied`, that share a value.

    Parameters
    ----------
    body : PlannedBody
    walls : list of list of Wall
        Made of it.

    Raises
    ------
    InputError
        If a shared value stands for things that are measured differently.
    """
    first: dict[str, tuple[str, list[Parameter]]] = {}
    pairs: list[tuple[Parameter, Parameter]] = []
    for j, run in enumerate(body.runs):
        for i, wall in enumerate(run):
            where = fields_in_vector(walls[j][i])
            for field in FORMS[wall.kind].fields:
                value = wall.values.get(field.name)
                if not isinstance(value, Shared) or not isinstance(field, Number) or field.name not in where:
                    continue
                mine = [(j, i, int(k)) for k in where[field.name]]
                quantity, other = first.setdefault(value.name, (field.quantity, mine))
                if quantity != field.quantity or len(other) != len(mine):
                    raise InputError(
                        f"shared: {value.name}: found in use as {quantity} and as {field.quantity}; "
                        "give each of them a value of its own"
                    )
                pairs += list(zip(other, mine, strict=True)) if other is not mine else []
    return pairs
