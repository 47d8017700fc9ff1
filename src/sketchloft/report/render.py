"""Render: the picture of a mesh as an array of pixels."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sketchloft.closed_mesh import welded
from sketchloft.cloud import Floats, Ints
from sketchloft.mesh import Mesh
from sketchloft.report.camera import Camera, axes, project
from sketchloft.report.normals import corner_normals
from sketchloft.report.raster import rasterise
from sketchloft.report.shading import barycentric, shade

__all__ = ["render"]

OVERSAMPLE = 2
"""A picture is drawn this many times larger and averaged, so that edges are smooth."""
MARGIN = 4
"""Empty pixels around a drawn surface."""


def render(
    mesh: Mesh,
    camera: Camera,
    paint: Callable[[Ints, Floats], Floats],
    *,
    crease: float,
    contrast: float,
    lines: float,
    pixels: int,
) -> tuple[Floats, tuple[float, float, float, float]]:
    """Draw a mesh into an array.

    Parameters
    ----------
    mesh : Mesh
    camera : Camera
    paint : callable
        Given triangles (k,) and weights of their corners (k, 3), the colours (k, 3) there.
    crease : float
        Edges sharper than this, in degrees, are drawn sharp.
    contrast, lines : float
        As in `shade`.
    pixels : int
        Resolution along the picture's longer side.

    Returns
    -------
    picture : (h, w, 4) float array
        Red, green, blue and opacity; the first row is the lowest.
    extent : (left, right, bottom, top)
        Where the picture lies in the camera's x and y, in the unit of the mesh.
    """
    corners, (left, bottom), scale = _fitted(project(camera, mesh.corners), pixels * OVERSAMPLE)
    height, width = (_whole(corners[:, :, i].max() + MARGIN) for i in (1, 0))
    raster = rasterise(corners, height, width)
    weights = barycentric(raster, corners)
    seen = raster.triangle[raster.triangle >= 0]
    normals = np.asarray(corner_normals(welded(mesh), crease) @ axes(camera).T)
    normals = _towards_eye(np.einsum("kc,kcd->kd", weights, normals[seen]), corners, seen)
    picture = shade(raster, normals, paint(seen, weights), contrast=contrast, lines=lines)
    return _averaged(picture), (left, left + width / scale, bottom, bottom + height / scale)


def _fitted(corners: Floats, pixels: int) -> tuple[Floats, Floats, float]:
    """Scale projected corners to a picture: in pixels, what lies at pixel (0, 0), and pixels per unit."""
    flat = corners[:, :, :2].reshape(-1, 2)
    low, extent = flat.min(axis=0), np.ptp(flat, axis=0).max()
    scale = float((pixels - 2 * MARGIN) / extent)
    origin = low - MARGIN / scale
    return (corners - np.append(origin, 0)) * scale, origin, scale


def _whole(length: float) -> int:
    return -int(-length // OVERSAMPLE) * OVERSAMPLE


def _towards_eye(normals: Floats, corners: Floats, seen: Ints) -> Floats:
    """Unit normals, turned over on triangles that show their back."""
    a, b, c = np.moveaxis(corners[:, :, :2], 1, 0)
    back = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    return np.where(back[seen][:, None], -unit, unit)


def _averaged(picture: Floats) -> Floats:
    """Average blocks of OVERSAMPLE by OVERSAMPLE pixels of an (h, w, 4) picture, colours by opacity."""
    height, width, _ = picture.shape
    blocks = picture.reshape(height // OVERSAMPLE, OVERSAMPLE, width // OVERSAMPLE, OVERSAMPLE, 4)
    opacity = np.einsum("iajb->ij", blocks[..., 3]) / OVERSAMPLE**2
    colours = np.einsum("iajbc,iajb->ijc", blocks[..., :3], blocks[..., 3]) / OVERSAMPLE**2
    return np.concatenate([colours / np.maximum(opacity, 1e-9)[..., None], opacity[..., None]], axis=2).clip(
        0, 1
    )
