"""Remarks: what a person should know about a reconstruction that went through."""

from __future__ import annotations

import itertools

import numpy as np

from sketchloft.exact.body import ExactBody
from sketchloft.pipeline import BodyModel, Params, Reconstruction

__all__ = ["remarks"]

PAPER_ONLY = ("slice_planes", "work_points", "edge_points", "shapes", "loft")
"""Parameters of `Params` that the exact method has no use for."""


def remarks(result: Reconstruction) -> tuple[str, ...]:
    """One sentence for everything that was left out or looks doubtful.

    Parameters
    ----------
    result : Reconstruction

    Returns
    -------
    tuple of str
        Each names the stage and, where it concerns single slices, the slices.
    """
    cloud = result.cloud
    found = []
    if cloud.n_not_finite:
        found.append(f"input: {cloud.n_not_finite} of {cloud.n_read} points are not finite and were left out")
    if cloud.n_repeated:
        found.append(f"input: {cloud.n_repeated} of {cloud.n_read} points are repeats and were left out")
    several = len(result.bodies) > 1
    for body in result.bodies:
        prefix = f"{body.name}: " if several else ""
        if isinstance(body, ExactBody):
            continue
        if body.instead:
            found.append(
                f"{prefix}the exact method gave up ({body.instead}), so the body was sliced and lofted"
            )
        found += [prefix + text for text in (*_left_out(body), *_all_hull(body, result), *_borrowed(body))]
    return tuple(found + _unused(result))


def _unused(result: Reconstruction) -> list[str]:
    """Settings of stages that only the paper's method has, where no body went through them."""
    if not all(isinstance(body, ExactBody) for body in result.bodies):
        return []
    given, usual = result.params, Params()
    names = [name for name in PAPER_ONLY if getattr(given, name) != getattr(usual, name)]
    if not names:
        return []
    stages = ", ".join(name.replace("_", " ") for name in names)
    return [f"{stages}: what was set for this is for the paper's method; ask for that, or leave it out"]


def _left_out(body: BodyModel) -> list[str]:
    if not all(edge.filled for edge in body.edges):
        return [
            "edge points: the sections are empty inside, so the points were taken for the skin of a solid"
        ]
    slices = [i for i, edge in enumerate(body.edges) if edge.left_out]
    if not slices:
        return []
    count = sum(edge.left_out for edge in body.edges)
    return [
        f"edge points, slices {ranges(slices)}: {count} inner or separate contours were left out; the "
        "method keeps one outer contour per slice, so holes are closed and side branches are lost"
    ]


def _borrowed(body: BodyModel) -> list[str]:
    slices = [i for i, section in enumerate(body.sections) if section.borrowed]
    if not slices:
        return []
    return [
        f"loft, slices {ranges(slices)}: the contour is too ragged to be lofted, so the shape of the "
        "neighbouring slice was taken; use a larger probe radius or more points per slice"
    ]


def _all_hull(body: BodyModel, result: Reconstruction) -> list[str]:
    asked = result.params.edge_points.probe_radius
    if asked == "auto" or np.isinf(asked).any():
        return []
    slices = [
        i
        for i, (edge, worked) in enumerate(zip(body.edges, body.worked, strict=True))
        if edge.probe_radius > float(np.ptp(worked.points, axis=0).max())
    ]
    if not slices:
        return []
    return [
        f"edge points, slices {ranges(slices)}: the probe radius is larger than the section, so its contour "
        "is the convex hull; use a smaller radius if the section has hollows"
    ]


def ranges(numbers: list[int]) -> str:
    """Rising numbers as ranges: [0, 1, 2, 5] is "0-2, 5"."""
    cuts = [0, *(i for i in range(1, len(numbers)) if numbers[i] != numbers[i - 1] + 1), len(numbers)]
    parts = [numbers[a:b] for a, b in itertools.pairwise(cuts)]
    return ", ".join(str(part[0]) if len(part) == 1 else f"{part[0]}-{part[-1]}" for part in parts)
