"""PCD: the format of the Point Cloud Library.

Lines of text (VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS), then
``DATA ascii``, ``binary`` or ``binary_compressed`` and the points: rows of text, packed
little-endian records, or, compressed with LZF, one array per field. FIELDS may stand in
any order and case; NaN marks an invalid point. VIEWPOINT is where the scanner stood and
does not move the points.

References
----------
https://pointclouds.org/documentation/tutorials/pcd_file_format.html
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, PointCloud
from sketchloft.errors import InputError
from sketchloft.io.fields import line_feeds, sniff
from sketchloft.io.format import Format
from sketchloft.io.lzf import decompress
from sketchloft.io.pcd_header import Header, parse_header
from sketchloft.io.rows import read_rows, take

__all__ = ["FORMAT"]

_DATA = re.compile(rb"^DATA[ \t]+(\w+)[ \t]*\r?\n?", re.MULTILINE | re.IGNORECASE)


def _read(path: Path) -> PointCloud:
    data = path.read_bytes()
    end = _DATA.search(data)
    if end is None:
        raise InputError("the PCD header has no line DATA; the file was cut short, or is no PCD")
    header = parse_header(data[: end.start()].decode("ascii", "replace"))
    body, encoding = data[end.end() :], end[1].lower()
    if encoding == b"ascii":
        return PointCloud.of(_read_ascii(body, header, data.count(b"\n", 0, end.end()) + 1))
    if encoding == b"binary":
        return PointCloud.of(_read_binary(body, header))
    if encoding == b"binary_compressed":
        return PointCloud.of(_read_compressed(body, header))
    raise InputError(f"DATA is {end[1].decode()!r}, expected ascii, binary or binary_compressed")


def _read_ascii(body: bytes, header: Header, first_line: int) -> Floats:
    body = line_feeds(body)
    first = np.cumsum((0, *header.counts))
    x, y, z = (int(first[header.index(name)]) for name in "xyz")
    rows, passed = take(body, 0, header.n_points)
    return read_rows(rows, (x, y, z), sniff(rows.lstrip().partition(b"\n")[0]), first_line + passed)


def _read_binary(body: bytes, header: Header) -> Floats:
    record = np.dtype(
        [(f"{i}", t, (n,)) for i, (t, n) in enumerate(zip(header.types, header.counts, strict=True))]
    )
    _check_room(len(body), record.itemsize, header.n_points)
    rows = np.frombuffer(body, record, header.n_points)
    return _stack([rows[f"{header.index(name)}"][:, 0] for name in "xyz"])


def _read_compressed(body: bytes, header: Header) -> Floats:
    if len(body) < 8:
        raise InputError("the compressed PCD holds no data; it was cut short")
    packed, length = (int(n) for n in np.frombuffer(body, "<u4", 2))
    if len(body) - 8 < packed:
        raise InputError(
            f"the header promises {packed} compressed bytes, the file holds {len(body) - 8}; it was cut short"
        )
    try:
        data = decompress(body[8 : 8 + packed])
    except ValueError as error:
        raise InputError(f"the compressed PCD is damaged: {error}") from None
    if len(data) != length:
        raise InputError(f"the compressed PCD is damaged: {len(data)} bytes where {length} are expected")
    sizes = [t.itemsize * n for t, n in zip(header.types, header.counts, strict=True)]
    _check_room(length, sum(sizes), header.n_points)
    starts = np.cumsum([0, *sizes]) * header.n_points
    order = [header.index(name) for name in "xyz"]
    return _stack([np.frombuffer(data, header.types[i], header.n_points, int(starts[i])) for i in order])


def _check_room(room: int, size: int, n_points: int) -> None:
    if room < size * n_points:
        raise InputError(
            f"the header promises {n_points} points, the file holds {room // size}; it was cut short"
        )


def _stack(columns: list[NDArray[Any]]) -> Floats:
    return np.stack(columns, axis=1).astype(np.float64)


def _write(path: Path, cloud: PointCloud) -> None:
    n = len(cloud)
    header = (
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\n"
        f"COUNT 1 1 1\nWIDTH {n}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA binary\n"
    )
    path.write_bytes(header.encode() + cloud.points.astype("<f8").tobytes())


FORMAT = Format(
    name="pcd",
    suffixes=(".pcd",),
    description="PCD of the Point Cloud Library: ascii, binary, binary_compressed",
    read=_read,
    write=_write,
    starts=(b"# .PCD", b"VERSION 0.", b"VERSION .", b"#.PCD"),
)
