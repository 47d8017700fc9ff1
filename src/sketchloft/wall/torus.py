"""Torus: what two walls are that are the outer and the inner half of one."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.wall.profile import ArcProfile
from sketchloft.wall.revolved import Revolved

__all__ = ["Torus", "torus_of"]


@dataclass(frozen=True)
class Torus:
    """A whole torus about an axis along z.

    Parameters
    ----------
    centre : (2,) float array
        Where the axis is.
    height : float
    offset : float
        Distance of the turned circle's centre from the axis.
    radius : float
        Of that circle.
    """

    centre: Floats
    height: float
    offset: float
    radius: float

    def beyond(self, points: Floats) -> NDArray[np.bool_]:
        """(n,) whether points (n, 3) are on the side of the outer half."""
        return np.asarray(np.hypot(*(points[:, :2] - self.centre).T) > self.offset)


def torus_of(outer: object, inner: object) -> Torus | None:
    """The torus that two walls are the halves of; None for other walls."""
    if not isinstance(outer, Revolved) or not isinstance(inner, Revolved):
        return None
    arc = outer.profile
    if not isinstance(arc, ArcProfile) or arc.offset is None or arc.side != 1:
        return None
    if inner.profile != replace(arc, side=-1) or not np.array_equal(inner.centre, outer.centre):
        return None
    return Torus(outer.centre, arc.height, arc.offset, arc.radius)
