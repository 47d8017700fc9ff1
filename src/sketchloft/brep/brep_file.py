"""BREP: the kernel's own text format."""

from __future__ import annotations

import io
import re
from pathlib import Path

from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
from OCP.BRepTools import BRepTools
from OCP.TopoDS import TopoDS_Compound, TopoDS_Shape
from OCP.TopTools import TopTools_FormatVersion

from sketchloft.brep.explore import solids_of
from sketchloft.brep.format import Meshes
from sketchloft.brep.model import Model, NamedSolid
from sketchloft.brep.solid import Solid
from sketchloft.brep.trial import tried
from sketchloft.errors import InputError

__all__ = ["read", "write"]

_END = re.compile(rb"\*\s*\n\s*[+-]\d+ \d+\s*\Z")
"""The table of shapes ends with a star, and the shape that is meant follows."""


def write(model: Model, meshes: Meshes) -> bytes:  # noqa: ARG001 - exact
    """Make the text of a BREP file: the solid, or a compound of several; names and unit are lost."""
    # Copies, since what was done with a shape before leaves marks that would be written too.
    shapes = [BRepBuilderAPI_Copy(body.solid.shape, False, False).Shape() for body in model.bodies]
    shape: TopoDS_Shape = shapes[0]
    if len(shapes) > 1:
        shape = TopoDS_Compound()
        BRep_Builder().MakeCompound(shape)
        for part in shapes:
            BRep_Builder().Add(shape, part)
    stream = io.BytesIO()
    BRepTools.Write_s(shape, stream, False, False, TopTools_FormatVersion.TopTools_FormatVersion_VERSION_1)
    return stream.getvalue()


def read(path: Path) -> Model:
    """Read the solids of a BREP file, named by their place in it; the format has no unit.

    Raises
    ------
    InputError
        If the text is not BREP, or was cut short.
    """
    data = path.read_bytes()
    if b"CASCADE Topology" not in data[:200]:
        raise InputError("is not a BREP file: it does not start with CASCADE Topology")
    if not _END.search(data[-200:]):
        raise InputError("is cut short: no shape follows its table of shapes; copy it again")
    return tried(lambda: _model(data), seconds=20 + len(data) / 1e6)


def _model(data: bytes) -> Model:
    shape = TopoDS_Shape()
    BRepTools.Read_s(shape, io.BytesIO(data), BRep_Builder())
    if shape.IsNull():
        raise InputError("is not valid BREP; export it again")
    bodies = (NamedSolid(f"solid {i}", Solid(solid)) for i, solid in enumerate(solids_of(shape), start=1))
    return Model(tuple(bodies), None)
