"""Shading: what a seen surface looks like under soft light, with thin lines at its outlines and creases."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.report.occlusion import occlusion
from sketchloft.report.raster import Raster

__all__ = ["barycentric", "line_mask", "shade"]

KEY_LIGHT = np.array([-0.42, 0.55, 0.72]) / np.linalg.norm([-0.42, 0.55, 0.72])
"""Direction towards the main light in the picture's axes: upper left, before the thing."""
AMBIENT, KEY, SKY = 0.46, 0.45, 0.12
"""How much light comes from everywhere, from the main light, and from above."""
WRAP = 0.35
"""How far the main light reaches round a thing, which makes it soft."""
GLOSS, GLOSS_EXPONENT = 0.07, 20.0
COARSE = 2
HOLLOW = 0.8
"""How much darker a point is that sees nothing of the sky."""


def barycentric(raster: Raster, corners: Floats) -> Floats:
    """Where on its triangle each seen pixel lies.

    Parameters
    ----------
    raster : Raster
    corners : (t, 3, 3) float array
        The corners that were rasterised.

    Returns
    -------
    (k, 3) float array
        Weights of the three corners, not negative, sum 1, for the k pixels that see a triangle,
        row by row.
    """
    row, column = np.nonzero(raster.triangle >= 0)
    a, b, c = np.moveaxis(corners[raster.triangle[row, column], :, :2], 1, 0)
    p = np.column_stack([column, row]) + 0.5

    def cross(u: Floats, v: Floats) -> Floats:
        return np.asarray(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])

    weights = np.stack([cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p)], axis=1)
    weights *= np.where(weights.sum(axis=1, keepdims=True) < 0, -1.0, 1.0)
    weights = np.maximum(weights, 0) + np.finfo(float).tiny
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))


def shade(
    raster: Raster, normals: Floats, colours: Floats, *, contrast: float = 1.0, lines: float = 0.55
) -> Floats:
    """Light the pixels that see a surface.

    Parameters
    ----------
    raster : Raster
    normals : (k, 3) float array
        Unit normals in the picture's axes at the k seen pixels, towards the eye.
    colours : (k, 3) float array
        Red, green and blue of the surface there, from 0 to 1.
    contrast : float
        How much light and shadow change the colours, from 0 (not at all) to 1.
    lines : float
        How dark outlines and creases are drawn, from 0 (not) to 1 (black).

    Returns
    -------
    (h, w, 4) float array
        Red, green, blue and opacity, 0 where nothing is seen.
    """
    seen = raster.triangle >= 0
    field = np.zeros((*seen.shape, 3))
    field[seen] = normals
    key = np.maximum(normals @ KEY_LIGHT + WRAP, 0) / (1 + WRAP)
    light = AMBIENT + KEY * key + SKY * (0.5 + 0.5 * normals[:, 1])
    light *= 1 - HOLLOW * _hidden_sky(raster.depth, field)[seen]
    halfway = KEY_LIGHT + np.array([0.0, 0.0, 1.0])
    gloss = GLOSS * np.maximum(normals @ (halfway / np.linalg.norm(halfway)), 0) ** GLOSS_EXPONENT
    lit = colours * (1 + contrast * (light - 1))[:, None] + contrast * gloss[:, None]
    lit *= 1 - lines * line_mask(raster, field)[seen][:, None]
    picture = np.zeros((*seen.shape, 4))
    picture[seen, :3] = np.clip(lit, 0, 1)
    picture[seen, 3] = 1
    return picture


def line_mask(raster: Raster, field: Floats, crease: float = 30.0) -> Floats:
    """(h, w) 1 on outlines, at jumps of depth and at creases (degrees) of normals (h, w, 3), else 0."""
    seen = raster.triangle >= 0
    depth = np.where(seen, raster.depth, 0)
    jump = 0.015 * np.hypot(*seen.shape)
    mask = np.zeros(seen.shape, dtype=bool)
    for here, there in (
        (np.s_[:-1, :], np.s_[1:, :]),
        (np.s_[:, :-1], np.s_[:, 1:]),
    ):
        edge = seen[here] != seen[there]
        edge |= np.abs(depth[here] - depth[there]) > jump
        edge |= np.einsum("ijk,ijk->ij", field[here], field[there]) < np.cos(np.radians(crease))
        edge &= seen[here] | seen[there]
        mask[here] |= edge
        mask[there] |= edge
    return mask.astype(float)


def _hidden_sky(depth: Floats, field: Floats) -> Floats:
    """`occlusion` at a quarter of the pixels, for speed: it varies slowly."""
    rough = occlusion(depth[::COARSE, ::COARSE] / COARSE, field[::COARSE, ::COARSE])
    return rough.repeat(COARSE, axis=0).repeat(COARSE, axis=1)[: depth.shape[0], : depth.shape[1]]
