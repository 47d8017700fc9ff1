"""Form: how a kind of wall or outline is described, for both ways between a model and its plan."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sketchloft.plan.field import Field

__all__ = ["Form", "form"]


@dataclass(frozen=True)
class Form:
    """How a kind of wall or outline is described.

    Parameters
    ----------
    fields : tuple of Field
        Those that are fitted in the order of the parameters.
    read : callable
        From a wall or outline, the values of its fields by name; None where it has none.
    make : callable
        The wall or outline of the values of its fields; raises ValueError where they do not go together.
    """

    fields: tuple[Field, ...]
    read: Callable[[Any], dict[str, Any]]
    make: Callable[[dict[str, Any]], Any]


def form(make: Callable[..., Any], *fields: Field) -> Form:
    """Describe something whose fields are attributes, and arguments of what makes it."""

    def read(thing: Any) -> dict[str, Any]:
        return {field.name: getattr(thing, field.attribute) for field in fields}

    def made(values: dict[str, Any]) -> Any:
        return make(**{field.attribute: values[field.name] for field in fields if field.name in values})

    return Form(fields, read, made)
