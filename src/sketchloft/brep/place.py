"""Placing: a solid moved from the frame it was built in to where it belongs."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS

from sketchloft.brep.solid import Solid
from sketchloft.errors import ModelError

__all__ = ["placed"]


def placed(solid: Solid, scale: float, origin: ArrayLike, axes: ArrayLike | None = None) -> Solid:
    """Scale, turn and move a solid; every point p becomes `origin + scale * p @ axes`.

    Parameters
    ----------
    solid : Solid
    scale : float
        Positive.
    origin : (3,) array_like
        Where the old origin goes.
    axes : (3, 3) array_like, optional
        Right-handed orthonormal system: the old x, y and z axes in rows (`Frame.axes`). Not turned without.

    Returns
    -------
    Solid
        With new geometry: the placement is in the coordinates, not in a transformation beside them.

    Raises
    ------
    ModelError
        If the scale is not positive or the axes are not right-handed and orthonormal.
    """
    rows = np.eye(3) if axes is None else np.asarray(axes, dtype=np.float64)
    if not scale > 0:
        raise ModelError(f"a solid cannot be scaled by {scale}; the scale must be positive")
    if not np.allclose(rows @ rows.T, np.eye(3), atol=1e-9) or np.linalg.det(rows) < 0:
        raise ModelError("the axes to place a solid in are not a right-handed orthonormal system")
    matrix = np.column_stack([scale * rows.T, np.asarray(origin, dtype=np.float64)])
    move = gp_Trsf()
    move.SetValues(*matrix.ravel().tolist())
    return Solid(TopoDS.Solid(BRepBuilderAPI_Transform(solid.shape, move, True).Shape()))
