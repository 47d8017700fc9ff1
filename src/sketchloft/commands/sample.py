"""`sketchloft sample`: a cloud that fills or covers a known solid."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from sketchloft.commands.console import Json, show, show_json
from sketchloft.errors import UsageError
from sketchloft.io import write_cloud
from sketchloft.sample import GOALS, Fill, FillParams, sample_goal

__all__ = ["sample"]

Name = Literal["three-spheres", "sphere", "l-shape", "lamp", "cylinder", "box", "cone", "stepped-shaft"]


def sample(
    name: Annotated[Name, Parameter(help="The solid.")],
    /,
    *,
    output: Annotated[
        Path | None,
        Parameter(
            name=["--output", "-o"], help="Cloud to write: xyz, csv, npy, ply or pcd. [default: NAME.ply]"
        ),
    ] = None,
    n: Annotated[int, Parameter(name=["--n", "-n"], help="Number of points.")] = 10_000,
    seed: Annotated[int, Parameter(help="The same seed gives the same cloud.")] = 1,
    fill: Annotated[
        Fill, Parameter(help="Even, 6:1 denser at one end, scribbled strokes, or on the surface.")
    ] = FillParams.fill,
    jitter: Annotated[
        float, Parameter(help="Noise of every point, as a share of the diagonal.")
    ] = FillParams.jitter,
    outliers: Annotated[float, Parameter(help="Share of stray points or strokes.")] = FillParams.outliers,
    drift: Annotated[
        float, Parameter(help="Slow error of every stroke, as a share of the diagonal.")
    ] = FillParams.drift,
    goal: Annotated[Path | None, Parameter(help="File for the exact solid: step, iges, brep, stl.")] = None,
    json: Json = False,
) -> None:
    """Draw a cloud of a known solid."""
    if n < 1:
        raise UsageError(f"n: found {n} points asked for, expected at least 1")
    solid = GOALS[name]
    target = output or Path(f"{name}.ply")
    cloud = sample_goal(solid, n, FillParams(fill, jitter, outliers, drift), seed=seed)
    written = [str(target)]
    if goal is not None:
        from sketchloft.brep.files import write_model  # noqa: PLC0415  the kernel only where it is needed
        from sketchloft.brep.model import NamedSolid  # noqa: PLC0415
        from sketchloft.brep.primitives import fuse  # noqa: PLC0415

        write_model(goal, [NamedSolid(name, fuse(solid.parts))])
        written.append(str(goal))
    write_cloud(target, cloud)
    if json:
        show_json({"written": written, "points": len(cloud), "goal": name})
    else:
        show(f"{name}: {len(cloud)} points, {solid.description}")
        show("written: " + ", ".join(written))
