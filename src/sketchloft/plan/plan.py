"""Plan: what was found about each body, in the terms and units that a person edits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from sketchloft.cloud import Floats, Unit
from sketchloft.exact.model.exact_model import Join
from sketchloft.frame import Frame

__all__ = ["FITS", "Fit", "Numbers", "Plan", "PlannedBody", "PlannedBreak", "PlannedWall", "Shared", "Value"]

Fit = Literal["nothing", "sizes"]
FITS: tuple[Fit, ...] = get_args(Fit)

Numbers = float | Floats


@dataclass(frozen=True)
class Shared:
    """A value that several walls share, by its name."""

    name: str


Value = Numbers | str | Shared


@dataclass(frozen=True)
class PlannedBreak:
    """Where the runs below and above meet.

    Parameters
    ----------
    join : {"step", "cross", "tangent", "pole"}
    height : float
        Of a step; of the others about, since the walls say where they meet.
    """

    join: Join
    height: float


@dataclass(frozen=True)
class PlannedWall:
    """A wall.

    Parameters
    ----------
    kind : str
        One of `sketchloft.plan.walls.FORMS`.
    values : mapping of str to Value
        Its fields, angles in degrees.
    hole : bool
        Whether it bounds a hole.
    """

    kind: str
    values: Mapping[str, Value]
    hole: bool = False


@dataclass(frozen=True)
class PlannedBody:
    """A body.

    Parameters
    ----------
    name : str
    direction, x_axis : (3,) float array
        Of the heights and of x across them, in the cloud's axes; need not be unit vectors.
    centre : (3,) float array
        Where heights, x and y are 0, in the cloud's coordinates.
    noise : float
        Standard deviation of the points.
    breaks : tuple of k + 1 PlannedBreak
        From low to high.
    runs : tuple of k tuples of PlannedWall
    shared : mapping of str to float or float array
        The values that `Shared` names.
    fit : {"nothing", "sizes"} or None
        None is as the plan says.
    """

    name: str
    direction: Floats
    x_axis: Floats
    centre: Floats
    noise: float
    breaks: tuple[PlannedBreak, ...]
    runs: tuple[tuple[PlannedWall, ...], ...]
    shared: Mapping[str, Numbers]
    fit: Fit | None = None

    @property
    def frame(self) -> Frame:
        """The axes across and along; of the x axis what lies across the direction."""
        z = self.direction / np.linalg.norm(self.direction)
        x = self.x_axis / np.linalg.norm(self.x_axis)
        x = x - (x @ z) * z
        x /= np.linalg.norm(x)
        return Frame(np.stack([x, np.cross(z, x), z]))


@dataclass(frozen=True)
class Plan:
    """The bodies of a cloud.

    Parameters
    ----------
    unit : {"mm", "cm", "m", "in"}
        Of the cloud, and of all lengths.
    fit : {"nothing", "sizes"}
        Whether the numbers stay as they are written, or are fitted to the points once more.
    bodies : tuple of PlannedBody
        In the order in which the cloud is separated, the largest first.
    """

    unit: Unit
    fit: Fit
    bodies: tuple[PlannedBody, ...]

    def fits_sizes(self, index: int) -> bool:
        """Whether the numbers of a body are to be fitted."""
        return (self.bodies[index].fit or self.fit) == "sizes"
