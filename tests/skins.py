"""Skins of known shape that the tests loft."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.surface import SkinSurface

__all__ = ["clamped", "cylinder", "moved", "prism", "wavy"]


def clamped(n: int, degree: int) -> Floats:
    """Uniform clamped knots on 0..1 for n poles."""
    return np.r_[np.zeros(degree), np.linspace(0, 1, n - degree + 1), np.ones(degree)]


def wavy(n_along: int = 8, n_around: int = 24, v_degree: int = 1) -> SkinSurface:
    """A smooth bulgy skin about 1 across, three-lobed, tangent-continuous over its seam."""
    angle = np.linspace(0, 2 * np.pi, n_around)
    z = np.linspace(0, 1, n_along)[:, None]
    radius = (0.3 + 0.1 * np.sin(5 * z)) * (1 + 0.1 * np.cos(3 * angle + z))
    poles = np.stack(np.broadcast_arrays(radius * np.cos(angle), radius * np.sin(angle), z), axis=2)
    poles[:, 0] = poles[:, -1] = (poles[:, 1] + poles[:, -2]) / 2
    return SkinSurface(poles, clamped(n_around, 3), clamped(n_along, v_degree), 3, v_degree)


def prism(
    corners: Floats, scales: Floats | None = None, heights: Floats | None = None, start: float = 0.0
) -> SkinSurface:
    """A polygon (k, 2), scaled from height to height, cubic with triple knots at its corners.

    `start` moves the seam from corner 0 along the first side, as a share of that side.
    """
    scales = np.ones(2) if scales is None else scales
    heights = np.linspace(0, 1, len(scales)) if heights is None else heights
    ring = np.asarray(corners, dtype=float)
    if start:
        ring = np.r_[[ring[0] + start * (ring[1] - ring[0])], ring[1:], ring[:1]]
    ends = np.roll(ring, -1, axis=0)
    sides = ring[:, None] + np.arange(3)[None, :, None] / 3 * (ends - ring)[:, None]
    outline = np.r_[sides.reshape(-1, 2), ring[:1]]
    flat = outline * scales[:, None, None]
    z = np.broadcast_to(heights[:, None, None], (*flat.shape[:2], 1))
    u_knots = np.r_[0, np.repeat(np.arange(len(ring) + 1), 3), len(ring)].astype(float)
    v_knots = np.r_[heights[0], heights, heights[-1]].astype(float)
    return SkinSurface(np.concatenate([flat, z], axis=2), u_knots, v_knots, 3, 1)


def cylinder(radius: float = 1.0, height: float = 2.0) -> SkinSurface:
    """An exact cylinder: rational quadratic around, double knots at the quarters."""
    square = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]) * radius
    poles = np.stack([np.c_[square, np.full(9, z)] for z in (0.0, height)])
    weights = np.tile(np.r_[1, np.tile([np.sqrt(0.5), 1], 4)], (2, 1))
    u_knots = np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], dtype=float)
    return SkinSurface(poles, u_knots, np.array([0.0, 0, 1, 1]), 2, 1, weights)


def moved(skin: SkinSurface, by: tuple[float, float, float]) -> SkinSurface:
    """The same skin elsewhere."""
    return SkinSurface(skin.poles + np.array(by), skin.u_knots, skin.v_knots, skin.u_degree, skin.v_degree)
