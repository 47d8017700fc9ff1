"""Model: named solids with their unit, as a file holds them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sketchloft.cloud import Unit

if TYPE_CHECKING:  # naming a solid must not load the kernel
    from sketchloft.brep.solid import Solid

__all__ = ["METRES", "Fineness", "Model", "NamedSolid"]

METRES: dict[Unit, float] = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}
"""Length of each unit in metres."""


@dataclass(frozen=True)
class NamedSolid:
    """A solid and what it is called; any characters may be in the name."""

    name: str
    solid: Solid


@dataclass(frozen=True)
class Model:
    """Solids with a common unit.

    Parameters
    ----------
    bodies : tuple of NamedSolid
    unit : {"mm", "cm", "m", "in"} or None
        Unit of the solids' coordinates; None where a file does not tell. Written as millimetres then.
    """

    bodies: tuple[NamedSolid, ...]
    unit: Unit | None = "mm"

    @property
    def written_unit(self) -> Unit:
        """Unit that goes into a file."""
        return self.unit or "mm"


@dataclass(frozen=True)
class Fineness:
    """How closely triangles follow a surface.

    Parameters
    ----------
    chord : float
        Largest distance between surface and triangle, as a share of the diagonal of the solid's box.
    angle : float
        Largest angle, in radians, between neighbouring normals.
    """

    chord: float = 2e-4
    angle: float = 0.2
