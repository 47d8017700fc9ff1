"""Slice-and-loft as one of the methods that are compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from sketchloft.cloud import PointCloud
from sketchloft.compare.methods import LoftedModel
from sketchloft.edge_points import EdgePointsParams
from sketchloft.mesh import concatenated
from sketchloft.pipeline import Params, reconstruct
from sketchloft.shapes.choice import ShapesParams

__all__ = ["slice_and_loft"]


def slice_and_loft(cloud: PointCloud, params: Params) -> Callable[[float], LoftedModel]:
    """Model of a cloud as a function of the probe radius.

    Parameters
    ----------
    cloud : PointCloud
    params : Params
        The method is the paper's; its probe radius is replaced, and shapes are not recognised, so that
        nothing but the probe radius makes the difference (paper, section 5.3).

    Returns
    -------
    callable
        From a radius in the unit of the cloud to the model.
    """

    def model(radius: float) -> LoftedModel:
        from sketchloft.brep.tessellate import tessellate  # noqa: PLC0415  the kernel only when called

        asked = replace(
            params, method="paper", edge_points=EdgePointsParams(radius), shapes=ShapesParams("off")
        )
        bodies = reconstruct(cloud, asked).bodies
        faces = sum(sum(body.facts.faces.values()) for body in bodies)
        return LoftedModel(concatenated([tessellate(body.solid) for body in bodies]), faces)

    return model
