"""Stage 5: extract the edge points of every slice with a 2D alpha shape (paper, section 4.6)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from sketchloft.alpha_shape import AlphaComplex, alpha_complex
from sketchloft.cloud import Floats
from sketchloft.errors import StageError, UsageError
from sketchloft.outer_contour import Contour, outer_contour
from sketchloft.probe_radius import small_probe_radius
from sketchloft.ring import ring_area, ring_centre, ring_depth, ring_hull, ring_length
from sketchloft.work_points import WorkedSlice

__all__ = ["EdgePoints", "EdgePointsParams", "edge_points", "parse_probe_radius"]

ProbeRadius = Literal["auto"] | float | tuple[float, ...]

STAGE = "edge points"
WINDOW = 2
"""Slices on either side that decide together with a slice whether its section is convex."""
FEWEST_SHARE = 0.5
"""A contour that surrounds a smaller share of the slice's points has lost the section."""
GAP = 0.8
"""Empty area along a contour per edge point and point density, for a small probe; 1 for a hull (Efron)."""
STEP, STEPS = 4.0, 4
"""Factor between the probe radii that are tried, and their number on either side of the rule's."""
FINE_STEP, FINE_STEPS = 1.3, 8
"""The same for a section that is filled but has holes."""
WHOLE = 0.97
"""Share of the points that a section without holes holds at least; the others are strays."""
SKIN = 0.65
"""Sections whose alpha shape fills a smaller share than this of their outer contour are skins."""
ACROSS = 1.3
"""Points side by side across the mean width of what may be a section; a skin that is open is thinner."""
SHALLOW = 0.5
"""Points less than this share as deep within their contours as evenly spread ones form a skin."""
DEPTH_SAMPLE = 500
"""Points and triangles of a slice that are asked how deep they lie."""
OPEN = 0.5
"""A contour of less than this share of its hull's area runs around inside an open skin; its hull is taken."""
CLOSED = 0.9
"""A skin is closed where its contour encloses this share of what it does where the skin is emptiest."""


@dataclass(frozen=True)
class EdgePointsParams:
    """How the edge points are found.

    Parameters
    ----------
    probe_radius : "auto", float or tuple of float
        Radius of the probe that the alpha shape is rolled around with, in the unit of the cloud: chosen
        by rule, one for all slices, or one for each. Infinity gives the convex hull.
    """

    probe_radius: ProbeRadius = "auto"


@dataclass(frozen=True)
class EdgePoints:
    """The ordered edge points of one slice.

    Parameters
    ----------
    height : float
        Of the slice plane.
    probe_radius : float
    points : (m, 2) float array
        The outer contour, counter-clockwise, the first point not repeated.
    area : float
        Area of the section that the points account for: that of the contour and, where the cloud fills
        the section, of the empty strip to be expected between the outermost points and the wall.
    left_out : int
        Number of other contours in the slice: holes and islands.
    filled : bool
        Whether the points fill the sections of the body, so that gaps along the wall are to be expected.
    """

    height: float
    probe_radius: float
    points: Floats
    area: float
    left_out: int
    filled: bool

    @property
    def centre(self) -> Floats:
        """(2,) centroid of the area that the contour encloses."""
        return ring_centre(self.points)


def parse_probe_radius(text: str) -> ProbeRadius:
    """Read "auto", a number, "inf", or the name of a file with one radius per slice.

    Raises
    ------
    UsageError
        If the text is none of these, or a radius is not positive.
    """
    if text == "auto":
        return "auto"
    file = Path(text)
    words = [text]
    if file.is_file():
        try:
            words = file.read_text(encoding="utf-8").split()
        except (OSError, UnicodeDecodeError) as error:
            raise UsageError(f"probe radius: {text} cannot be read as text: {error}") from None
    try:
        radii = tuple(float(word) for word in words)
    except ValueError:
        raise UsageError(
            f"probe radius: found '{text}', expected auto, a number, inf, or a file with a number per slice"
        ) from None
    if not radii or not all(radius > 0 for radius in radii):
        raise UsageError(f"probe radius: found '{text}', expected positive numbers")
    return radii if file.is_file() else radii[0]


