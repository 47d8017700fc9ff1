"""Raster: which triangle each pixel of a picture sees, by a depth buffer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketchloft.cloud import Floats, Ints

__all__ = ["Raster", "rasterise"]

CHUNK = 1 << 20
"""How many pixels of triangles are held at once, which bounds the memory."""
OVERLAP = 1e-6
"""How far triangles are grown, in pixels, so that neighbours leave no gap between them."""


@dataclass(frozen=True)
class Raster:
    """What a picture of h by w pixels sees.

    Parameters
    ----------
    triangle : (h, w) int array
        Row of the triangle that is nearest to the eye, -1 where there is none.
    depth : (h, w) float array
        Its z there, larger towards the eye, -inf where there is none.
    """

    triangle: Ints
    depth: Floats


def rasterise(corners: Floats, height: int, width: int) -> Raster:
    """Find the nearest triangle at the centre of each pixel.

    Parameters
    ----------
    corners : (t, 3, 3) float array
        Corners of triangles: x and y in pixels (the pixel in row i, column j has its centre at
        x = j + 0.5, y = i + 0.5), z towards the eye.
    height, width : int
        Size of the picture in pixels.

    Returns
    -------
    Raster

    Notes
    -----
    Each triangle is cut into its rows of pixels, each row into pixels; all triangles at once.
    """
    depth = np.full(height * width, -np.inf)
    seen = np.full(height * width, -1, dtype=np.intp)
    slope = _depth_slopes(corners)
    deepest, highest = corners[:, :, 2].min(axis=1), corners[:, :, 2].max(axis=1)
    triangle, row, first, count = _spans(corners, height, width)
    ends = np.cumsum(count)
    start = 0
    while start < len(count):
        done = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, done + CHUNK, side="right")))
        part = slice(start, stop)
        owner = np.repeat(triangle[part], count[part])
        step = np.arange(len(owner)) - np.repeat(ends[part] - count[part] - done, count[part])
        column = np.repeat(first[part], count[part]) + step
        line = np.repeat(row[part], count[part])
        z = slope[owner, 0] + slope[owner, 1] * (column + 0.5) + slope[owner, 2] * (line + 0.5)
        z = np.clip(z, deepest[owner], highest[owner])
        pixel = line * width + column
        np.maximum.at(depth, pixel, z)
        nearest = z == depth[pixel]
        seen[pixel[nearest]] = owner[nearest]
        start = stop
    return Raster(seen.reshape(height, width), depth.reshape(height, width))


def _spans(corners: Floats, height: int, width: int) -> tuple[Ints, Ints, Ints, Ints]:
    """Cut triangles into rows: triangle, row, first column and number of columns of each, all (s,)."""
    y = corners[:, :, 1]
    low = np.clip(np.ceil(y.min(axis=1) - 0.5 - OVERLAP), 0, height).astype(np.intp)
    high = np.clip(np.floor(y.max(axis=1) - 0.5 + OVERLAP), -1, height - 1).astype(np.intp)
    rows = np.maximum(high - low + 1, 0)
    triangle = np.repeat(np.arange(len(corners)), rows)
    row = np.arange(len(triangle)) - np.repeat(np.cumsum(rows) - rows, rows) + low[triangle]
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        (xa, ya), (xb, yb) = corners[triangle, a, :2].T, corners[triangle, b, :2].T
        rise = yb - ya
        share = (row + 0.5 - ya) / np.where(rise == 0, np.inf, rise)
        x = xa + np.clip(share, 0, 1) * (xb - xa)
        reached = (np.abs(share - 0.5) <= 0.5 + OVERLAP) & (rise != 0)
        left = np.where(reached, np.minimum(left, x), left)
        right = np.where(reached, np.maximum(right, x), right)
    first = np.ceil(np.clip(left - 0.5 - OVERLAP, 0, width)).astype(np.intp)
    last = np.floor(np.clip(right - 0.5 + OVERLAP, -1, width - 1)).astype(np.intp)
    count = np.maximum(last - first + 1, 0)
    hit = count > 0
    return triangle[hit], row[hit], first[hit], count[hit]


def _depth_slopes(corners: Floats) -> Floats:
    """(t, 3) coefficients c of each triangle's plane z = c0 + c1 x + c2 y; level where it is seen edge-on."""
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    edge_on = np.abs(normal[:, 2]) <= 1e-12 * np.linalg.norm(normal, axis=1)
    slopes = -normal[:, :2] / np.where(edge_on, np.inf, normal[:, 2])[:, None]
    level = np.where(edge_on, corners[:, :, 2].mean(axis=1), a[:, 2] - (slopes * a[:, :2]).sum(axis=1))
    return np.column_stack([level, slopes])
