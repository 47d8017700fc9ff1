"""The exact solid of a stack."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from sketchloft.brep.check import check_closed
from sketchloft.brep.clearance import check_walls
from sketchloft.brep.joined import joined
from sketchloft.brep.pieces import check_pieces
from sketchloft.brep.precision import check_precise
from sketchloft.brep.solid import Solid
from sketchloft.brep.stack_blocks import Group, block_of, groups_of
from sketchloft.errors import ModelError
from sketchloft.stack import Stack

__all__ = ["stack_solid"]

TOLERANCES = (1e-6, 1e-5, 1e-7, 3e-6)
"""Distances up to which rims are taken for one, tried in this order."""


def stack_solid(stack: Stack) -> Solid:
    """Make the exact solid of a stack.

    Parameters
    ----------
    stack : Stack
        About 1 across.

    Returns
    -------
    Solid
        One closed shell, normals outwards. Revolved walls make cylinders, cones, spheres, tori and surfaces
        of revolution, swept ones planes, cylinders, cones, extrusions and B-splines, lofted ones B-splines.

    Raises
    ------
    ModelError
        If the runs do not make one solid; the message names the run or the break.

    Notes
    -----
    Neighbouring runs of coaxial revolved walls are one turned profile, whose pieces meet exactly. Other runs
    are made each on its own, of faces that share their edges, and joined where their sections meet.
    """
    size = _size(stack)
    groups = groups_of(stack.runs)
    for tolerance in TOLERANCES:
        solid = _attempt(stack, groups, size, tolerance)
        if solid is not None:
            return solid
    _explain(stack, groups, size)
    raise ModelError("the CAD kernel cannot join the runs to a valid solid; choose other breaks")


def _size(stack: Stack) -> float:
    """Diagonal of the box around the walls."""
    points = [wall.boundary(low, high, 64).points for run, low, high in stack.slabs() for wall in run.walls]
    return float(np.linalg.norm(np.ptp(np.concatenate(points), axis=0)))


def _attempt(stack: Stack, groups: Sequence[Group], size: float, tolerance: float) -> Solid | None:
    """The solid of some groups, or None if it is not valid."""
    try:
        solid = Solid(joined([block_of(stack, group, size) for group in groups], tolerance))
        check_closed(solid)
        check_precise(solid)
    except ModelError:
        return None
    except Exception as error:  # the kernel's own errors share no base
        if not type(error).__module__.startswith("OCP"):
            raise
        return None
    return solid


def _explain(stack: Stack, groups: Sequence[Group], size: float) -> None:
    """Raise what is wrong with the first run or break that makes no valid solid by itself."""
    check_walls(stack)
    for group in groups:
        if _attempt(stack, [group], size, TOLERANCES[0]) is None:
            low, high = stack.breaks[[*group]]
            check_pieces(joined([block_of(stack, group, size)]))
            raise ModelError(
                f"the walls between the heights {low:.4g} and {high:.4g} make no valid solid: a section "
                "there crosses itself or another one; choose another kind of wall"
            )
    check_pieces(joined([block_of(stack, group, size) for group in groups]))
    for i in range(1, len(groups)):
        if all(_attempt(stack, groups[i - 1 : i + 1], size, tolerance) is None for tolerance in TOLERANCES):
            raise ModelError(
                f"the runs do not join at the break at height {stack.breaks[groups[i][0]]:.4g}: their "
                "sections touch in a point or line, or nearly coincide; make them equal, or clearly different"
            )
