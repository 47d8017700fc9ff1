"""3D alpha shape, by Open3D (MIT)."""

from __future__ import annotations

import numpy as np

from meshers.mesher import Mesher, Points, Triangles

__all__ = ["ALPHA_SHAPE"]


def _build(points: Points, spacing: float, *, radius: float) -> Triangles:
    import open3d  # noqa: PLC0415  an extra, and part of the time

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    mesh = open3d.geometry.TriangleMesh.create_from_point_cloud_alpha_shape(cloud, radius * spacing)
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles, dtype=np.int64)


# The small radii are the best for clouds with noise, the large ones for clean clouds.
ALPHA_SHAPE = Mesher(
    "3D alpha shape (Open3D)",
    "open3d",
    "open3d",
    tuple({"radius": radius} for radius in (1.7, 2.0, 2.6, 3.3, 4.0, 8.0)),
    _build,
)
