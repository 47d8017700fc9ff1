"""PLY: the Stanford triangle format.

A header of lines: ``ply``, ``format ascii|binary_little_endian|binary_big_endian 1.0``,
then elements in the order of the body, ``element NAME COUNT`` with their properties,
``property TYPE NAME`` or ``property list LENGTH_TYPE TYPE NAME``, and ``end_header``. The
points are x, y and z of the element vertex, wherever it stands; the rest is passed over.

Written as little-endian doubles.

References
----------
Greg Turk, The PLY polygon file format, 1994. https://paulbourke.net/dataformats/ply/
"""

from __future__ import annotations

import itertools
from pathlib import Path

from sketchloft.cloud import Floats, PointCloud
from sketchloft.errors import InputError
from sketchloft.io.fields import BLANK, line_feeds
from sketchloft.io.format import Format
from sketchloft.io.ply_binary import end_of, read_columns
from sketchloft.io.ply_header import Element, Header, parse_header
from sketchloft.io.rows import read_rows, take

__all__ = ["FORMAT"]


def _read(path: Path) -> PointCloud:
    data = path.read_bytes()
    header = parse_header(data)
    before = tuple(itertools.takewhile(lambda element: element.name != "vertex", header.elements))
    if len(before) == len(header.elements):
        raise InputError("the PLY header has no element vertex, so the file holds no points")
    vertex = header.elements[len(before)]
    columns = _columns(vertex)
    if header.is_ascii:
        return PointCloud.of(_read_ascii(data, header, sum(one.count for one in before), vertex, columns))
    at = header.start
    for element in before:
        at = end_of(data, element, at)
    return PointCloud.of(read_columns(data, vertex, at, columns))


def _columns(vertex: Element) -> tuple[int, int, int]:
    places = {one.name.lower(): k for k, one in enumerate(vertex.properties) if one.length is None}
    if not places.keys() >= set("xyz"):
        found = ", ".join(one.name for one in vertex.properties) or "none"
        raise InputError(f"the properties of the PLY's vertices are {found}, expected x, y and z among them")
    return places["x"], places["y"], places["z"]


def _read_ascii(
    data: bytes, header: Header, n_before: int, vertex: Element, columns: tuple[int, int, int]
) -> Floats:
    if any(one.length is not None for one in vertex.properties[: max(columns)]):
        raise InputError("the ASCII PLY has a list before x, y or z of its vertices; convert it to binary")
    body = line_feeds(data[header.start :])
    rows, n_passed = take(body, n_before, vertex.count)
    return read_rows(rows, columns, BLANK, header.n_lines + n_passed + 1)


def _write(path: Path, cloud: PointCloud) -> None:
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(cloud)}\n"
        "property double x\nproperty double y\nproperty double z\nend_header\n"
    )
    path.write_bytes(header.encode() + cloud.points.astype("<f8").tobytes())


FORMAT = Format(
    name="ply",
    suffixes=(".ply",),
    description="PLY, ASCII or binary; vertices of meshes too",
    read=_read,
    write=_write,
    starts=(b"ply\n", b"ply\r", b"ply "),
)
