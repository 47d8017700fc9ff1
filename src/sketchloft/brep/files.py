"""Files: models written and read, whatever the format."""

from __future__ import annotations

import functools
import os
from collections.abc import Sequence
from pathlib import Path

from sketchloft.brep.format import MODEL_FORMATS, format_of
from sketchloft.brep.model import METRES, Fineness, Model, NamedSolid
from sketchloft.cloud import Unit
from sketchloft.errors import InputError, OutputError
from sketchloft.mesh import Mesh, concatenated
from sketchloft.output import beside, check_writable

__all__ = ["check_outputs", "load_mesh", "read_model", "write_model"]

PathLike = str | os.PathLike[str]


def check_outputs(paths: Sequence[PathLike]) -> None:
    """Find out, before the work begins, whether models could be written to these files.

    Raises
    ------
    OutputError
        If an extension is unknown, a path is a folder, or its folder is missing or not writable.
    """
    for path in map(Path, paths):
        format_of(path, MODEL_FORMATS, OutputError)
        check_writable(path)


def write_model(
    paths: PathLike | Sequence[PathLike],
    bodies: Sequence[NamedSolid],
    unit: Unit = "mm",
    fineness: Fineness | None = None,
) -> None:
    """Write a model to files, in the format of each one's extension, all or none.

    Parameters
    ----------
    paths : path-like or sequence of path-like
        Replaced where they exist.
    bodies : sequence of NamedSolid
        At least one.
    unit : {"mm", "cm", "m", "in"}
        Unit of the coordinates; the numbers in a file are those of the solids, but for GLB (metres).
    fineness : Fineness, optional
        How closely triangles follow the surface, in formats that hold triangles.

    Raises
    ------
    OutputError
        If a file cannot be written; then none is touched. See also `check_outputs`.
    ModelError
        If a solid cannot be triangulated.

    Notes
    -----
    The same model gives the same bytes. All files are written beside their places first and renamed last.
    """
    if not bodies:
        raise OutputError("the model has no solid, so there is nothing to write")
    several = [paths] if isinstance(paths, str | os.PathLike) else paths
    check_outputs(several)
    model = Model(tuple(bodies), unit)
    meshes = functools.cache(functools.partial(_meshes, model, fineness or Fineness()))
    targets = list(dict.fromkeys(map(Path, several)))
    with beside(*targets) as parts:
        for target, part in zip(targets, parts, strict=True):
            part.write_bytes(format_of(target, MODEL_FORMATS, OutputError).write(model, meshes))


def read_model(path: PathLike) -> Model:
    """Read the solids in a STEP, IGES or BREP file.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    Model
        Coordinates are the numbers of the file, in the file's own unit; in millimetres where that unit is
        not one of `sketchloft.cloud.UNITS`. The unit is None where the format has none (BREP).

    Raises
    ------
    InputError
        If the file is missing, unreadable, cut short, malformed, or holds no solid.
    """
    path = Path(path)
    chosen = format_of(path, [one for one in MODEL_FORMATS if one.reads == "solids"], InputError)
    try:
        model = chosen.read(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    if not model.bodies:
        raise InputError(f"{path}: holds no solid; export solids, not loose faces or curves")
    return model


def load_mesh(
    path: PathLike, chord: float = Fineness.chord, angle: float = Fineness.angle, unit: Unit | None = None
) -> Mesh:
    """Read a model as triangles: STEP, IGES and BREP by tessellation, STL as it is.

    Parameters
    ----------
    path : path-like
    chord, angle : float
        See `tessellate`.
    unit : {"mm", "cm", "m", "in"}, optional
        Unit that coordinates are converted to; by default they are the numbers of the file. STL and BREP
        have no unit and are taken to be in this one.

    Returns
    -------
    Mesh
        All bodies of the file.

    Raises
    ------
    InputError
        As `read_model`.
    ModelError
        If a solid cannot be triangulated.
    """
    path = Path(path)
    chosen = format_of(path, [one for one in MODEL_FORMATS if one.reads], InputError)
    if chosen.reads == "solids":
        model = read_model(path)
        mesh = concatenated(_meshes(model, Fineness(chord, angle)))
        scale = METRES[model.unit] / METRES[unit] if model.unit and unit else 1.0
        return mesh if scale == 1.0 else Mesh(mesh.vertices * scale, mesh.triangles)
    try:
        return chosen.read_mesh(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def _meshes(model: Model, fineness: Fineness) -> tuple[Mesh, ...]:
    from sketchloft.brep.tessellate import tessellate  # noqa: PLC0415 - the kernel only where it is needed

    return tuple(tessellate(body.solid, fineness.chord, fineness.angle) for body in model.bodies)
