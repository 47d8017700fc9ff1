"""NPY: one numpy array.

Either (n, 3) or more columns of real numbers, x y z first, or a structured array with
fields x, y and z in any case. Arrays of Python objects are refused, because reading them
can run code.

References
----------
https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from sketchloft.cloud import Floats, PointCloud
from sketchloft.errors import InputError
from sketchloft.io.format import Format

__all__ = ["FORMAT"]

MAGIC = b"\x93NUMPY"


def _read(path: Path) -> PointCloud:
    with path.open("rb") as file:
        shape, dtype = _read_header(file)
        room = path.stat().st_size - file.tell()
        file.seek(0)
        if dtype.hasobject:
            raise InputError("holds Python objects, expected an (n, 3) array of numbers")
        promised = int(np.prod(shape, dtype=object))
        if promised * dtype.itemsize > room:
            raise InputError(
                f"the header promises {promised} values in shape {shape}, the file holds "
                f"{room // dtype.itemsize}; it was cut short"
            )
        try:
            array = np.load(file, allow_pickle=False)
        except ValueError:
            raise InputError(f"an array of type {dtype} and shape {shape} cannot be read") from None
    return PointCloud.of(_points(array))


def _read_header(file: BinaryIO) -> tuple[tuple[int, ...], np.dtype[Any]]:
    if file.read(len(MAGIC)) != MAGIC:
        raise InputError("does not begin like an NPY file; check its extension")
    file.seek(0)
    try:
        if np.lib.format.read_magic(file) == (1, 0):
            shape, _, dtype = np.lib.format.read_array_header_1_0(file)
        else:  # 3.0 differs from 2.0 in its encoding, which only names of fields can show
            shape, _, dtype = np.lib.format.read_array_header_2_0(file)
    except OSError:
        raise
    except Exception:  # numpy parses the header as Python source, which can fail in many ways
        raise InputError("the NPY header cannot be understood; the file is damaged or cut short") from None
    return shape, dtype


def _points(array: NDArray[Any]) -> Floats:
    fields = {name.lower(): name for name in reversed(array.dtype.names or ())}
    if fields:
        missing = [name for name in "xyz" if name not in fields]
        if missing or any(array[fields[name]].ndim != 1 for name in "xyz"):
            raise InputError(
                f"holds an array of shape {array.shape} with fields {', '.join(array.dtype.names or ())}, "
                "expected one dimension and fields x, y and z of one number each"
            )
        columns = [array[fields[name]] for name in "xyz"]
        return np.stack([_numbers(column) for column in columns], axis=1)
    if array.ndim != 2 or array.shape[1] < 3:
        raise InputError(f"holds an array of shape {array.shape}, expected (n, 3): a row x, y, z per point")
    if len(array) == 3 < array.shape[1]:
        raise InputError(f"holds an array of shape {array.shape}, expected (n, 3); save its transpose")
    return _numbers(array[:, :3])


def _numbers(array: NDArray[Any]) -> Floats:
    if array.dtype.kind not in "iuf":
        raise InputError(f"holds values of type {array.dtype}, expected real numbers")
    return np.array(array, dtype=np.float64, order="C")


def _write(path: Path, cloud: PointCloud) -> None:
    with path.open("wb") as file:
        np.save(file, np.ascontiguousarray(cloud.points, dtype="<f8"), allow_pickle=False)


FORMAT = Format(
    name="npy",
    suffixes=(".npy",),
    description="NumPy array (n, 3), or with fields x, y, z",
    read=_read,
    write=_write,
    starts=(MAGIC,),
)
