"""`sketchloft build`: a cloud becomes a CAD model."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter, validators

from sketchloft.bodies import BodiesParams, parse_bodies
from sketchloft.brep.files import check_outputs, write_model
from sketchloft.brep.model import NamedSolid
from sketchloft.cloud import Unit
from sketchloft.commands.console import Json, Quiet, Verbose, progress, remark, show, show_json
from sketchloft.direction import DirectionParams, parse_axis
from sketchloft.edge_points import EdgePointsParams, parse_probe_radius
from sketchloft.errors import UsageError
from sketchloft.exact.body import ExactParams
from sketchloft.io import read_cloud
from sketchloft.loft import Between, LoftParams
from sketchloft.output import check_writable
from sketchloft.pipeline import EXACT_MODULES, EXACT_STAGES, STAGES, Method, Params, reconstruct
from sketchloft.shapes.choice import ShapesParams, parse_shapes
from sketchloft.slice_planes import CentralAxis, SlicePlanesParams, parse_per_slice
from sketchloft.work_points import Working, WorkPointsParams
from sketchloft.workers import hire

if TYPE_CHECKING:
    from sketchloft.plan.plan import Plan

__all__ = ["build"]


def build(
    cloud: Annotated[Path, Parameter(help="Cloud of points: xyz, txt, csv, pts, npy, ply or pcd.")],
    /,
    *,
    output: Annotated[
        list[Path] | None,
        Parameter(
            name=["--output", "-o"],
            negative="",
            help="Model to write, several times for several formats: step, iges, brep, stl, glb, 3mf. "
            "[default: the cloud's name with .step]",
        ),
    ] = None,
    method: Annotated[
        Method, Parameter(help="exact: runs of exact walls fitted to all points; paper: slice and loft.")
    ] = Params.method,
    axis: Annotated[str, Parameter(help='Slicing direction: auto, x, y, z or a vector, "0,0.2,1".')] = "auto",
    per_slice: Annotated[str, Parameter(help="Points per slice; auto is 500 at 10,000 points.")] = "auto",
    central_axis: Annotated[
        CentralAxis, Parameter(help="Axis through the mean or the best circle of the surface points.")
    ] = SlicePlanesParams.central_axis,
    working: Annotated[
        Working, Parameter(help="Points move onto their plane along the wall's slope, or parallel.")
    ] = WorkPointsParams.working,
    probe_radius: Annotated[
        str, Parameter(help="Radius of the alpha shape's probe: auto, a number, inf, or a file of radii.")
    ] = "auto",
    shapes: Annotated[
        str,
        Parameter(
            help="Shape of the sections: auto, off (splines), circle, ellipse, rectangle, or for single "
            "slices, 3:circle,7-9:rectangle."
        ),
    ] = ShapesParams.shapes,
    loft: Annotated[
        Between, Parameter(help="Straight between sections, or one smooth spline.")
    ] = LoftParams.between,
    plan: Annotated[
        Path | None, Parameter(help="Plan, as --save-plan writes it, to keep to instead of searching.")
    ] = None,
    save_plan: Annotated[
        Path | None, Parameter(help="TOML file for all that was found, to edit and give back with --plan.")
    ] = None,
    bodies: Annotated[str, Parameter(help="Number of bodies, or auto.")] = "auto",
    unit: Annotated[Unit, Parameter(help="Unit of the cloud's numbers, and of the model's.")] = "mm",
    report: Annotated[Path | None, Parameter(help="HTML report to write.")] = None,
    workers: Annotated[
        int | None,
        Parameter(
            validator=validators.Number(gte=0),
            help="Processes that work beside this one; they change how long it takes, not the model. "
            "[default: the cores to spare, at most 3]",
        ),
    ] = None,
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Build a CAD model from a cloud of points."""
    params = Params(
        method,
        BodiesParams(parse_bodies(bodies)),
        ExactParams(),
        DirectionParams(parse_axis(axis)),
        SlicePlanesParams(parse_per_slice(per_slice), central_axis),
        WorkPointsParams(working),
        EdgePointsParams(parse_probe_radius(probe_radius)),
        ShapesParams(parse_shapes(shapes)),
        LoftParams(loft),
        _plan(plan, save_plan, method, axis, unit),
    )
    # A folder such as "." has no name to go by, and is told to be none of a cloud when it is read.
    outputs = output or [cloud.with_suffix(".step") if cloud.name else cloud / "cloud.step"]
    check_outputs(outputs)
    if report is not None:
        check_writable(report)
    stages = ("read", *(EXACT_STAGES if method == "exact" else STAGES), "write", "report")
    searches = method == "exact" and plan is None
    with (
        progress(stages, quiet=quiet, verbose=verbose) as begin,
        hire(workers if searches else 0, EXACT_MODULES) as team,
    ):
        begin("read")
        points = read_cloud(cloud, unit=unit)
        result = reconstruct(points, params, begin, team)
        begin("write")
        from sketchloft.summary import summary, summary_lines  # noqa: PLC0415

        solids = [NamedSolid(body.name, body.solid) for body in result.bodies]
        if report is not None:
            from sketchloft.report.html import write_report  # noqa: PLC0415  matplotlib takes a second

            begin("report")
            write_report(result, report, unit=unit)
        write_model(outputs, solids, unit)
        if save_plan is not None:
            from sketchloft.exact.planned import plan_of  # noqa: PLC0415
            from sketchloft.plan.write import write_plan  # noqa: PLC0415

            write_plan(plan_of(result, unit), save_plan)
    written = [str(path) for path in (*outputs, report, save_plan) if path is not None]
    figures = summary(result, unit)
    if json:
        show_json({"written": written, **figures})
        return
    if not quiet:
        for text in figures["remarks"]:
            remark(text)
    for line in summary_lines(result, unit):
        show(line)
    show("written: " + ", ".join(written))


def _plan(plan: Path | None, save_plan: Path | None, method: Method, axis: str, unit: Unit) -> Plan | None:
    """Read the plan, once it is clear that it can be kept to, and another one written."""
    if method == "paper" and (plan or save_plan):
        given = "plan" if plan else "save-plan"
        raise UsageError(f"{given}: plans are for the method exact; leave out --{given} or --method paper")
    if save_plan is not None:
        if save_plan.suffix.lower() != ".toml":
            raise UsageError(f"save-plan: found {save_plan}, expected a name that ends in .toml")
        check_writable(save_plan)
    if plan is None:
        return None
    if axis != "auto":
        raise UsageError("axis: the plan says the direction; leave out --axis, or change it in the plan")
    from sketchloft.plan.read import read_plan  # noqa: PLC0415  workers may start while the method loads

    read = read_plan(plan)
    if read.unit != unit:
        raise UsageError(f"unit: found {unit}, but {plan} is in {read.unit}; give --unit {read.unit}")
    return read
