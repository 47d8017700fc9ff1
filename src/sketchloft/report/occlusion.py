"""Occlusion: how much of the sky above each point of a picture its surroundings take away."""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["occlusion"]

SAMPLES = 24
REACH = 0.06
"""How far surroundings count, in diagonals of the picture."""
BIAS = 0.15
"""Sine of the angle above the tangent plane below which surroundings take nothing away."""


def occlusion(depth: Floats, normals: Floats) -> Floats:
    """Share of the sky that is hidden.

    Parameters
    ----------
    depth : (h, w) float array
        In pixels, larger towards the eye, -inf where nothing is seen.
    normals : (h, w, 3) float array
        Unit normals: x along columns, y along rows, z towards the eye.

    Returns
    -------
    (h, w) float array
        From 0 to 1.

    Notes
    -----
    Ambient occlusion in screen space: neighbours on a spiral take away as much as they stand
    above the tangent plane, less if they are far in depth.

    References
    ----------
    Bavoil, Sainz, "Screen space ambient occlusion", NVIDIA Developer Information, 2008.
    """
    from scipy.ndimage import gaussian_filter  # noqa: PLC0415  half a second that only pictures need

    reach = REACH * float(np.hypot(*depth.shape))
    behind = depth[np.isfinite(depth)].min(initial=0.0) - 2 * reach
    depth = np.maximum(depth, behind)
    total = np.zeros(depth.shape)
    # A golden-angle spiral, denser towards its middle, covers the disc without a visible pattern.
    share = (np.arange(SAMPLES) + 0.5) / SAMPLES
    angle = np.arange(SAMPLES) * np.pi * (3 - np.sqrt(5))
    steps = np.round(reach * share[:, None] * np.stack([np.sin(angle), np.cos(angle)], axis=1)).astype(int)
    for down, right in steps[np.any(steps != 0, axis=1)]:
        (top, top_other), (left, left_other) = _overlap(down), _overlap(right)
        at, other = (top, left), (top_other, left_other)
        rise = depth[other] - depth[at]
        length = np.sqrt(down**2 + right**2 + rise**2)
        nx, ny, nz = np.moveaxis(normals[at], -1, 0)
        sine = (nx * right + ny * down + nz * rise) / length
        near = np.clip(2 - length / reach, 0, 1)
        total[at] += near * np.clip((sine - BIAS) / (1 - BIAS), 0, 1)
    return np.asarray(np.clip(gaussian_filter(2 * total / SAMPLES, 0.02 * reach + 1), 0, 1))


def _overlap(step: int) -> tuple[slice, slice]:
    """Where along an axis both i and i + step exist: the slices of i and of i + step."""
    if step >= 0:
        return slice(None, -step or None), slice(step, None)
    return slice(-step, None), slice(None, step)
