"""Methods: how each of the compared methods makes a surface of a cloud (paper, sections 4 and 5.3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from sketchloft.alpha_shape import AlphaComplex
from sketchloft.cloud import CleanCloud
from sketchloft.compare.alpha_mesh import alpha_shape_mesh
from sketchloft.compare.octree import octree_cells
from sketchloft.compare.octree_boundary import boundary_cells, octree_boundary
from sketchloft.compare.void_cells import voids_inside
from sketchloft.mesh import Mesh

__all__ = ["LoftedModel", "MethodModel", "alpha_model", "lofted_model", "octree_model"]


@dataclass(frozen=True)
class LoftedModel:
    """What slice-and-loft made of the cloud.

    Parameters
    ----------
    mesh : Mesh
        Its surface as triangles, where the cloud is.
    faces : int
        Number of faces of the CAD model.
    """

    mesh: Mesh
    faces: int


@dataclass(frozen=True)
class MethodModel:
    """What a method made of the cloud.

    Parameters
    ----------
    mesh : Mesh
        Where the cloud is.
    faces : int
        Faces that describe the surface.
    remark : str
        What else there is to know.
    voids_inside : int, optional
        Void cubes inside, where the method has cubes.
    """

    mesh: Mesh
    faces: int
    remark: str = ""
    voids_inside: int | None = None


def lofted_model(loft: Callable[[float], LoftedModel], probe_radius: float) -> MethodModel:
    """Slice-and-loft with one probe radius for the 2D alpha shapes of all slices."""
    model = loft(probe_radius)
    return MethodModel(model.mesh, model.faces)


def alpha_model(cloud: CleanCloud, shape: AlphaComplex, probe_radius: float) -> MethodModel:
    """The 3D alpha shape, of the triangulated points of the cloud.

    Raises
    ------
    StageError
        If the probe leaves nothing.
    """
    found = alpha_shape_mesh(shape, probe_radius)
    remark = f"{found.share:.1%} of the points are on or in it" if found.share < 1 else ""
    if found.left_out:
        remark = f"largest of {found.left_out + 1} pieces, {remark}"
    mesh = Mesh(found.mesh.vertices + cloud.centre, found.mesh.triangles)
    return MethodModel(mesh, len(mesh.triangles), remark)


def octree_model(cloud: CleanCloud, depth: int | None) -> MethodModel:
    """The boundary of the octree, each face of a cube a face.

    Raises
    ------
    UsageError
        If the depth is out of range.
    """
    octree = octree_cells(cloud.points, depth)
    boundary = octree_boundary(octree)
    remark = (
        f"depth {octree.depth}, {len(octree.cells)} full cubes of {octree.edge:.3g} with "
        f"{octree.counts.mean():.1f} points each, {boundary_cells(octree).sum()} of them on the boundary"
    )
    mesh = Mesh(boundary.vertices + cloud.centre, boundary.triangles)
    return MethodModel(mesh, len(mesh.triangles) // 2, remark, voids_inside(octree))
