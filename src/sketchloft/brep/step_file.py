"""STEP: ISO 10303-21 files with the schema AP242."""

from __future__ import annotations

import io
import re
from pathlib import Path

from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
from OCP.collections import Sequence_TCollection_AsciiString
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.STEPCAFControl import STEPCAFControl_Reader, STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_StepModelType
from OCP.TCollection import TCollection_HAsciiString

from sketchloft.brep.document import bodies_of, document_of, empty_document
from sketchloft.brep.format import Meshes
from sketchloft.brep.model import Model
from sketchloft.brep.trial import tried
from sketchloft.cloud import Unit
from sketchloft.errors import InputError, OutputError

__all__ = ["TIME_STAMP", "parsed", "read", "write"]

TIME_STAMP = "2000-01-01T00:00:00"
"""Time in the header: a fixed one, so that the same model gives the same bytes."""

_WRITTEN: dict[Unit, str] = {"mm": "MM", "cm": "CM", "m": "M", "in": "INCH"}
_FOUND: dict[str, Unit] = {"millimetre": "mm", "centimetre": "cm", "metre": "m", "inch": "in"}
_END = b"END-ISO-10303-21;"


def write(model: Model, meshes: Meshes, time_stamp: str = TIME_STAMP) -> bytes:  # noqa: ARG001 - exact
    """Make the text of a STEP file: one product per body, numbers in the model's unit.

    Parameters
    ----------
    model : Model
    meshes : callable
        Not used: the file holds the exact surfaces.
    time_stamp : str
        ISO 8601 date and time for the header.
    """
    writer = STEPCAFControl_Writer()
    # The kernel keeps these as process-wide settings; every call sets all it depends on.
    Interface_Static.SetCVal_s("write.step.schema", "AP242DIS")
    Interface_Static.SetCVal_s("write.step.unit", _WRITTEN[model.written_unit])
    Interface_Static.SetIVal_s("write.surfacecurve.mode", 1)
    if not writer.Transfer(document_of(model), STEPControl_StepModelType.STEPControl_AsIs):
        raise OutputError("the CAD kernel cannot express the solids as STEP; write BREP instead")
    header = APIHeaderSection_MakeHeader(writer.ChangeWriter().Model())
    header.SetTimeStamp(TCollection_HAsciiString(time_stamp))
    header.SetName(TCollection_HAsciiString(", ".join(body.name for body in model.bodies)))
    header.SetAuthorValue(1, TCollection_HAsciiString(""))
    header.SetOrganizationValue(1, TCollection_HAsciiString(""))
    header.SetOriginatingSystem(TCollection_HAsciiString("sketchloft"))
    header.SetAuthorisation(TCollection_HAsciiString(""))
    stream = io.BytesIO()
    if writer.WriteStream(stream) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OutputError("the CAD kernel failed to write STEP; write BREP instead")
    return _encoded(stream.getvalue().decode("utf-8"))


def read(path: Path) -> Model:
    """Read the solids of a STEP file; coordinates come in the file's own unit.

    Raises
    ------
    InputError
        If the text is not STEP, was cut short, or holds no solid.
    """
    data = path.read_bytes()
    if not data.lstrip().startswith(b"ISO-10303-21"):
        raise InputError("is not a STEP file: it does not start with ISO-10303-21")
    if _END not in data[-200:]:
        raise InputError(f"is cut short: a STEP file ends with {_END.decode()}; copy it again")
    return tried(lambda: parsed(data), seconds=20 + len(data) / 1e6)


def parsed(data: bytes) -> Model:
    """Read the solids of the bytes of a whole STEP file.

    Raises
    ------
    InputError
        If the text is not STEP, or holds no solid.
    """
    reader = STEPCAFControl_Reader()
    if reader.ReadStream("model", io.BytesIO(data)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise InputError("is not valid STEP; export it again")
    unit = _unit(reader)
    document = empty_document(unit)
    if not reader.Transfer(document):
        raise InputError("holds STEP that the CAD kernel cannot make shapes of; export it as AP214 or AP242")
    return Model(bodies_of(document), unit)


def _unit(reader: STEPCAFControl_Reader) -> Unit:
    """Unit of length of the file; millimetres, to which the kernel converts, if it is another one."""
    lengths, angles, solid_angles = (Sequence_TCollection_AsciiString() for _ in range(3))
    reader.ChangeReader().FileUnits(lengths, angles, solid_angles)
    found = {lengths.Value(i).ToCString().lower() for i in range(1, lengths.Length() + 1)}
    return _FOUND.get(found.pop(), "mm") if len(found) == 1 else "mm"


def _encoded(text: str) -> bytes:
    r"""Write characters beyond ASCII as the standard wants them: \X2\....\X0\ (ISO 10303-21, 6.4.3)."""

    def escaped(run: re.Match[str]) -> str:
        wide = any(ord(character) > 0xFFFF for character in run[0])
        codec, mark = ("utf-32-be", "\\X4\\") if wide else ("utf-16-be", "\\X2\\")
        return f"{mark}{run[0].encode(codec).hex().upper()}\\X0\\"

    return re.sub(r"[^\x00-\x7f]+", escaped, text).encode("ascii")
