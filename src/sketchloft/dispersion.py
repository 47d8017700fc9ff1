"""Dispersion: how many points go together, as those of one stroke do.

The points of a stroke lie in a row, so that what they say is worth as much as a few of them. How densely
they lie in rows shows in how many neighbours a point has: within a small distance r there are points of other
strokes in proportion to the cube of r, and points of its own in proportion to r.
"""

from __future__ import annotations

import numpy as np

from sketchloft.cloud import Floats

__all__ = ["clump", "dispersion", "thinned"]

JUDGED = 0.07
"""Length, in sizes of the cloud, along which a stroke counts as one point where walls are judged."""
BLURRED = 0.02
"""The same where points are blurred."""
CENTRES = 4000
NEIGHBOURS = (3, 40)
"""Neighbours within the smallest and the largest distance that is looked at."""
RADII = 8
CERTAIN = 10.0
"""Neighbours in a row per size of the cloud that independent points hardly ever seem to have."""


def dispersion(points: Floats) -> float:
    """Points that go together where something as large as a section is judged, at least 1.

    Parameters
    ----------
    points : (n, 3) float array
        In a unit in which the cloud is about 1 across.

    Notes
    -----
    The mean number of neighbours within r (Ripley's K function, uncorrected at the edges) is fitted by
    ``a r**3 - b r**4 + c r``: neighbours of other strokes, those that are missing beside a wall, and those of
    the same stroke.

    References
    ----------
    B. D. Ripley, The second-order analysis of stationary point processes, J. Appl. Probab. 13 (1976)
    255-266.
    """
    from scipy.spatial import cKDTree  # noqa: PLC0415

    tree = cKDTree(points)
    centres = points[:: len(points) // CENTRES + 1]
    most = min(NEIGHBOURS[1], len(points) - 1) + 1
    far, _ = tree.query(centres, [NEIGHBOURS[0] + 1, most])
    low, high = np.maximum(np.median(far, axis=0), 1e-9).tolist()
    radii = np.geomspace(low, high, RADII)
    count = tree.count_neighbors(cKDTree(centres), radii) / len(centres) - 1
    weight = 1 / np.sqrt(count / len(centres) + (0.02 * count) ** 2 + 1e-12)
    rows = np.column_stack([radii**3, -(radii**4), radii]) * weight[:, None]
    in_row = float(np.linalg.lstsq(rows / np.abs(rows).max(axis=0), count * weight, rcond=None)[0][2])
    in_row /= float(np.abs(rows[:, 2]).max())
    return 1.0 if in_row < CERTAIN else 1.0 + in_row * JUDGED


def clump(together: float) -> float:
    """Points that go together where they are blurred, as `dispersion` says of a section."""
    return 1.0 + (together - 1.0) * BLURRED / JUDGED


def thinned(together: float, every: int) -> float:
    """Points that go together where one in so many is looked at."""
    return 1.0 + (together - 1.0) / every
