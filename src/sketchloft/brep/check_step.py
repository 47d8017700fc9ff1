"""The check that a solid is still valid where others read it."""

from __future__ import annotations

from OCP.BRepCheck import BRepCheck_Analyzer

from sketchloft.brep import step_file
from sketchloft.brep.model import Model, NamedSolid
from sketchloft.brep.solid import Solid
from sketchloft.errors import InputError, ModelError

__all__ = ["check_step"]


def check_step(solid: Solid) -> None:
    """Prove that a solid is one valid solid again when it is read back from STEP.

    Notes
    -----
    A file holds no tolerances of edges and faces, so that readers make up their own: what is valid by a
    wide tolerance, as a ledge that is thinner than it, need not be to them.

    Raises
    ------
    ModelError
        If it is not.
    """
    model = Model((NamedSolid("solid", solid),))
    try:
        bodies = step_file.parsed(step_file.write(model, lambda: ())).bodies
    except InputError as error:
        raise ModelError(f"the solid does not survive STEP: it {error}") from None
    if len(bodies) != 1 or not BRepCheck_Analyzer(bodies[0].solid.shape).IsValid():
        raise ModelError(
            "the solid is valid, but not to those who read it from STEP; two of its walls nearly coincide: "
            "give a plan in which they do, or are farther apart"
        )
