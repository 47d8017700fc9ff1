"""Side by side: build one cloud's models by several methods and measure them (paper, section 5.3)."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from sketchloft.alpha_shape import alpha_complex
from sketchloft.closed_mesh import closed_mesh
from sketchloft.cloud import CleanCloud, PointCloud, clean
from sketchloft.compare.comparison import Comparison, Method, Row
from sketchloft.compare.methods import LoftedModel, MethodModel, alpha_model, lofted_model, octree_model
from sketchloft.compare.surface_facts import surface_facts
from sketchloft.errors import ModelError, StageError, UsageError
from sketchloft.measurement import measure
from sketchloft.mesh import Mesh

__all__ = ["ComparisonParams", "compare", "parse_radii"]


@dataclass(frozen=True)
class ComparisonParams:
    """How methods are compared.

    Parameters
    ----------
    octree_depth : int, optional
        How often the octree is divided; by the rule of `octree_cells` if not given.
    samples : int
        How many points on each surface are measured.
    seed : int
        Of these points.
    """

    octree_depth: int | None = None
    samples: int = 20_000
    seed: int = 0


@dataclass(frozen=True)
class _Job:
    method: Method
    probe_radius: float | None
    build: Callable[[], MethodModel]
    seconds_before: float = 0.0


def parse_radii(text: str) -> tuple[float, ...]:
    """Read probe radii such as "0.5,1,inf".

    Raises
    ------
    UsageError
        If the text is no list of positive numbers.
    """
    try:
        radii = tuple(float(word) for word in text.split(","))
    except ValueError:
        raise UsageError(f"radii: found '{text}', expected positive numbers such as 0.5,1,inf") from None
    return _checked(radii)


def compare(
    cloud: PointCloud,
    radii: Sequence[float],
    loft: Callable[[float], LoftedModel],
    *,
    goal: Mesh | None = None,
    params: ComparisonParams | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Comparison:
    """Build models by slice-and-loft, the 3D alpha shape and the octree, and measure them.

    Parameters
    ----------
    cloud : PointCloud
    radii : sequence of float
        Probe radii in the unit of the cloud; infinity gives convex hulls.
    loft : callable
        Builds the slice-and-loft model for a probe radius of the 2D alpha shapes. The paper compares
        without shape recognition.
    goal : Mesh, optional
        What the model should be: closed, in the unit of the cloud.
    params : ComparisonParams, optional
    progress : callable, optional
        Called with the method and the radius when work on it begins.

    Returns
    -------
    Comparison

    Raises
    ------
    CloudError
        If the points cannot describe a solid.
    UsageError
        If a radius is not positive.
    ModelError
        If the goal is not closed.

    Notes
    -----
    Where a method fails, because the radius leaves nothing for example, its row says why and the
    comparison goes on.
    """
    params, radii = params or ComparisonParams(), _checked(tuple(radii))
    goal = None if goal is None else closed_mesh(goal, "goal")
    cleaned = clean(cloud)
    outcomes = []
    for job in _jobs(cleaned, radii, loft, params):
        at = "" if job.probe_radius is None else f", probe radius {job.probe_radius:g}"
        progress(f"{job.method}{at}")
        outcomes.append(_outcome(job, goal, params))
    rows, meshes = zip(*outcomes, strict=True)
    return Comparison(cleaned, radii, goal, rows, meshes)


def _checked(radii: tuple[float, ...]) -> tuple[float, ...]:
    if not radii or not all(radius > 0 for radius in radii):
        raise UsageError(f"radii: found {list(radii)}, expected at least one, all positive or inf")
    return radii


def _jobs(
    cloud: CleanCloud,
    radii: tuple[float, ...],
    loft: Callable[[float], LoftedModel],
    params: ComparisonParams,
) -> Iterator[_Job]:
    for radius in radii:
        yield _Job("slice and loft", radius, partial(lofted_model, loft, radius))
    begun = time.perf_counter()
    shape = alpha_complex(cloud.points)
    seconds = time.perf_counter() - begun
    for radius in radii:
        yield _Job("3D alpha shape", radius, partial(alpha_model, cloud, shape, radius), seconds)
    yield _Job("octree", None, partial(octree_model, cloud, params.octree_depth))


def _outcome(job: _Job, goal: Mesh | None, params: ComparisonParams) -> tuple[Row, Mesh | None]:
    begun = time.perf_counter()
    try:
        model = job.build()
    except (ModelError, StageError) as error:
        seconds = job.seconds_before + time.perf_counter() - begun
        return Row(job.method, job.probe_radius, seconds, str(error)), None
    seconds = job.seconds_before + time.perf_counter() - begun
    row = Row(
        job.method,
        job.probe_radius,
        seconds,
        model.remark,
        model.faces,
        len(model.mesh.triangles),
        surface_facts(model.mesh.triangles),
        model.mesh.volume,
        model.voids_inside,
    )
    return row if goal is None else _measured(row, model.mesh, goal, params), model.mesh


def _measured(row: Row, model: Mesh, goal: Mesh, params: ComparisonParams) -> Row:
    try:
        found = measure(model, goal, n=params.samples, seed=params.seed)
    except ModelError as error:
        return replace(row, remark=f"{row.remark}; {error}".removeprefix("; "))
    return replace(
        row,
        errors=found.errors,
        missed=found.back_errors,
        rms_thousandths=found.errors_in_thousandths.rms,
        volume_error=found.volume_error,
    )
