"""What a skin's sections say about the solid: its volume, and that it cannot cut itself. Plain numpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats
from sketchloft.errors import ModelError
from sketchloft.gauss import gauss_between
from sketchloft.surface import SkinSurface, distinct_knots, evaluate

__all__ = ["check_sections", "section_axis", "section_volume", "subdivided"]

PARALLEL = 1e-7
"""How far a pole may leave the plane of its section, as a share of the solid's length."""


def section_axis(surface: SkinSurface) -> Floats:
    """Unit normal of the sections, which must lie on parallel planes in rising order.

    Raises
    ------
    ModelError
        If they do not; the message names the section, counted from 0.

    Notes
    -----
    With the poles of every row on one plane and the planes in strict order, each curve of constant v is
    planar and its height grows strictly with v (B-splines diminish variation). So two such curves never meet.
    """
    first = surface.poles[0] - surface.poles[0, :-1].mean(axis=0)
    normal = np.cross(first[:-1], first[1:]).sum(axis=0)
    rise = surface.poles[-1].mean(axis=0) - surface.poles[0].mean(axis=0)
    length = float(np.linalg.norm(normal))
    if length == 0:
        raise ModelError("the first section encloses no area; leave this slice out")
    axis: Floats = normal / length if normal @ rise > 0 else -normal / length
    heights = surface.poles @ axis
    total = float(heights[-1].mean() - heights[0].mean())
    tilted = np.flatnonzero(np.ptp(heights, axis=1) > PARALLEL * max(total, 0.0))
    if len(tilted):
        raise ModelError(
            f"section {tilted[0]} leaves its plane, or is tilted against the first, by "
            f"{np.ptp(heights[tilted[0]]):.2g} of a length of {total:.2g}; slice on parallel planes"
        )
    back = np.flatnonzero(np.diff(heights.mean(axis=1)) <= 0)
    if len(back):
        raise ModelError(
            f"section {back[0] + 1} does not lie above section {back[0]}; sort the slices by height"
        )
    weights = surface.weights
    if weights is not None and not np.allclose(weights * weights[0, 0], weights[:, :1] * weights[:1]):
        raise ModelError(
            "the sections have weights in unequal proportion; bring them to common weights first"
        )
    return axis


def section_volume(surface: SkinSurface) -> float:
    """Volume of the loft, integrated over the areas of its sections.

    Notes
    -----
    Area by Green's theorem around each section, then over the height; Gauss points per span make both
    exact for a surface without weights.
    """
    axis = section_axis(surface)
    across = _across(axis)
    extra = 0 if surface.weights is None else 6
    u, u_weights = gauss_between(distinct_knots(surface.u_knots), surface.u_degree + extra)
    v, v_weights = gauss_between(distinct_knots(surface.v_knots), (3 * surface.v_degree + 1) // 2)
    points = evaluate(surface, u, v) @ across.T
    tangents = evaluate(surface, u, v, u_derivative=1) @ across.T
    areas = _wedge(points, tangents) @ u_weights / 2
    # Weights, where there are any, are in equal proportion, so heights blend along v like the areas do.
    column = evaluate(surface, surface.u_knots[:1], v, v_derivative=1)[:, 0] @ axis
    return abs(float((areas * column) @ v_weights))


def check_sections(surface: SkinSurface, per_span: int = 3) -> None:
    """Prove that the skin does not cut itself.

    Parameters
    ----------
    surface : SkinSurface
    per_span : int
        How many sections to look at inside each span of v, besides those on the knots.

    Raises
    ------
    ModelError
        If the sections are not on parallel planes in rising order (`section_axis`), if one of them crosses or
        touches itself, or if the skin shrinks to a point and turns over between two of them.

    Notes
    -----
    Sections on different planes cannot meet, so it is enough that every section is simple. One that winds
    once about its centre with an angle that only grows is; others are looked at as dense polygons.
    """
    v, rings = _rings(surface, per_span)
    spokes = rings - rings[:, :-1].mean(axis=1, keepdims=True)
    start, length = surface.v_knots[0], surface.v_knots[-1] - surface.v_knots[0]
    turned = np.flatnonzero(np.einsum("ruk,ruk->r", spokes[:-1], spokes[1:]) <= 0)
    if len(turned):
        before, after = (v[turned[0] : turned[0] + 2] - start) / length
        raise ModelError(
            f"the loft shrinks to a point and turns over between {before:.0%} and {after:.0%} of its length; "
            "loft straight instead of smooth, or add slices there"
        )
    doubtful = np.flatnonzero(~_winds_once(spokes))
    if not len(doubtful):
        return
    import shapely  # noqa: PLC0415 - most lofts never need it

    crossed = doubtful[~shapely.is_simple(shapely.linearrings(rings[doubtful]))]
    if len(crossed):
        raise ModelError(
            f"the section at {(v[crossed[0]] - start) / length:.1%} of the loft crosses itself; "
            "smooth the contours near it, or give them fewer control points"
        )


def _rings(surface: SkinSurface, per_span: int) -> tuple[Floats, Floats]:
    """Parameters v (m,) and the sections there as closed polygons (m, n, 2) on their planes."""
    across = _across(section_axis(surface))
    u_ends, v_ends = distinct_knots(surface.u_knots), distinct_knots(surface.v_knots)
    fine = int(np.clip(800 // (len(u_ends) - 1), 2, 16)) if surface.u_degree > 1 else 1
    v = subdivided(v_ends, per_span + 1)
    rings = evaluate(surface, subdivided(u_ends, fine), v) @ across.T
    rings[:, -1] = rings[:, 0]
    return v, rings


def subdivided(ends: Floats, count: int) -> Floats:
    """Divide every interval between neighbouring values into `count` equal ones; all ends are kept."""
    steps = np.arange(count) / count
    return np.append((ends[:-1, None] + np.diff(ends)[:, None] * steps).ravel(), ends[-1])


def _winds_once(spokes: Floats) -> NDArray[np.bool_]:
    turn = _wedge(spokes[:, :-1], spokes[:, 1:])
    angle = np.arctan2(turn, np.einsum("rik,rik->ri", spokes[:, :-1], spokes[:, 1:]))
    one_way = (angle > 0).all(axis=1) | (angle < 0).all(axis=1)
    once: NDArray[np.bool_] = one_way & (np.abs(angle.sum(axis=1)) < 3 * np.pi)
    return once


def _wedge(a: Floats, b: Floats) -> Floats:
    """Cross product of vectors (..., 2) in the plane."""
    product: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def _across(axis: Floats) -> Floats:
    """Two unit vectors (2, 3) perpendicular to the axis and to each other."""
    x = np.cross(np.eye(3)[np.argmin(np.abs(axis))], axis)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(axis, x)])