def edge_points(slices: Sequence[WorkedSlice], params: EdgePointsParams) -> tuple[EdgePoints, ...]:
    """Extract the outer contour of every slice.

    Parameters
    ----------
    slices : sequence of WorkedSlice
    params : EdgePointsParams

    Returns
    -------
    tuple of EdgePoints

    Raises
    ------
    StageError
        If the points of a slice are on a line, or a probe radius is so small that nothing stays.
    UsageError
        If the number of radii is not the number of slices, or a radius is not positive.

    Notes
    -----
    The automatic probe radius is the smallest that is not expected to fall into the section
    (`small_probe_radius`), or the smallest larger one that leaves no hole. Where the cloud covers the
    surface only, it is the smallest of that radius and its multiples by 4 that closes the skin. Where a
    filled section is convex it is infinite. Convexity is
    judged by area: by Efron's identity a convex section that holds n points, N of them on the hull of
    area A, has an area of about A n / (n - N). Where that is no larger than what the small probe accounts
    for, by twice the standard error over a slice and its four neighbours, nothing speaks against the hull,
    and a hull follows the wall more evenly.

    References
    ----------
    B. Efron, The convex hull of a random set of points, Biometrika 52, 1965.
    """
    shapes = [_triangulated(worked.points, index) for index, worked in enumerate(slices)]
    if params.probe_radius == "auto":
        radii, contours = _automatic(shapes)
    else:
        radii = _given(params.probe_radius, len(slices))
        contours = [_contour(s, r, i) for i, (s, r) in enumerate(zip(shapes, radii, strict=True))]
    filled = not _is_skin(shapes, contours)
    return tuple(
        EdgePoints(
            worked.height,
            float(radius),
            contour.points,
            _accounted(contour, len(worked.points), float(radius)) if filled else contour.area,
            contour.left_out,
            filled,
        )
        for worked, radius, contour in zip(slices, radii, contours, strict=True)
    )


def _triangulated(points: Floats, index: int) -> AlphaComplex:
    from scipy.spatial import QhullError  # noqa: PLC0415  loaded with the triangulation anyway

    try:
        return alpha_complex(points)
    except QhullError:
        raise StageError(
            f"the {len(points)} points of the slice lie on one line, a contour needs an area; use more "
            "points per slice or another slicing direction",
            stage=STAGE,
            slice_index=index,
        ) from None


def _given(radius: float | tuple[float, ...], count: int) -> Floats:
    radii = np.atleast_1d(np.asarray(radius, dtype=np.float64))
    if len(radii) not in (1, count):
        raise UsageError(
            f"probe radius: found {len(radii)} radii for {count} slices; give one for all or one per slice"
        )
    if not (radii > 0).all():
        raise UsageError(f"probe radius: found {radii.min():g}, expected a positive number or 'inf'")
    return np.broadcast_to(radii, count)


def _automatic(shapes: Sequence[AlphaComplex]) -> tuple[Floats, list[Contour]]:
    found = [_smallest(shape, index) for index, shape in enumerate(shapes)]
    small, close = np.array([radius for radius, _ in found]), [contour for _, contour in found]
    # Hulls of the contours, not of the slices: strays beside the section stay out.
    hulls = [replace(contour, points=ring_hull(contour.points)) for contour in close]
    count = np.array([len(shape.points) for shape in shapes])
    on_close = np.array([len(contour.points) for contour in close])
    on_hull = np.array([len(contour.points) for contour in hulls])
    area = np.array([contour.area for contour in close])
    outer_area = np.array([contour.area for contour in hulls])
    excess = outer_area * count / (count - on_hull).clip(1)
    excess -= area * count / (count - on_close).clip(1)
    variance = area**2 * on_close / count**2
    near = np.abs(np.subtract.outer(np.arange(len(shapes)), np.arange(len(shapes)))) <= WINDOW
    if _is_skin(shapes, close):
        convex = area < OPEN * outer_area
    else:
        convex = near @ excess < 2 * np.sqrt(near @ variance)
    contours = [
        hull if all_round else inner for hull, inner, all_round in zip(hulls, close, convex, strict=True)
    ]
    return np.where(convex, np.inf, small), contours


