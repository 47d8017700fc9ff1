"""Stage 3: locate the slice planes at the extrema of the distance to the central axis (paper, 4.4)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from sketchloft.alpha_shape import alpha_complex, boundary_facets, components
from sketchloft.cloud import Floats
from sketchloft.errors import StageError, UsageError
from sketchloft.probe_radius import small_probe_radius
from sketchloft.profile import chance_tolerance, local_extrema, on_ledge, profile_steps
from sketchloft.shapes.circle import algebraic_centre

__all__ = [
    "AxisDistance",
    "SlicePlanes",
    "SlicePlanesParams",
    "parse_per_slice",
    "slice_planes",
    "surface_points",
]

CentralAxis = Literal["mean", "least-squares"]

STAGE = "slice planes"
SAMPLE = 20_000
"""Points that the 3D alpha shape is made of; it only has to show the overall shape."""
BINS_PER_SLICE = 2
OUTER = 0.95
"""Quantile of the distances that stands for the section's reach: the inner parts of a section hardly
lower it, single stray points do not raise it."""
LEDGE = 0.02
"""A step is bracketed by two planes, this share of the mean slice thickness above and below it."""
MERGE = 10
"""An extremum within this many ledges of a step is the step."""
TAPER = 0.7
"""A body tapers where the quarter of a slice at its end reaches less than this share of the next plane's."""
FEWEST = 12
"""A slice with fewer points than this loses its plane to its neighbour."""


@dataclass(frozen=True)
class SlicePlanesParams:
    """How the slice planes are located.

    Parameters
    ----------
    per_slice : "auto" or int
        About how many points a slice holds; "auto" is 500 for 10,000 points and goes with the power
        2/3 of their number, so that slices get thinner as fast as contours get finer.
    central_axis : {"mean", "least-squares"}
        The axis through the mean of the surface points, or of the circle that fits them best.
    """

    per_slice: Literal["auto"] | int = "auto"
    central_axis: CentralAxis = "mean"


@dataclass(frozen=True)
class AxisDistance:
    """Distance to the central axis along it.

    Parameters
    ----------
    axis : (2,) float array
        Where the central axis crosses the slice planes.
    points : (m, 3) float array
        The surface points, found by the 3D alpha shape.
    distance : (m,) float array
        Their distance to the axis.
    heights, profile : (b,) float arrays
        Middle of every bin of heights, and the distance that its section reaches.
    """

    axis: Floats
    points: Floats
    distance: Floats
    heights: Floats
    profile: Floats


@dataclass(frozen=True)
class SlicePlanes:
    """Where the body is sliced.

    Parameters
    ----------
    heights : (k,) float array
        Rising heights of the planes; the first and the last are the ends of the body.
    key_heights : (e,) float array
        Those that are ends or local extrema of the distance.
    axis_distance : AxisDistance
        What they were located by.
    """

    heights: Floats
    key_heights: Floats
    axis_distance: AxisDistance


def parse_per_slice(text: str) -> Literal["auto"] | int:
    """Read "auto" or a number of points per slice.

    Raises
    ------
    UsageError
        If the text is neither, or the number is too small for a contour.
    """
    if text == "auto":
        return "auto"
    if text.isdecimal() and int(text) >= FEWEST:
        return int(text)
    raise UsageError(f"per slice: found '{text}', expected auto or a number of at least {FEWEST}")


