"""ModelFormat: what every file format of a model tells about itself."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, cast

from sketchloft.brep.model import Model
from sketchloft.errors import SketchloftError
from sketchloft.mesh import Mesh

__all__ = ["MODEL_FORMATS", "Meshes", "ModelFormat", "format_of"]

Meshes = Callable[[], tuple[Mesh, ...]]
"""Gives the bodies of a model as triangles, made when first asked for."""


class _Room(Protocol):
    """What the module of a format offers."""

    def write(self, model: Model, meshes: Meshes) -> bytes: ...
    def read(self, path: Path) -> Model: ...
    def read_mesh(self, path: Path) -> Mesh: ...


@dataclass(frozen=True)
class ModelFormat:
    """A file format of a model.

    Parameters
    ----------
    name : str
        What the format is called.
    suffixes : tuple of str
        Extensions in lower case, with the dot; the first one is the usual one.
    description : str
        One line for help texts and tables.
    module : str
        Module of this package that reads and writes it; imported at the first use, since most of them
        load the CAD kernel.
    reads : {"solids", "mesh", ""}
        What a file of this format is read as; empty where it is only written.
    """

    name: str
    suffixes: tuple[str, ...]
    description: str
    module: str
    reads: str = ""

    def write(self, model: Model, meshes: Meshes) -> bytes:
        """Contents of a file; exact formats write the solids of `model`, the others its `meshes`."""
        return self._room.write(model, meshes)

    def read(self, path: Path) -> Model:
        """Solids in a file. InputError need not name the file; OSError passes."""
        return self._room.read(path)

    def read_mesh(self, path: Path) -> Mesh:
        """Triangles in a file. InputError need not name the file; OSError passes."""
        return self._room.read_mesh(path)

    @property
    def _room(self) -> _Room:
        return cast(_Room, importlib.import_module(f"{__package__}.{self.module}"))


MODEL_FORMATS = (
    ModelFormat("STEP", (".step", ".stp"), "exact solids with names and unit, AP242", "step_file", "solids"),
    ModelFormat("IGES", (".iges", ".igs"), "exact solids with ASCII names and unit", "iges_file", "solids"),
    ModelFormat("BREP", (".brep", ".brp"), "exact solids, neither names nor unit", "brep_file", "solids"),
    ModelFormat("STL", (".stl",), "triangles, neither names nor unit", "stl_file", "mesh"),
    ModelFormat("GLB", (".glb",), "triangles with names, in metres, y up (glTF 2.0)", "glb_file"),
    ModelFormat("3MF", (".3mf",), "triangles with names and unit, for printing", "threemf_file"),
)
"""Every format that a model can be written in, the preferred one first."""


def format_of(path: Path, formats: Sequence[ModelFormat], error: type[SketchloftError]) -> ModelFormat:
    """Return the one of some formats that a file's extension stands for; raise `error` if there is none."""
    for one in formats:
        if path.suffix.lower() in one.suffixes:
            return one
    known = " ".join(suffix for one in formats for suffix in one.suffixes)
    found = path.suffix or "(none)"
    raise error(f"{path}: the extension {found} is none of a model that fits here; choose one of {known}")
