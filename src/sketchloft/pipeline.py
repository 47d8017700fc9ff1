"""The pipeline: a cloud goes in, a valid solid and everything found on the way comes out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from sketchloft.bodies import BodiesParams, separate_bodies
from sketchloft.cloud import MIN_POINTS, CleanCloud, Floats, Ints, PointCloud, clean
from sketchloft.direction import Direction, DirectionParams, slicing_direction
from sketchloft.edge_points import EdgePoints, EdgePointsParams, edge_points
from sketchloft.errors import ModelError, StageError, UsageError
from sketchloft.exact.body import EXACT_MODULES, EXACT_STAGES, ExactBody, ExactParams
from sketchloft.frame import Frame, frame_along
from sketchloft.loading import load
from sketchloft.loft import LoftParams, Section
from sketchloft.shapes.choice import ShapesParams
from sketchloft.shapes.recognise import recognise
from sketchloft.slice_planes import SlicePlanes, SlicePlanesParams, slice_planes
from sketchloft.surface import SkinSurface
from sketchloft.untangle import untangled
from sketchloft.work_points import WorkedSlice, WorkPointsParams, follow_slope, work_points
from sketchloft.workers import ALONE, Workers

if TYPE_CHECKING:  # the kernel takes most of a second to load
    from sketchloft.brep.facts import SolidFacts
    from sketchloft.brep.solid import Solid
    from sketchloft.exact.start.first_look import FirstLook
    from sketchloft.plan.plan import Plan

__all__ = [
    "EXACT_MODULES",
    "EXACT_STAGES",
    "STAGES",
    "BodyModel",
    "Params",
    "Progress",
    "Reconstruction",
    "reconstruct",
]

STAGES = (
    "input",
    "bodies",
    "direction",
    "slice planes",
    "work points",
    "edge points",
    "shapes",
    "loft",
    "solid",
)

KERNEL = "sketchloft.brep.build_stack"
"""What makes a stack a solid."""

Method = Literal["exact", "paper"]

Progress = Callable[[str], None]
"""Called with the name of each stage when it begins."""


@dataclass(frozen=True)
class Params:
    """The parameters of all stages, in the order of the stages.

    Parameters
    ----------
    method : {"exact", "paper"}
        Runs of exact walls fitted to all points at once, or the paper's slices and loft.
    bodies : BodiesParams
    exact : ExactParams
    direction : DirectionParams
    slice_planes : SlicePlanesParams
    work_points : WorkPointsParams
    edge_points : EdgePointsParams
    shapes : ShapesParams
    loft : LoftParams
    plan : Plan, optional
        What is kept instead of searched for, body by body, by the exact method.
    """

    method: Method = "exact"
    bodies: BodiesParams = field(default_factory=BodiesParams)
    exact: ExactParams = field(default_factory=ExactParams)
    direction: DirectionParams = field(default_factory=DirectionParams)
    slice_planes: SlicePlanesParams = field(default_factory=SlicePlanesParams)
    work_points: WorkPointsParams = field(default_factory=WorkPointsParams)
    edge_points: EdgePointsParams = field(default_factory=EdgePointsParams)
    shapes: ShapesParams = field(default_factory=ShapesParams)
    loft: LoftParams = field(default_factory=LoftParams)
    plan: Plan | None = None


@dataclass(frozen=True)
class BodyModel:
    """One body of the cloud, with the result of every stage.

    Parameters
    ----------
    name : str
    points : (n, 3) float array
        In the frame of the slicing direction, about the centre of the cloud.
    direction : Direction
    frame : Frame
        From the axes of the cloud to those of the body.
    planes : SlicePlanes
    worked : tuple of WorkedSlice
    edges : tuple of EdgePoints
    sections : tuple of Section
    surface : SkinSurface
        In the frame of the slicing direction.
    solid : Solid
        Where the cloud is, in its unit.
    facts : SolidFacts
        What the checks of the solid found.
    instead : str
        Why the exact method, though asked for, could not model it.
    """

    name: str
    points: Floats
    direction: Direction
    frame: Frame
    planes: SlicePlanes
    worked: tuple[WorkedSlice, ...]
    edges: tuple[EdgePoints, ...]
    sections: tuple[Section, ...]
    surface: SkinSurface
    solid: Solid
    facts: SolidFacts
    instead: str = ""


@dataclass(frozen=True)
class Reconstruction:
    """What became of a cloud.

    Parameters
    ----------
    cloud : CleanCloud
    params : Params
    bodies : tuple of ExactBody or BodyModel, as the method is
        The largest first.
    """

    cloud: CleanCloud
    params: Params
    bodies: tuple[ExactBody | BodyModel, ...]


def reconstruct(
    cloud: PointCloud,
    params: Params | None = None,
    progress: Progress = lambda _: None,
    workers: Workers = ALONE,
) -> Reconstruction:
    """Turn a cloud into solids by slicing and lofting (paper, section 4).

    Parameters
    ----------
    cloud : PointCloud
    params : Params, optional
    progress : callable, optional
        Called with the name of each stage when it begins.
    workers : Workers, optional
        Who do pieces of the work beside this process; they change nothing but how long it takes.

    Returns
    -------
    Reconstruction

    Raises
    ------
    UsageError
        If a plan is given to the paper's method.
    InputError
        If the plan has another number of bodies than the cloud.
    CloudError
        If the points cannot describe a solid.
    StageError
        If a stage cannot go on; the message names it, and the slice.
    ModelError
        If the solid fails a check.

    Examples
    --------
    >>> from sketchloft import Params, reconstruct
    >>> from sketchloft.sample import GOALS, sample_goal
    >>> result = reconstruct(sample_goal(GOALS["cylinder"], 4000, seed=1))
    >>> result.bodies[0].facts.faces
    {'CylindricalSurface': 1, 'Plane': 2}
    """
    params = params or Params()
    if params.plan is not None and params.method == "paper":
        raise UsageError("plan: the method paper follows no plan; leave out one of them")
    progress("input")
    cleaned = clean(cloud)
    progress("bodies")
    parts = _parts(cleaned.points, params, progress, workers)
    if params.plan is not None:
        from sketchloft.exact.planned import check_bodies  # noqa: PLC0415  as below

        check_bodies(params.plan, len(parts))
    names = [cloud.name] if len(parts) == 1 else [f"{cloud.name}-{i + 1}" for i in range(len(parts))]
    bodies = [
        _body(
            name,
            cleaned.points[part],
            cleaned.centre,
            params,
            progress,
            look=look,
            workers=workers,
            index=i,
        )
        for i, (name, (part, look)) in enumerate(zip(names, parts, strict=True))
    ]
    return Reconstruction(cleaned, params, tuple(bodies))


def _parts(
    points: Floats, params: Params, progress: Progress, workers: Workers
) -> Sequence[tuple[Ints, FirstLook | None]]:
    """Which points each body has and, where its direction is to be found, a first look at it."""
    if params.method == "paper" or params.plan is not None or params.direction.axis != "auto":
        return [(part, None) for part in separate_bodies(points, params.bodies)]
    from sketchloft.exact.start.first_look import looked_over  # noqa: PLC0415  as below

    found = workers.begin(looked_over, points, params.bodies, params.exact.segments)
    progress("direction")
    # What takes a second to load does so while a worker looks at the points.
    load((KERNEL, *EXACT_MODULES))
    return found.result()


def _body(
    name: str,
    points: Floats,
    centre: Floats,
    params: Params,
    progress: Progress,
    *,
    look: FirstLook | None,
    workers: Workers,
    index: int,
) -> ExactBody | BodyModel:
    if len(points) < MIN_POINTS:
        raise StageError(
            f"{name} has {len(points)} points, a body needs at least {MIN_POINTS}; ask for fewer bodies",
            stage="bodies",
        )
    if params.plan is not None:
        from sketchloft.exact.planned import planned_body  # noqa: PLC0415  as below

        fit = params.plan.fits_sizes(index)
        return planned_body(points, centre, params.plan.bodies[index], progress, fit=fit)
    if params.method == "exact":
        from sketchloft.exact.exact_body import exact_body  # noqa: PLC0415  workers start while it loads

        try:
            return exact_body(
                name,
                points,
                centre,
                axis=params.direction.axis,
                look=look,
                params=params.exact,
                progress=progress,
                workers=workers,
            )
        except (StageError, ModelError, np.linalg.LinAlgError) as error:
            return replace(_sliced_and_lofted(name, points, centre, params, progress), instead=str(error))
    return _sliced_and_lofted(name, points, centre, params, progress)


def _sliced_and_lofted(
    name: str, points: Floats, centre: Floats, params: Params, progress: Progress
) -> BodyModel:
    """Model a body by the paper's method."""
    progress("direction")
    middle = points.mean(axis=0)
    direction = slicing_direction(points - middle, params.direction)
    frame = frame_along(direction.vector, points - middle)
    local = frame.to_local(points)
    progress("slice planes")
    planes = slice_planes(local, params.slice_planes)
    worked, edges = _contours(local, planes.heights, params, progress)
    progress("shapes")
    shapes = recognise(edges, planes.key_heights, params.shapes)
    sections = tuple(Section(edge.height, shape) for edge, shape in zip(edges, shapes, strict=True))
    progress("loft")
    sections, surface = untangled(sections, edges, params.loft)
    progress("solid")
    from sketchloft.brep.build import built  # noqa: PLC0415  the kernel takes most of a second to load

    solid, facts = built(surface, centre, frame.axes)
    return BodyModel(name, local, direction, frame, planes, worked, edges, sections, surface, solid, facts)


def _contours(
    points: Floats, heights: Floats, params: Params, progress: Progress
) -> tuple[tuple[WorkedSlice, ...], tuple[EdgePoints, ...]]:
    progress("work points")
    worked = work_points(points, heights)
    progress("edge points")
    edges = edge_points(worked, params.edge_points)
    if params.work_points.working == "parallel":
        return worked, edges
    centres, areas = np.array([edge.centre for edge in edges]), np.array([edge.area for edge in edges])
    worked = work_points(follow_slope(points, heights, centres, areas), heights)
    return worked, edge_points(worked, params.edge_points)
