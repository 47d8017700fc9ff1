"""The kernel's document, which carries names and the unit into STEP and IGES files and back."""

from __future__ import annotations

from OCP.collections import Sequence_TDF_Label
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFDoc import XCAFDoc_DocumentTool

from sketchloft.brep.explore import solids_of
from sketchloft.brep.model import METRES, Model, NamedSolid
from sketchloft.brep.solid import Solid
from sketchloft.cloud import Unit

__all__ = ["bodies_of", "document_of", "empty_document"]


def empty_document(unit: Unit) -> TDocStd_Document:
    """Make a document whose coordinates are in `unit`."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFDoc_DocumentTool.SetLengthUnit_s(document, METRES[unit])
    return document


def document_of(model: Model) -> TDocStd_Document:
    """Make a document of a model, one part per body."""
    document = empty_document(model.written_unit)
    parts = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    for body in model.bodies:
        label = parts.AddShape(body.solid.shape, False)
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(body.name, True))
    return document


def bodies_of(document: TDocStd_Document) -> tuple[NamedSolid, ...]:
    """Solids of a document by name; a part of several solids gives each its name."""
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    labels = Sequence_TDF_Label()
    tool.GetFreeShapes(labels)
    bodies: list[NamedSolid] = []
    for i in range(1, labels.Length() + 1):
        label = labels.Value(i)
        name = _name(label)
        bodies += [NamedSolid(name, Solid(solid)) for solid in solids_of(tool.GetShape_s(label))]
    return tuple(bodies)


def _name(label: TDF_Label) -> str:
    name = TDataStd_Name()
    return str(name.Get().ToExtString()) if label.FindAttribute(TDataStd_Name.GetID_s(), name) else ""