def _smallest(shape: AlphaComplex, index: int) -> tuple[float, Contour]:
    """Small probe radius, larger where the section is a skin with gaps that the probe would fall through."""
    small = small_probe_radius(shape)
    first = outer_contour(shape, small)
    if first is not None and _is_whole(first) and _is_wide(first):
        return small, first
    tried = [(small * STEP**k, outer_contour(shape, small * STEP**k)) for k in range(-STEPS, STEPS)]
    whole = [(radius, found) for radius, found in tried if found is not None and _is_section(found, shape)]
    if not whole:
        return np.inf, _contour(shape, np.inf, index)
    emptiest = min((found for _, found in whole), key=lambda found: found.filled)
    if emptiest.filled > SKIN:
        return _without_holes(shape, small) or whole[-1]
    return next((radius, found) for radius, found in whole if found.area >= CLOSED * emptiest.area)


def _is_whole(contour: Contour) -> bool:
    """Whether a contour surrounds all but strays, without a hole."""
    return contour.filled > 1 - 1e-9 and contour.share > WHOLE


def _is_wide(contour: Contour) -> bool:
    """Whether a contour takes so much of its hull that it does not run around inside an open skin."""
    return contour.area >= OPEN * ring_area(ring_hull(contour.points))


def _without_holes(shape: AlphaComplex, small: float) -> tuple[float, Contour] | None:
    """Smallest radius, from the rule's up, that leaves no hole; the rule's own where a hole stays.

    An evenly random section has none to begin with, a scribbled one has many, and fjords as deep.
    """
    first = None
    for k in range(FINE_STEPS):
        found = outer_contour(shape, small * FINE_STEP**k)
        if found is not None and _is_section(found, shape):
            first = first or (small * FINE_STEP**k, found)
            if _is_whole(found):
                return small * FINE_STEP**k, found
    return first


def _is_section(contour: Contour, shape: AlphaComplex) -> bool:
    """Whether a contour surrounds an area with most of the points, not the thin band of an open skin."""
    width = 2 * contour.area / ring_length(contour.points)
    across = np.sqrt(2 * len(shape.points) * width / ring_length(contour.points))
    return contour.share >= FEWEST_SHARE and bool(across >= ACROSS)


def _contour(shape: AlphaComplex, radius: float, index: int) -> Contour:
    found = outer_contour(shape, float(radius))
    if found is None or found.share < FEWEST_SHARE:
        share = 0.0 if found is None else found.share
        raise StageError(
            f"a probe of radius {radius:.4g} leaves {share:.0%} of the {len(shape.points)} points in one "
            f"piece, expected at least {FEWEST_SHARE:.0%}; use a larger radius, "
            f"{small_probe_radius(shape):.4g} say, or 'auto'",
            stage=STAGE,
            slice_index=index,
        )
    return found


def _is_skin(shapes: Sequence[AlphaComplex], contours: Sequence[Contour]) -> bool:
    """Whether the sections are empty inside: by area, or because the points do not lie deep in them."""
    area = np.array([contour.area for contour in contours])
    if np.array([contour.filled for contour in contours]) @ area < SKIN * area.sum():
        return True
    depths = np.array([_depths(s, c) for s, c in zip(shapes, contours, strict=True)])
    return bool(depths[:, 0] @ area < SHALLOW * (depths[:, 1] @ area))


def _depths(shape: AlphaComplex, contour: Contour) -> tuple[float, float]:
    """Mean depth of the points within the contour, and of points that would fill it evenly."""
    points = shape.points[:: -(-len(shape.points) // DEPTH_SAMPLE)]
    triangles = slice(None, None, -(-len(shape.simplices) // DEPTH_SAMPLE))
    middles = shape.points[shape.simplices[triangles]].mean(axis=1)
    depth = ring_depth(middles, contour.points).clip(0)
    weight = shape.volumes[triangles] * (depth > 0)
    return float(ring_depth(points, contour.points).clip(0).mean()), float(depth @ weight / weight.sum())


def _accounted(contour: Contour, count: int, radius: float) -> float:
    """Area of the contour and of the empty strip along it: each edge point stands for its share of a gap."""
    taken = (1.0 if np.isinf(radius) else GAP) * len(contour.points)
    return contour.area * count / (count - taken) if taken < count / 2 else contour.area
