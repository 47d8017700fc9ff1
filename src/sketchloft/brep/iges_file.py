"""IGES: version 5.3 files with manifold solids."""

from __future__ import annotations

import io
import unicodedata
from dataclasses import replace
from pathlib import Path

from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.IGESCAFControl import IGESCAFControl_Reader, IGESCAFControl_Writer
from OCP.IGESControl import IGESControl_Controller
from OCP.Interface import Interface_Static
from OCP.TCollection import TCollection_HAsciiString

from sketchloft.brep.document import bodies_of, document_of, empty_document
from sketchloft.brep.format import Meshes
from sketchloft.brep.model import Model
from sketchloft.brep.trial import tried
from sketchloft.cloud import Unit
from sketchloft.errors import InputError, OutputError

__all__ = ["read", "write"]

TIME_STAMP = "20000101.000000"
"""Date of the file and of its change, fixed so that the same model gives the same bytes."""

_WRITTEN: dict[Unit, str] = {"mm": "MM", "cm": "CM", "m": "M", "in": "INCH"}
_FLAGS: dict[int, Unit] = {1: "in", 2: "mm", 6: "m", 10: "cm"}  # IGES 5.3, table 2.2.4.3.14
_MSBO = 1  # solids as entity 186, not loose faces


def write(model: Model, meshes: Meshes) -> bytes:  # noqa: ARG001 - exact
    """Make the text of an IGES file. Characters of names that ASCII lacks lose their accents or become _."""
    IGESControl_Controller.Init_s()
    # The kernel keeps these as process-wide settings; every call sets all it depends on.
    Interface_Static.SetIVal_s("write.iges.brep.mode", _MSBO)
    Interface_Static.SetCVal_s("write.iges.unit", _WRITTEN[model.written_unit])
    Interface_Static.SetCVal_s("write.iges.header.author", "")
    writer = IGESCAFControl_Writer()
    bodies = tuple(replace(body, name=_ascii(body.name)) for body in model.bodies)
    if not writer.Transfer(document_of(replace(model, bodies=bodies))):
        raise OutputError("the CAD kernel cannot express the solids as IGES; write STEP instead")
    header = writer.Model().GlobalSection()
    header.SetDate(TCollection_HAsciiString(TIME_STAMP))
    header.SetLastChangeDate(TCollection_HAsciiString(TIME_STAMP))
    writer.Model().SetGlobalSection(header)
    stream = io.BytesIO()
    if not writer.Write(stream):
        raise OutputError("the CAD kernel failed to write IGES; write STEP instead")
    return stream.getvalue()


def read(path: Path) -> Model:
    """Read the solids of an IGES file; coordinates come in the file's own unit.

    Raises
    ------
    InputError
        If the text is not IGES, was cut short, or the kernel cannot read it.
    """
    with path.open("rb") as file:
        first = file.readline(200).rstrip()
        file.seek(-min(200, path.stat().st_size), io.SEEK_END)
        last = file.read().rstrip()[-80:]
    if first[72:73] != b"S":
        raise InputError("is not an IGES file: its first line has no S in column 73")
    if last[72:73] != b"T":
        raise InputError("is cut short: the last line of an IGES file has a T in column 73; copy it again")
    return tried(lambda: _model(path), seconds=20 + path.stat().st_size / 1e6)


def _model(path: Path) -> Model:
    reader = IGESCAFControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise InputError("is not valid IGES; export it again")
    unit = _FLAGS.get(reader.IGESModel().GlobalSection().UnitFlag(), "mm")
    document = empty_document(unit)
    if not reader.Transfer(document):
        raise InputError("holds IGES that the CAD kernel cannot turn into shapes; export it as STEP")
    return Model(bodies_of(document), unit)


def _ascii(name: str) -> str:
    plain = unicodedata.normalize("NFKD", name.replace("ß", "ss"))
    return "".join(c if c.isascii() else "_" for c in plain if not unicodedata.combining(c))
