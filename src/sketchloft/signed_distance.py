"""Signed distance: how far points lie outside or inside a closed mesh."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.mesh import Mesh

__all__ = ["signed_distance"]


def signed_distance(points: Floats, mesh: Mesh) -> Floats:
    """(n,) distance of (n, 3) points from a closed mesh, + outside, - inside.

    References
    ----------
    Barill, Dickson, Schmidt, Levin, Jacobson, "Fast winding numbers for soups and clouds",
    ACM Transactions on Graphics 37(4), 2018.
    """
    import igl  # noqa: PLC0415  0.3 s that only measuring needs

    # igl's own signed distance multiplies by 1 - 2 w, which is up to a percent off +-1, so take only
    # the sign of that. Its winding number is in single precision: hence the mesh's own centre and size.
    centre, size = mesh.vertices.mean(axis=0), mesh.size
    at = np.ascontiguousarray((points - centre) / size)
    vertices = np.ascontiguousarray((mesh.vertices - centre) / size)
    triangles = np.ascontiguousarray(mesh.triangles, dtype=np.int64)
    square, _, _ = igl.point_mesh_squared_distance(at, vertices, triangles)
    outside = igl.fast_winding_number(vertices, triangles, at) < 0.5
    return np.where(outside, size, -size) * np.sqrt(square)