def slice_planes(points: Floats, params: SlicePlanesParams) -> SlicePlanes:
    """Locate the slice planes of a body.

    Parameters
    ----------
    points : (n, 3) float array
        In the frame of the slicing direction, in canonical order.
    params : SlicePlanesParams

    Returns
    -------
    SlicePlanes

    Raises
    ------
    StageError
        If fewer than two planes can be placed.

    Notes
    -----
    The extrema are found iteratively: of all local extrema of the binned profile, the neighbouring
    pair that differs least is removed, until every pair left differs by more than the scatter of
    the bins explains. Each space between two extrema is then divided evenly, into as many slices as its
    points allow, and where the body tapers to a tip, further planes half-way to it follow as long as the
    last slice holds enough points. Where the profile is level nothing is left to remove and the slicing is
    even.
    """
    per_slice = _per_slice(len(points), params.per_slice)
    found = _axis_distance(points, params.central_axis, BINS_PER_SLICE * len(points) // per_slice)
    bottom, top = found.points[:, 2].min(), found.points[:, 2].max()
    tolerance = chance_tolerance(found.profile)
    jumps = profile_steps(found.profile, tolerance)
    extrema = [
        i for i in local_extrema(found.profile, tolerance) if not on_ledge(i, jumps, found.profile, tolerance)
    ]
    inner = found.heights[extrema]
    steps = np.array([_placed(step, points, found) for step in jumps])
    ledge = LEDGE * (top - bottom) / max(2, len(points) // per_slice)
    inner = inner[(np.abs(inner[:, None] - steps) > MERGE * ledge).all(axis=1)] if len(steps) else inner
    keys = np.sort(np.r_[bottom, inner, steps - ledge, steps + ledge, top])
    height = np.sort(points[:, 2])
    counts = np.diff(np.searchsorted(height, keys))
    spaces = [
        np.linspace(low, high, max(1, round(count / per_slice)) + 1)[:-1]
        for low, high, count in zip(keys[:-1], keys[1:], counts, strict=True)
    ]
    heights = _without_thin_slices(np.r_[np.concatenate(spaces), top], height)
    distance = np.linalg.norm(points[:, :2] - found.axis, axis=1)
    heights = _towards_tip(heights, points[:, 2], distance)
    heights = -_towards_tip(-heights[::-1], -points[:, 2], distance)[::-1]
    if len(heights) < 2:
        raise StageError(
            f"found {len(points)} points for slices of {per_slice}, expected at least two slices; lower "
            "the points per slice",
            stage=STAGE,
        )
    return SlicePlanes(heights, keys[np.isin(keys, heights)], found)


def surface_points(points: Floats) -> Floats:
    """Points that a small probe ball touches from outside (paper, section 4.4, step 2).

    Parameters
    ----------
    points : (n, 3) float array
        In canonical order; an even sample of 20,000 stands for a larger cloud.

    Returns
    -------
    (m, 3) float array
        Only of the largest connected part: stray points are no surface.
    """
    shape = alpha_complex(points[:: -(-len(points) // SAMPLE)])
    kept = shape.inside(small_probe_radius(shape))
    kept = kept[components(shape, kept) == 0]
    return shape.points[np.unique(boundary_facets(shape, kept))]


def _per_slice(count: int, asked: Literal["auto"] | int) -> int:
    if asked == "auto":
        return max(3 * FEWEST, round(500 * (count / 10_000) ** (2 / 3)))
    if asked > count / 2:
        raise StageError(
            f"found {asked} points per slice asked for, but the body has only {count} points and needs two "
            "slices; ask for fewer",
            stage=STAGE,
        )
    return asked


def _axis_distance(points: Floats, rule: CentralAxis, bins: int) -> AxisDistance:
    surface = surface_points(points)
    across, height = surface[:, :2], surface[:, 2]
    axis = across.mean(axis=0) if rule == "mean" else algebraic_centre(across)
    distance = np.linalg.norm(across - axis, axis=1)
    edges = np.linspace(height.min(), height.max(), max(8, bins) + 1)
    order = np.argsort(height, kind="stable")
    parts = [p for p in np.split(order, np.searchsorted(height[order], edges[1:-1])) if len(p)]
    heights = np.array([height[part].mean() for part in parts])
    # A fixed rank, not a quantile: at a flat end the points of the whole face fall into one bin.
    rank = max(2, round((1 - OUTER) * float(np.median([len(part) for part in parts]))))
    profile = np.array([np.sort(distance[part])[-min(rank, len(part))] for part in parts])
    return AxisDistance(axis, surface, distance, heights, profile)


def _placed(step: tuple[int, int], points: Floats, found: AxisDistance) -> float:
    """Height of a step: where the number of points beyond its ledge changes with the most evidence."""
    low, high = step
    ends = np.r_[points[:, 2].min(), (found.heights[1:] + found.heights[:-1]) / 2, points[:, 2].max()]
    bottom, top = ends[max(low - 1, 0)], ends[min(high + 2, len(ends) - 1)]
    inner, outer = np.sort(found.profile[[low, high]])
    beyond = np.linalg.norm(points[:, :2] - found.axis, axis=1) > inner + (outer - inner) / 4
    height = points[beyond, 2]
    height = np.sort(height[(height > bottom) & (height < top)])
    if found.profile[low] < found.profile[high]:
        return -_upper_end(-height[::-1], -top, -bottom)
    return _upper_end(height, bottom, top)


def _upper_end(values: Floats, bottom: float, top: float) -> float:
    """Where evenly spread values (m,) end within (bottom, top), two mean gaps beyond the last of them.

    Between any two values the spread may end and a thinner one of stray points begin; the likelihood
    of the counts on both sides decides.
    """
    count = np.arange(1, len(values) + 1)
    rest = len(values) - count
    below, above = values - bottom, np.maximum(top - values, 1e-12 * (top - bottom))
    evidence = count * np.log(count / below) + rest * np.log(np.maximum(rest, 1) / above)
    best = int(np.argmax(evidence))
    gap = 2 * below[best] / count[best]
    return float(min(values[best] + gap, values[best + 1] if rest[best] else top))


def _towards_tip(heights: Floats, height: Floats, distance: Floats) -> Floats:
    """Add planes half-way to the first one, again and again, while the body tapers to a tip there."""
    while True:
        gap = heights[1] - heights[0]
        above = (height - heights[0]) / gap
        last, next_ = above < 1 / 4, (above > 3 / 4) & (above < 5 / 4)
        if min(last.sum(), next_.sum()) < 2 * FEWEST:
            return heights
        if np.quantile(distance[last], OUTER) > TAPER * np.quantile(distance[next_], OUTER):
            return heights
        heights = np.r_[heights[0], heights[0] + gap / 2, heights[1:]]


def _without_thin_slices(heights: Floats, points: Floats) -> Floats:
    """Take out inner planes until every slice holds enough points."""
    while len(heights) > 2:
        count = np.diff(np.r_[0, np.searchsorted(points, (heights[1:] + heights[:-1]) / 2), len(points)])
        thin = int(np.argmin(count))
        if count[thin] >= FEWEST:
            break
        heights = np.delete(heights, min(max(thin, 1), len(heights) - 2))
    return heights
