"""Build: a stack made a solid, proved and placed where the cloud is."""

from __future__ import annotations

from dataclasses import replace

from sketchloft.brep.bounds import bounds_of
from sketchloft.brep.check_stack import check_stack
from sketchloft.brep.check_step import check_step
from sketchloft.brep.facts import SolidFacts
from sketchloft.brep.place import placed
from sketchloft.brep.solid import Solid
from sketchloft.brep.stack_solid import stack_solid
from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.stack import Stack

__all__ = ["built_stack"]


def built_stack(stack: Stack, origin: Floats, axes: Floats, scale: float = 1.0) -> tuple[Solid, SolidFacts]:
    """Make a solid of a stack and place it.

    Parameters
    ----------
    stack : Stack
        About 1 across, since the tolerances of the kernel are absolute.
    origin : (3,) float array
        Where the origin of its frame is.
    axes : (3, 3) float array
        The axes of that frame, in rows.
    scale : float
        Length of the frame's unit.

    Returns
    -------
    Solid
        Placed: every point p of the stack is at `origin + scale * p @ axes`.
    SolidFacts
        Of the placed solid.

    Raises
    ------
    ModelError
        If the solid cannot be made, or fails a check.
    """
    try:
        solid = stack_solid(stack)
        facts = check_stack(solid, stack)
    except ModelError as error:
        raise ModelError(f"solid: {error}") from None
    except Exception as error:  # the kernel's own errors share no base
        if not type(error).__module__.startswith("OCP"):
            raise
        raise ModelError(
            f"solid: the CAD kernel could not make these walls ({type(error).__name__})"
        ) from error
    there = placed(solid, scale, origin, axes)
    check_step(there)
    facts = replace(
        facts, volume=facts.volume * scale**3, area=facts.area * scale**2, bounds=bounds_of(there.shape)
    )
    return there, facts
