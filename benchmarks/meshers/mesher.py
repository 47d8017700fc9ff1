"""Mesher: a method that makes triangles of a cloud, with the settings that it is tried at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Mesher", "Points", "Triangles"]

Points: TypeAlias = NDArray[np.float64]
Triangles: TypeAlias = tuple[NDArray[np.float64], NDArray[np.int64]]


@dataclass(frozen=True)
class Mesher:
    """A method of others.

    Parameters
    ----------
    name : str
    module, distribution : str
        The package it needs, as it is imported and as it is installed.
    settings : tuple of dict
        Keyword arguments of `build`, of which the best for each cloud is shown. Lengths are in mean
        spacings of the points.
    build : callable
        Takes points (n, 3), the mean spacing, that is the cube root of the goal's volume per point, and a
        setting. Returns vertices (m, 3) and triangles (t, 3). The package is imported when it is called, for
        the time of a mesher is that of a process that does nothing else.
    """

    name: str
    module: str
    distribution: str
    settings: tuple[dict[str, float], ...]
    build: Callable[..., Triangles]
