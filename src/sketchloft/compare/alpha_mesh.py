"""Alpha mesh: the surface of a 3D alpha shape, which slice-and-loft is compared with (paper, section 5.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.alpha_shape import AlphaComplex, boundary_facets, components
from sketchloft.errors import StageError
from sketchloft.mesh import Mesh
from sketchloft.probe_radius import small_probe_radius

__all__ = ["AlphaMesh", "alpha_shape_mesh"]


@dataclass(frozen=True)
class AlphaMesh:
    """The largest piece of a 3D alpha shape.

    Parameters
    ----------
    mesh : Mesh
        Its surface. Every edge is run as often one way as the other, but where the piece touches
        itself along an edge or in a point the surface is not a manifold.
    left_out : int
        How many smaller pieces there are.
    share : float
        Share of the points within or on the piece.
    """

    mesh: Mesh
    left_out: int
    share: float


def alpha_shape_mesh(shape: AlphaComplex, probe_radius: float) -> AlphaMesh:
    """Surface of the largest piece of the alpha shape, with the holes and cavities that the probe finds.

    Parameters
    ----------
    shape : AlphaComplex
        Of points in space; serves any number of radii.
    probe_radius : float
        In the unit of the points. Infinity gives the convex hull.

    Returns
    -------
    AlphaMesh

    Raises
    ------
    StageError
        If the probe fits through everywhere, so that nothing is left.

    References
    ----------
    H. Edelsbrunner, E. P. Mücke, Three-dimensional alpha shapes, ACM Transactions on Graphics
    13(1), 1994.
    """
    kept = shape.inside(probe_radius)
    if len(kept) == 0:
        raise StageError(
            f"a probe of radius {probe_radius:.4g} leaves nothing of the {len(shape.points)} points; use a "
            f"larger radius, {small_probe_radius(shape):.4g} say",
            stage="3D alpha shape",
        )
    label = components(shape, kept)
    piece = kept[label == 0]
    held = np.zeros(len(shape.points), dtype=bool)
    held[shape.simplices[piece]] = True
    used, corners = np.unique(boundary_facets(shape, piece), return_inverse=True)
    return AlphaMesh(Mesh(shape.points[used], corners.reshape(-1, 3)), int(label.max()), float(held.mean()))
