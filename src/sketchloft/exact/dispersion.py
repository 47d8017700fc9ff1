"""Dispersion: how many points go together, as those of one stroke do.

Independent points scatter over equal cells with a variance equal to their mean. The points of a stroke lie
in a row, so that their variance is larger; what they say of a wall is worth that many times less.
"""

from __future__ import annotations

import numpy as np

from sketchloft.exact.density import Density
from sketchloft.exact.level_set import LevelSet

__all__ = ["dispersion"]

BLOCK = 3
"""Cells of the grid along each edge of a block."""
FILLED = 0.8
CERTAIN = 1.06
"""Blocks of independent points hardly ever scatter more than this."""
EXTENT = 0.3
"""Size of what is judged, a run or its section, as a share of the cloud's."""


def dispersion(grid: LevelSet) -> float:
    """Points that go together where something as large as a section is judged, at least 1.

    Parameters
    ----------
    grid : LevelSet
        Of points in space, in a unit in which the cloud is about 1 across.

    Notes
    -----
    Variance over mean of the counts in blocks inside. A stroke crosses a block with a number of points
    in proportion to the block's width, so what is found for a block is carried over to `EXTENT`.
    """
    shape = np.array(grid.level.shape) // BLOCK
    whole = tuple(slice(0, n * BLOCK) for n in shape)
    split = [size for n in shape for size in (n, BLOCK)]
    count = grid.counts[whole].astype(float).reshape(split).sum(axis=(1, 3, 5)).ravel()
    filled = grid.inside[whole].reshape(split).mean(axis=(1, 3, 5)).ravel()
    full = np.flatnonzero(filled >= FILLED)
    if len(full) < 12:
        return 1.0
    at = np.column_stack(np.unravel_index(full, tuple(shape))).astype(float)
    at = (at - at.mean(axis=0)) / np.maximum(at.std(axis=0), 1e-9)
    terms = Density.terms(at, 10) * filled[full, None]
    mean = np.maximum(terms @ np.linalg.lstsq(terms, count[full], rcond=None)[0], 0.25 * count[full].mean())
    freedom = max(len(full) - terms.shape[1], 1)
    found = float((((count[full] - mean) ** 2) / mean).sum() / freedom)
    return 1.0 if found < CERTAIN else 1.0 + (found - 1.0) * EXTENT / (BLOCK * grid.cell)
