"""Points on the surface of a ball, a frustum or a prism, uniform by area."""

from __future__ import annotations

import math

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.sample.primitives import Ball, Frustum, Part, Prism, bounds, in_polygon

__all__ = ["area", "surface_samples"]


def area(part: Part) -> float:
    """Area of a part's whole surface, caps included."""
    return sum(_face_areas(part))


def surface_samples(part: Part, n: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Draw points on a part's surface, uniform by area.

    Parameters
    ----------
    part : Part
    n : int
    rng : numpy.random.Generator

    Returns
    -------
    points : (n, 3) float array
    normals : (n, 3) float array
        Unit normals, outwards.
    """
    areas = np.array(_face_areas(part))
    counts = rng.multinomial(n, areas / areas.sum())
    match part:
        case Ball(centre, radius):
            normals = rng.normal(size=(n, 3))
            normals /= np.linalg.norm(normals, axis=1, keepdims=True)
            return np.array(centre) + radius * normals, normals
        case Frustum():
            faces = [_frustum_face(part, face, count, rng) for face, count in enumerate(counts)]
        case Prism():
            faces = [_prism_face(part, face, count, rng) for face, count in enumerate(counts)]
    order = rng.permutation(n)
    points = np.concatenate([points for points, _ in faces])
    return points[order], np.concatenate([normals for _, normals in faces])[order]


def _face_areas(part: Part) -> list[float]:
    """Areas of the faces: bottom, top, then the sides."""
    match part:
        case Ball(_, radius):
            return [4 * math.pi * radius**2]
        case Frustum(_, bottom, top, height):
            slant = math.hypot(height, top - bottom)
            return [math.pi * bottom**2, math.pi * top**2, math.pi * (bottom + top) * slant]
        case Prism(outline, _, height):
            start = np.array(outline)
            end = np.roll(start, -1, axis=0)
            cap = float((start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]).sum()) / 2
            return [cap, cap, *(height * np.linalg.norm(end - start, axis=1)).tolist()]


def _frustum_face(part: Frustum, face: int, n: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    bottom, top, height = part.bottom_radius, part.top_radius, part.height
    angle = rng.uniform(0, 2 * math.pi, n)
    share = 1 - rng.random(n)  # in (0, 1], so that nothing below divides 0 by 0
    outward = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(n)])
    if face < 2:
        points = outward * ((bottom, top)[face] * np.sqrt(share))[:, None] + (0.0, 0.0, face * height)
        return points + part.centre, np.tile([0.0, 0.0, 2.0 * face - 1], (n, 1))
    # Height at which `share` of the side's area lies below, a quadratic's root in the form that
    # loses no digits when both radii are nearly equal.
    up = (bottom + top) * share / (bottom + np.sqrt(bottom**2 + (top**2 - bottom**2) * share))
    points = outward * (bottom + (top - bottom) * up)[:, None]
    points[:, 2] = up * height
    normals = (outward * height + (0.0, 0.0, bottom - top)) / math.hypot(height, top - bottom)
    return points + part.centre, normals


def _prism_face(part: Prism, face: int, n: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    if face < 2:
        points = np.empty((n, 3))
        points[:, :2] = _in_outline(part, n, rng)
        points[:, 2] = part.z0 + face * part.height
        return points, np.tile([0.0, 0.0, 2.0 * face - 1], (n, 1))
    start = np.array(part.outline[face - 2])
    along = np.array(part.outline[(face - 1) % len(part.outline)]) - start
    points = np.column_stack([start + rng.random((n, 1)) * along, part.z0 + part.height * rng.random(n)])
    return points, np.tile(np.array([along[1], -along[0], 0.0]) / np.linalg.norm(along), (n, 1))


def _in_outline(part: Prism, n: int, rng: np.random.Generator) -> Floats:
    """(n, 2) points uniform in a prism's outline, by rejection from its box."""
    low, high = (corner[:2] for corner in bounds(part))
    found, kept = 0, [np.empty((0, 2))]
    while found < n:
        tried = rng.uniform(low, high, (2 * (n - found) + 16, 2))
        kept.append(tried[in_polygon(part.outline, tried[:, 0], tried[:, 1])])
        found += len(kept[-1])
    return np.concatenate(kept)[:n]
