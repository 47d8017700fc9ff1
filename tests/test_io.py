"""The input room: every format round-trips, every dialect is read, every broken file says what is wrong."""

from __future__ import annotations

import itertools
import os
import re
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sketchloft import io as room
from sketchloft.cloud import Floats, PointCloud
from sketchloft.errors import InputError, OutputError, SketchloftError, UsageError
from sketchloft.io import FORMATS, Format, format_of, read_cloud, rows, write_cloud
from sketchloft.io.fields import is_number
from sketchloft.io.lzf import decompress

DATA = Path(__file__).parents[2] / "shared" / "data"
SUFFIXES = [suffix for one in FORMATS if one.write for suffix in one.suffixes]
THREE = np.array([[1.5, -2.0, 0.25], [4.0, 5e-3, -6.0], [7.0, 8.0, 1e3]])

clouds = hnp.arrays(np.float64, st.tuples(st.integers(1, 20), st.just(3)), elements=st.floats(width=64))
quick = settings(max_examples=25, deadline=None)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("clouds")


@pytest.fixture(params=[0, 1 << 40], ids=["polars", "numpy"])
def parser(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rows, "POLARS_FROM", request.param)


def read(path: Path, content: bytes) -> Floats:
    path.write_bytes(content)
    return read_cloud(path).points


def fault(path: Path, content: bytes | None = None) -> str:
    """Return what is wrong with a file, less its name."""
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_cloud(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    return message.removeprefix(f"{path}: ")


# The registry


def test_no_two_formats_share_a_name_or_an_extension() -> None:
    names = [one.name for one in FORMATS]
    suffixes = [suffix for one in FORMATS for suffix in one.suffixes]
    assert len(set(names)) == len(names)
    assert len(set(suffixes)) == len(suffixes)
    assert all(re.fullmatch(r"\.[a-z0-9]+", suffix) for suffix in suffixes)


@pytest.mark.parametrize("suffix", [suffix for one in FORMATS for suffix in one.suffixes])
def test_the_extension_tells_the_format_in_any_case(suffix: str) -> None:
    assert suffix in format_of(f"a.b{suffix}").suffixes
    assert format_of(Path("a" + suffix.upper())) is format_of("a" + suffix)


@pytest.mark.parametrize("name", ["cloud.las", "cloud", "cloud.ply.gz"])
def test_an_unknown_extension_lists_the_known_ones(name: str) -> None:
    with pytest.raises(InputError) as caught:
        format_of(name)
    assert all(suffix in str(caught.value) for suffix in SUFFIXES)


def test_the_format_can_be_named(tmp_path: Path) -> None:
    path = tmp_path / "scan.dat"
    path.write_bytes(b"1 2 3\n")
    assert len(read_cloud(path, format="text")) == 1
    with pytest.raises(UsageError, match="text, npy, ply, pcd"):
        read_cloud(path, format="las")


def test_unit_and_name_come_with_the_cloud(tmp_path: Path) -> None:
    path = tmp_path / "my lamp.v2.xyz"
    path.write_bytes(b"1 2 3\n")
    cloud = read_cloud(os.fspath(path), unit="in")
    assert (cloud.unit, cloud.name) == ("in", "my lamp.v2")
    with pytest.raises(UsageError, match="mm, cm, m, in"):
        read_cloud(path, unit="furlong")  # type: ignore[arg-type]


# Round trips


@pytest.mark.parametrize("suffix", SUFFIXES)
@given(points=clouds)
@example(points=np.array([[np.nan, np.inf, -np.inf], [5e-324, -0.0, 1.7976931348623157e308]]))
@quick
def test_every_format_gives_every_bit_back(folder: Path, suffix: str, points: Floats) -> None:
    path = folder / f"round{suffix}"
    write_cloud(path, PointCloud.of(points))
    written = path.read_bytes()
    back = read_cloud(path).points
    np.testing.assert_array_equal(back, points)
    finite = ~np.isnan(points)
    np.testing.assert_array_equal(np.signbit(back[finite]), np.signbit(points[finite]))
    assert back.flags.c_contiguous
    assert back.flags.writeable
    assert path.read_bytes() == written


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_the_same_cloud_gives_the_same_bytes(tmp_path: Path, suffix: str) -> None:
    write_cloud(tmp_path / f"a{suffix}", PointCloud.of(THREE))
    write_cloud(tmp_path / f"b{suffix}", PointCloud.of(np.asfortranarray(THREE)))
    assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("suffix", SUFFIXES)
@given(data=st.data())
@quick
def test_a_damaged_file_is_read_or_refused(folder: Path, suffix: str, data: st.DataObject) -> None:
    path = folder / f"damaged{suffix}"
    write_cloud(path, PointCloud.of(THREE))
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(1, len(content)))])
    try:
        assert read_cloud(path).points.shape[1] == 3
    except InputError as error:
        assert "\n" not in str(error)  # noqa: PT017 - either outcome is right


@pytest.mark.parametrize("suffix", [".npy", ".ply", ".pcd"])
def test_a_binary_file_cut_anywhere_is_refused(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"cut{suffix}"
    write_cloud(path, PointCloud.of(THREE))
    content = path.read_bytes()
    for n in range(1, len(content)):
        fault(path, content[:n])
    assert re.search(r"promises \d+ \w+.*the file holds [28]; it was cut short", fault(path, content[:-1]))


# Text


@pytest.mark.usefixtures("parser")
@pytest.mark.parametrize(
    "content",
    [
        b"1.5 -2 .25\n4 5e-3 -6.\n7 8 1E+3\n",
        b"1.5 -2 .25\n4 5e-3 -6.\n7 8 1e3",
        b"\n  1.5   -2\t .25  \r\n\r\n\t4 5e-3 -6\r\n   \r\n7 8 1e3 \r\n\r\n",
        b"1.5\t-2\t.25\n4\t5e-3\t-6\n7\t8\t1e3\n",
        b"1.5\t-2\t.25\ta b\n4\t5e-3\t-6\t\n7\t8\t1e3\tc d\n",
        b"1.5,-2,.25\r4,5e-3,-6\r7,8,1e3\r",
        b"1.5 , -2,\t.25 \n4 ,5e-3, -6\n 7,8,1e3\n",
        b"1.5;-2;.25\n4;5e-3;-6\n7;8;1e3\n",
        b"1,5;-2;0,25\n4;0,005;-6\n7;8;1e3\n",
        b"1.5 -2 .25 9 9\n4 5e-3 -6 9 9\n7 8 1e3 9 9",
        b"1.5 -2 .25 red\n4 5e-3 -6 \xff\xfe\n7 8 1e3 blue\n",
        b"1.5,-2,.25,\n4,5e-3,-6,\n7,8,1e3,\n",
        b"# a cloud\n// of three\n1.5 -2 .25 # first\n4 5e-3 -6\n#end\n7 8 1e3 // last\n# done",
        b"x y z\n1.5 -2 .25\n4 5e-3 -6\n7 8 1e3\n",
        b'"X","Y","Z"\n"1.5","-2",".25"\n"4","5e-3","-6"\n"7","8","1e3"\n',
        b'"X" "Y" "Z" intensity\n1.5 -2 .25 9\n4 5e-3 -6 9\n7 8 1e3 9\n',
        b'"Point ID" "X" "Y" "Z"\n1 1.5 -2 .25\n2 4 5e-3 -6\n3 7 8 1e3\n',
        b"id; Z ;y; X\na;.25;-2;1.5\nb;-6;5e-3;4\nc;1e3;8;7\n",
        b"X,Y,Z,\n1.5,-2,.25\n4,5e-3,-6\n7,8,1e3\n",
        b"X,Y,Z\n1.5,-2,.25,\n4,5e-3,-6,\n7,8,1e3,\n",
        b"X,Y,Z,label\n1.5,-2,.25,a\n4,5e-3,-6,b\n7,8,1e3,\n",
        b"// Z Y X\n.25 -2 1.5\n-6 5e-3 4\n1e3 8 7\n",
        b"//X Y Z R G B\n3\n1.5 -2 .25 1 1 1\n4 5e-3 -6 1 1 1\n7 8 1e3 1 1 1\n",
        b"# exported x y z of my cloud\n1.5 -2 .25\n4 5e-3 -6\n7 8 1e3\n",
        b"3\n1.5 -2 .25\n4 5e-3 -6\n7 8 1e3\n",
        b"\xef\xbb\xbfx,y,z\n1.5,-2,.25\n4,5e-3,-6\n7,8,1e3\n",
        "x\ty\tz\r\n1.5\t-2\t.25\r\n4\t5e-3\t-6\r\n7\t8\t1e3\r\n".encode("utf-16"),
    ],
)
@pytest.mark.parametrize("suffix", [".txt", ".pts"])
def test_every_dialect_of_text_is_read(tmp_path: Path, suffix: str, content: bytes) -> None:
    np.testing.assert_array_equal(read(tmp_path / f"a{suffix}", content), THREE)


@pytest.mark.usefixtures("parser")
@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"1 2 3\n4 5 6\n7 8", "line 3 ('7 8') ends the file after 2 values where the line before has 3"),
        (b"1 2 3 9\r\n4 5 6 9\r\n\r\n7 8 9", "line 4 ('7 8 9') ends the file after 3 values"),
        (b"1 2 3\n4 5 6\n7 8 -", "line 3 ('7 8 -'): z is '-', expected a number (nan if unknown)"),
        (b"1 2 3\n\n# 9\n4 5\n6 7 8\n", "line 4 ('4 5') is too short: 2 of at least 3 values"),
        (b"1,2,3\n4,,6\n", "line 2 ('4,,6'): y is '', expected a number (nan if unknown)"),
        (b"1,2,3\n4,5 5,6\n", "line 2 ('4,5 5,6'): y is '5 5'"),
        (b"1\t2\t3\n4\t5,5\t6\n", "line 2 ('4\\t5,5\\t6'): y is '5,5'"),
        (b"1 2 3\n1_0 2 3\n", "line 2 ('1_0 2 3'): x is '1_0'"),
        (b"1 2 3\n0x1 2 3\n", "x is '0x1'"),
        (b"1 2 3\n\xd9\xa3 2 3\n", "x is '\u0663'"),
        (b"x,y,z,i\n1,2,3,4\n5,6\n7,8,9,1\n", "line 3 ('5,6') is too short: 2 of at least 3 values"),
        (b"i,z,y,x\n1,2,3,4\n5,6,7,a\n7,8,9,1\n", "line 3 ('5,6,7,a'): x is 'a'"),
        (b"1 2\n3 4\n", "line 1 ('1 2') is too short: 2 of at least 3 values"),
        (b"1\n2\n3\n", "line 2 ('2') is too short: 1 of at least 3 values"),
        (b"U V W\n1 2 3\n", "line 1 ('U V W') is neither a row of numbers nor a header"),
        (b"X,Y,X\n1,2,3\n", "line 1 ('X,Y,X') is neither a row of numbers nor a header"),
        (b"My cloud\nx y z\n1 2 3\n", "line 1 ('My cloud') is neither"),
        (b"x" * 200_000, "is neither a row of numbers nor a header"),
        (
            b'"x" "y" "z"\n"1" .1 .2 .3\n',
            "header names 3 columns, but line 2 ('\"1\" .1 .2 .3') has 4 values",
        ),
        (b"Point ID X Y Z R\n1 2 3 4 5\n", "the header names 6 columns, but line 2"),
        (b"x y z\n", "holds no points"),
        (b"# nothing here\n\n", "holds no points"),
        (b"3\n", "holds no points"),
        (b"1 2 3\0\0\0\n", "found binary data, expected text"),
        (b"3\n1 2 3\n4 5 6\n", "the count line promises 3 points, the file holds 2; it was cut short"),
        (b"1\n1 2 3\n4 5 6\n", "the count line promises 1 points, the file holds 2; it has a wrong count"),
    ],
)
def test_broken_text_names_its_line(tmp_path: Path, content: bytes, message: str) -> None:
    assert message in fault(tmp_path / "a.txt", content)


@pytest.mark.usefixtures("parser")
def test_a_fault_deep_in_a_large_file_is_found(tmp_path: Path) -> None:
    lines = [b"1 2 3"] * 110_000
    lines[100_000] = b"1 two 3"
    assert "line 100001 ('1 two 3'): y is 'two'" in fault(tmp_path / "a.xyz", b"\n".join(lines))


@pytest.mark.usefixtures("parser")
def test_a_point_that_is_not_finite_stays(tmp_path: Path) -> None:
    points = read(tmp_path / "a.csv", b"x,y,z\n1,2,3\nnan,NaN,-nan\ninf,-Infinity,+INF\n")
    np.testing.assert_array_equal(points, [[1, 2, 3], [np.nan] * 3, [np.inf, -np.inf, np.inf]])


TOKENS = ["nan", "-NaN", "inf", "Infinity", "1.", ".5", ".", "", "+", "1e", "1e5", "1E-5", "1D3", "1e400"]
TOKENS += [
    "4.9e-324",
    "0x10",
    "1_0",
    "1f",
    "--1",
    "1..2",
    "True",
    "NA",
    "null",
    "infinit",
    "+-1",
    "1e5.0",
    "00",
]


@given(token=st.sampled_from(TOKENS) | st.from_regex(r"\A[-+]?[0-9.]{1,30}(e[-+]?[0-9]{1,3})?\Z"))
@settings(max_examples=80, deadline=None)
def test_both_parsers_agree_on_what_a_number_is(folder: Path, token: str) -> None:
    path = folder / "token.csv"
    text = f"1,2,3\n0,{token},0\n".encode()
    outcomes: list[Any] = []
    for limit in (0, 1 << 40):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(rows, "POLARS_FROM", limit)
            try:
                outcomes.append(read(path, text).tobytes())
            except InputError as error:
                outcomes.append(str(error))
    assert outcomes[0] == outcomes[1]
    assert isinstance(outcomes[0], bytes) == is_number(token.encode())
    if is_number(token.encode()):
        np.testing.assert_array_equal(np.frombuffer(outcomes[0])[4], float(token))


def test_a_large_text_file_goes_through_polars_a_small_one_does_not(tmp_path: Path) -> None:
    small, large = tmp_path / "small.xyz", tmp_path / "large.xyz"
    small.write_bytes(b"1 2 3\n" * 10)
    large.write_bytes(b"1 2 3\n" * (rows.POLARS_FROM // 6 + 1))
    code = (
        "import sys; from sketchloft.io import read_cloud\n"
        f"n = len(read_cloud({str(small)!r})); print(n, 'polars' in sys.modules)\n"
        f"n = len(read_cloud({str(large)!r})); print(n, 'polars' in sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["10", "False", str(rows.POLARS_FROM // 6 + 1), "True"]


def test_csv_has_a_header_pts_a_count_and_xyz_neither(tmp_path: Path) -> None:
    lines = {}
    for suffix in (".csv", ".pts", ".xyz"):
        write_cloud(tmp_path / f"a{suffix}", PointCloud.of(THREE[:1]))
        lines[suffix] = (tmp_path / f"a{suffix}").read_text().splitlines()
    assert lines == {
        ".csv": ["x,y,z", "1.5,-2.0,0.25"],
        ".pts": ["1", "1.5 -2.0 0.25"],
        ".xyz": ["1.5 -2.0 0.25"],
    }


# NPY


@pytest.mark.parametrize(
    "array",
    [
        THREE.astype(">f8"),
        THREE.astype("f4"),
        np.asfortranarray(THREE),
        np.hstack([THREE, THREE]).T.copy().T,
        np.array([tuple(row) for row in THREE[:, ::-1]], [("Z", "f8"), ("Y", ">f4"), ("X", "f8")]),
        np.array([(7, *row) for row in THREE], [("größe", "u1"), ("x", "f8"), ("y", "f8"), ("z", "f8")]),
    ],
)
def test_arrays_of_any_layout_are_read(tmp_path: Path, array: np.ndarray[Any, Any]) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("warnings.warn", lambda *_, **__: None)  # numpy's, on writing names beyond latin-1
        np.save(tmp_path / "a.npy", array[:2])
    np.testing.assert_allclose(read_cloud(tmp_path / "a.npy").points, THREE[:2], rtol=1e-7)


def test_whole_numbers_are_read(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.arange(12, dtype=np.uint16).reshape(4, 3))
    np.testing.assert_array_equal(read_cloud(tmp_path / "a.npy").points, np.arange(12.0).reshape(4, 3))


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros(3), r"shape \(3,\), expected \(n, 3\)"),
        (np.zeros((5, 2)), r"shape \(5, 2\), expected \(n, 3\)"),
        (np.zeros((3, 500)), "save its transpose"),
        (np.zeros((0, 3)), "holds no points"),
        (np.array(1.0), r"shape \(\)"),
        (np.zeros((5, 3), complex), "type complex128, expected real numbers"),
        (np.full((5, 3), "a"), "type <U1, expected real numbers"),
        (np.zeros((5, 3), bool), "type bool, expected real numbers"),
        (np.full((5, 3), None), "Python objects"),
        (np.zeros(5, [("x", "f8"), ("y", "f8")]), "fields x, y, expected"),
        (np.zeros(5, [("x", "f8"), ("y", "U3"), ("z", "f8")]), "expected real numbers"),
        (np.zeros(5, [("x", "f8", 2), ("y", "f8", 2), ("z", "f8", 2)]), "of one number each"),
    ],
)
def test_arrays_that_are_no_cloud_are_refused(
    tmp_path: Path, array: np.ndarray[Any, Any], message: str
) -> None:
    np.save(tmp_path / "a.npy", array)
    assert re.search(message, fault(tmp_path / "a.npy"))


# PLY


ORDERS = {"<": "binary_little_endian", ">": "binary_big_endian"}
VERTEX = "element vertex {n}\nproperty {t} x\nproperty {t} y\nproperty {t} z\n"


def ply(encoding: str, elements: str, body: bytes, end: str = "\n") -> bytes:
    header = f"ply\nformat {encoding} 1.0\ncomment made by a test\nobj_info none\n{elements}end_header\n"
    return header.replace("\n", end).encode() + body


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", " \n"])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize(
    ("name", "code"), [("float", "f4"), ("float64", "f8"), ("short", "i2"), ("uint8", "u1")]
)
def test_binary_ply_of_every_order_and_type(
    tmp_path: Path, end: str, order: str, name: str, code: str
) -> None:
    values = np.arange(10, 22).reshape(4, 3)  # 10 and 13 are the line ends
    content = ply(ORDERS[order], VERTEX.format(n=4, t=name), values.astype(order + code).tobytes(), end)
    np.testing.assert_array_equal(read(tmp_path / "a.ply", content), values)


@given(points=hnp.arrays(np.float32, st.tuples(st.integers(1, 9), st.just(3)), elements=st.floats(width=32)))
@quick
def test_float32_ply_round_trips(folder: Path, points: np.ndarray[Any, np.dtype[np.float32]]) -> None:
    vertex = VERTEX.format(n=len(points), t="float")
    text = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.astype(float).tolist()).encode()
    for encoding, body in (
        ("ascii", text),
        ("binary_little_endian", points.astype("<f4").tobytes()),
        ("binary_big_endian", points.astype(">f4").tobytes()),
    ):
        np.testing.assert_array_equal(
            read(folder / "f.ply", ply(encoding, vertex, body)), points.astype(float)
        )


FACE = "element face 3\nproperty uchar flag\nproperty list uchar int corners\nproperty list ushort float w\n"


def faces(order: str, lengths: tuple[int, int, int]) -> bytes:
    body = b""
    for n in lengths:
        body += struct.pack(f"{order}BB{n}iH{n}f", 1, n, *range(n), n, *range(n))
    return body


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("lengths", [(3, 3, 3), (3, 4, 3), (0, 0, 2), (0, 0, 0), (55, 3, 3)])
def test_binary_elements_before_and_after_the_vertices_are_passed_over(
    tmp_path: Path, order: str, lengths: tuple[int, int, int]
) -> None:
    camera = "element camera 2\nproperty double f\nproperty char c\nelement nothing 5\n"
    vertex = "element vertex 3\nproperty uchar r\nproperty double X\nproperty double Y\nproperty double Z\n"
    packed = b"".join(struct.pack(f"{order}B3d", 9, *row) for row in THREE)
    body = bytes(18) + faces(order, lengths) + packed
    content = ply(
        ORDERS[order], camera + FACE + vertex + FACE.replace("face", "tail"), body + faces(order, lengths)
    )
    np.testing.assert_array_equal(read(tmp_path / "a.ply", content), THREE)
    for n in range(content.index(b"end_header"), len(content) - len(faces(order, lengths)), 7):
        assert "cut short" in fault(tmp_path / "a.ply", content[:n])


@pytest.mark.parametrize("lengths", [(2, 2, 2), (2, 0, 1)])
def test_lists_within_the_vertices_are_passed_over(tmp_path: Path, lengths: tuple[int, int, int]) -> None:
    vertex = "element vertex 3\nproperty double x\nproperty list int uchar l\n"
    vertex += "property double y\nproperty float z\n"
    body = b"".join(
        struct.pack(f"<di{n}Bdf", x, n, *range(n), y, z) for n, (x, y, z) in zip(lengths, THREE, strict=True)
    )
    content = ply("binary_little_endian", vertex, body)
    np.testing.assert_array_equal(read(tmp_path / "a.ply", content), THREE)
    assert "promises 3 vertices, the file holds 2" in fault(tmp_path / "a.ply", content[:-1])
    assert "convert it to binary" in fault(tmp_path / "a.ply", ply("ascii", vertex, b"1 0 2 3\n" * 3))


@pytest.mark.usefixtures("parser")
@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
def test_ascii_elements_before_and_after_the_vertices_are_passed_over(tmp_path: Path, end: bytes) -> None:
    elements = (
        FACE + VERTEX.format(n=3, t="float") + "property list uchar int more\n" + FACE.replace("face", "t")
    )
    lines = [
        b"1 2 0 1 0",
        b"1 0 0",
        b"1 0 0",
        b"1.5 -2 0.25 0",
        b" 4 0.005  -6 2 1 1 ",
        b"7 8 1e3 0",
        b"1 0 0",
    ]
    header = ply("ascii", elements, b"", end.decode())
    np.testing.assert_array_equal(read(tmp_path / "a.ply", header + end.join(lines)), THREE)
    lines[4] = b"4 oops 0 0"
    at = header.count(end) + 5
    assert f"line {at} ('4 oops 0 0'): y is 'oops'" in fault(tmp_path / "a.ply", header + end.join(lines))
    cut = fault(tmp_path / "a.ply", header + end.join(lines[:5]))
    assert "promises 3 points, the file holds 2; it was cut short" in cut


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"pla\n", "does not begin with a line 'ply'"),
        (ply("ascii", "", b""), "no element vertex"),
        (
            ply("ascii", "element vertex 2\nproperty float x\nproperty float y\n", b"1 2\n3 4\n"),
            "are x, y, expected",
        ),
        (ply("ascii", "element vertex 2\n", b""), "are none, expected x, y and z"),
        (ply("ascii", VERTEX.format(n=0, t="float"), b""), "holds no points"),
        (ply("binary_little_endian", VERTEX.format(n=0, t="float"), b""), "holds no points"),
        (ply("ascii", VERTEX.format(n=2, t="float"), b""), "promises 2 points, the file holds 0"),
        (ply("ascii", VERTEX.format(n=2, t="float"), b"1 2 3\n4 5\n"), "line 11 ('4 5') is too short"),
        (ply("ascii", VERTEX.format(n=2, t="quad"), b""), "line 6 of the PLY header cannot be understood"),
        (ply("ascii", VERTEX.format(n=-2, t="float"), b""), "'element vertex -2'"),
        (ply("binary", VERTEX.format(n=2, t="float"), b""), "'format binary 1.0'"),
        (b"ply\nelement vertex 1\nend_header\n", "no line format"),
        (b"ply\nformat ascii 1.0\nelement vertex 1\nprop", "no line end_header"),
        (ply("binary_little_endian", VERTEX.format(n=10**15, t="float"), bytes(24)), "1000000000000000 vert"),
        (ply("ascii", VERTEX.format(n=10**15, t="float"), b"1 2 3\n"), "the file holds 1;"),
        (
            ply(
                "binary_little_endian",
                "element f 1\nproperty list char int v\n" + VERTEX.format(n=1, t="int"),
                b"\xff",
            ),
            "length -1; the file is damaged",
        ),
    ],
)
def test_broken_ply_says_what_is_wrong(tmp_path: Path, content: bytes, message: str) -> None:
    assert message in fault(tmp_path / "a.ply", content)


# PCD


def pcd(
    data: str, body: bytes, fields: str = "x y z", size: str = "8 8 8", kind: str = "F F F", *, more: str = ""
) -> bytes:
    header = f"# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {size}\nTYPE {kind}\n{more}WIDTH 3\nHEIGHT 1\n"
    return f"{header}VIEWPOINT 1 2 3 1 0 0 0\nPOINTS 3\nDATA {data}\n".encode() + body


def lzf_compress(data: bytes) -> bytes:
    """Compress greedily: literals of at most 32 bytes, and copies of 3 to 264."""
    out, literal, at = bytearray(), bytearray(), 0
    seen: dict[bytes, int] = {}

    def flush() -> None:
        for n in range(0, len(literal), 32):
            out.append(len(literal[n : n + 32]) - 1)
            out.extend(literal[n : n + 32])
        literal.clear()

    while at < len(data):
        back = at - seen.get(data[at : at + 3], -(1 << 20))
        seen[data[at : at + 3]] = at
        if back > 8192 or len(data) - at < 3:
            literal.append(data[at])
            at += 1
            continue
        n = 3
        while n < 264 and at + n < len(data) and data[at + n] == data[at + n - back]:
            n += 1
        flush()
        high = (back - 1) >> 8
        out.extend([(n - 2) << 5 | high] if n < 9 else [7 << 5 | high, n - 9])
        out.append((back - 1) & 255)
        at += n
    flush()
    return bytes(out)


@given(
    st.binary(max_size=300) | st.lists(st.sampled_from([b"ab", b"abc", bytes(40)]), max_size=40).map(b"".join)
)
@quick
def test_lzf_gives_every_byte_back(data: bytes) -> None:
    assert decompress(lzf_compress(data)) == data


def test_lzf_streams_written_by_hand() -> None:
    assert decompress(b"\x00a\xe0\x00\x00") == b"a" * 10
    assert decompress(b"\x02abc\x20\x02") == b"abcabc"
    assert decompress(b"") == b""


@pytest.mark.parametrize(
    "stream", [b"\x05ab", b"\x00a\x20", b"\x00a\xe0\x00", b"\x00a\xe0", b"\x00a\x20\x01"]
)
def test_broken_lzf_is_refused(stream: bytes) -> None:
    with pytest.raises(ValueError, match="the LZF stream"):
        decompress(stream)


def packed(types: list[tuple[str, str, int]], compressed: bool) -> bytes:
    record = np.zeros(3, [(name, kind, (n,)) for name, kind, n in types])
    for name, column in zip("xyz", THREE.T, strict=True):
        record[name][:, 0] = column
    if not compressed:
        return record.tobytes()
    raw = b"".join(record[name].tobytes() for name, _, _ in types)
    stream = lzf_compress(raw)
    return struct.pack("<II", len(stream), len(raw)) + stream


@pytest.mark.parametrize("data", ["binary", "binary_compressed"])
def test_pcd_fields_of_any_order_and_size(tmp_path: Path, data: str) -> None:
    types = [
        ("a", "<u2", 1),
        ("z", "<f8", 1),
        ("h", "<f4", 33),
        ("x", "<f4", 1),
        ("_", "<i1", 3),
        ("y", "<f8", 1),
    ]
    body = packed(types, data == "binary_compressed")
    more = "COUNT 1 1 33 1 3 1\n"
    content = pcd(data, body, "a Z h X _ Y", "2 8 4 4 1 8", "U F F F I F", more=more)
    np.testing.assert_array_equal(read(tmp_path / "a.pcd", content), THREE)
    for n in range(len(content) - len(body), len(content)):
        assert "cut short" in fault(tmp_path / "a.pcd", content[:n])


@pytest.mark.usefixtures("parser")
@pytest.mark.parametrize("end", [b"\n", b"\r\n"])
@pytest.mark.parametrize("gap", [b" ", b",", b"\t"])
def test_ascii_pcd(tmp_path: Path, end: bytes, gap: bytes) -> None:
    lines = [b"9 9 1.5 -2 .25", b"9 9 4 5e-3 -6", b"9 9 7 8 1e3"]
    body = end.join(line.replace(b" ", gap) for line in lines)
    content = (
        pcd("ascii", b"", "n x y z", "4 4 4 4", "F F F F", more="COUNT 2 1 1 1\n").replace(b"\n", end) + body
    )
    np.testing.assert_array_equal(read(tmp_path / "a.pcd", content), THREE)
    cut = fault(tmp_path / "a.pcd", content[: content.rindex(end)])
    assert "promises 3 points, the file holds 2; it was cut short" in cut
    assert "line 14 ('9')" in fault(tmp_path / "a.pcd", content[: content.rindex(end) + len(end) + 1])


def test_pcd_without_points_counts_width_times_height(tmp_path: Path) -> None:
    content = pcd("binary", THREE.tobytes()).replace(b"POINTS 3\n", b"").replace(b"HEIGHT 1", b"HEIGHT 2")
    assert "promises 6 points, the file holds 3" in fault(tmp_path / "a.pcd", content)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"VERSION 0.7\nFIELDS x y z\n", "no line DATA"),
        (pcd("octree", b""), "DATA is 'octree', expected ascii, binary or binary_compressed"),
        (pcd("ascii", b"", "x y i"), "fields are x y i, expected x, y and z"),
        (pcd("ascii", b"", "x y z", "4 4"), "differ in length"),
        (pcd("ascii", b"", kind="F F D"), "cannot be understood"),
        (pcd("ascii", b"", more="COUNT 1 3 1\n"), "COUNT in the PCD header is 1 3 1"),
        (
            pcd("ascii", b"", "x y z a", "4 4 4 4", "F F F F", more="COUNT 1 1 1 99999999999999999999\n"),
            "a COUNT or POINTS",
        ),
        (pcd("ascii", b"").replace(b"POINTS 3", b"POINTS -3"), "a COUNT or POINTS"),
        (pcd("ascii", b"").replace(b"POINTS 3", b"POINTS many"), "cannot be understood"),
        (pcd("ascii", b"").replace(b"POINTS 3", b"POINTS 0"), "holds no points"),
        (pcd("binary", b"").replace(b"POINTS 3", b"POINTS 0"), "holds no points"),
        (pcd("binary_compressed", b"\0\0\0"), "holds no data; it was cut short"),
        (pcd("binary_compressed", struct.pack("<II", 2, 9) + b"\5a"), "damaged: the LZF stream ends inside"),
        (
            pcd("binary_compressed", struct.pack("<II", 2, 9) + b"\0a"),
            "damaged: 1 bytes where 9 are expected",
        ),
        (pcd("binary_compressed", struct.pack("<II", 2, 1) + b"\0a"), "promises 3 points, the file holds 0"),
    ],
)
def test_broken_pcd_says_what_is_wrong(tmp_path: Path, content: bytes, message: str) -> None:
    assert message in fault(tmp_path / "a.pcd", content)


# Files that are not what they are called, or cannot be reached


@pytest.mark.parametrize(
    ("called", "holds"), list(itertools.permutations([".xyz", ".npy", ".ply", ".pcd"], 2))
)
def test_a_format_under_the_extension_of_another_is_named(tmp_path: Path, called: str, holds: str) -> None:
    write_cloud(tmp_path / f"a{holds}", PointCloud.of(THREE))
    (tmp_path / f"a{holds}").rename(tmp_path / f"b{called}")
    message = fault(tmp_path / f"b{called}")
    if holds == ".xyz":  # nothing tells such a file by its start
        assert re.search("does not begin|no line DATA", message)
    else:
        assert (
            f"is called {called}, but holds a {holds[1:].upper()} file; give it the extension {holds}"
            in message
        )
        assert len(read_cloud(tmp_path / f"b{called}", format=holds[1:])) == 3


@pytest.mark.parametrize(
    ("start", "what"),
    [
        (b"PK\x03\x04", "a ZIP archive"),
        (b"ISO-10303-21;\n", "a STEP model"),
        (b"\x1f\x8b\x08", "a gzip archive"),
    ],
)
@pytest.mark.parametrize("suffix", SUFFIXES)
def test_other_content_is_named(tmp_path: Path, suffix: str, start: bytes, what: str) -> None:
    assert f"is called {suffix}, but holds {what}" in fault(tmp_path / f"a{suffix}", start + bytes(50))


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_what_cannot_be_read_at_all(tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / f"a{suffix}"
    assert fault(path) == "cannot be read: No such file or directory"
    assert fault(path, b"") == "is empty; check that the drawing was saved whole"
    fault(path, b"\n")
    (tmp_path / f"folder{suffix}").mkdir()
    assert fault(tmp_path / f"folder{suffix}").startswith("is a folder, expected a file")
    os.mkfifo(tmp_path / f"pipe{suffix}")
    assert fault(tmp_path / f"pipe{suffix}").startswith("is no regular file")

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    path.write_bytes(b"1 2 3\n")
    monkeypatch.setattr(Path, "open", refuse)
    assert fault(path) == "cannot be read: Permission denied"


# Writing


@pytest.mark.parametrize("name", ["a.las", "a", "nowhere/a.xyz", "nowhere/a.ply"])
def test_what_cannot_be_written(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError, match=r"cannot (be written|write the extension)"):
        write_cloud(tmp_path / name, PointCloud.of(THREE))
    assert not list(tmp_path.iterdir())


def test_a_folder_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "a.xyz").mkdir()
    with pytest.raises(OutputError, match="cannot be written"):
        write_cloud(tmp_path / "a.xyz", PointCloud.of(THREE))
    assert [path.name for path in tmp_path.iterdir()] == ["a.xyz"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_writing_that_fails_leaves_the_old_file_and_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    def fail(path: Path, cloud: PointCloud) -> None:
        path.write_bytes(b"half")
        raise error

    reads: Callable[[Path], PointCloud] = FORMATS[0].read
    (tmp_path / "a.odd").write_bytes(b"before")
    monkeypatch.setattr(room, "FORMATS", (Format("odd", (".odd",), "odd", reads, fail),))
    with pytest.raises((OutputError, KeyboardInterrupt)):
        write_cloud(tmp_path / "a.odd", PointCloud.of(THREE))
    assert [path.name for path in tmp_path.iterdir()] == ["a.odd"]
    assert (tmp_path / "a.odd").read_bytes() == b"before"


# Real files


@pytest.mark.skipif(not DATA.is_dir(), reason="shared/data is not here")
@pytest.mark.parametrize(
    ("name", "n_points", "last"),
    [
        ("bunnyData.pts", 30571, (-0.07063, 0.04015, 0.001226)),
        ("ism_train_cat.pcd", 3400, None),
        ("lamppost.pcd", 1771, (-9.828125, 0.0625, -5.4209976)),
        ("sphere.ply", 2929, None),
        ("dialects/crlf_test.txt", 10, (289818.50, 4320980.59, 170.58)),
        ("dialects/diamond.ply", 6, (0.5, 0.5, 1.0)),
        ("dialects/diamond.xyz", 6, (0.5, 0.5, 1.0)),
        ("dialects/missingheader.txt", 5, (5, 5, 5)),
        ("dialects/point_cloud_sample1.pts", 10, (-6.369919, -13.915909, -65.089279)),
        ("dialects/quoted.txt", 9, (29, 22, 2)),
        ("dialects/simple_text.ply", 3, (1, 0, 0)),
        ("dialects/utm17_1.txt", 10, (289818.50, 4320980.59, 170.58)),
        ("dialects/utm17_3.txt", 11, (289818.50, 4320980.59, 170.58)),
        ("dialects/utm17_comma.pcd", 10, (289818.50, 4320980.59, 170.58)),
        ("dialects/utm17_space.pcd", 10, (289818.50, 4320980.59, 170.58)),
        ("dialects/with_edgeofflightline.txt", 10000, (286.570, 134.009, 86.805)),
    ],
)
def test_real_clouds(name: str, n_points: int, last: tuple[float, float, float] | None) -> None:
    path = DATA / "clouds" / name
    before = path.read_bytes()
    cloud = read_cloud(path)
    assert len(cloud) == n_points
    assert np.isfinite(cloud.points).all()
    if last is not None:
        np.testing.assert_array_equal(cloud.points[-1], last)
    assert path.read_bytes() == before


@pytest.mark.skipif(not DATA.is_dir(), reason="shared/data is not here")
def test_the_real_sphere_has_its_radius() -> None:
    radius = np.linalg.norm(read_cloud(DATA / "clouds" / "sphere.ply").points, axis=1)
    assert np.median(radius) == pytest.approx(25, rel=1e-3)


@pytest.mark.skipif(not DATA.is_dir(), reason="shared/data is not here")
@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("clouds/dialects/badheader.txt", "names x, y and z once each"),
        ("clouds/dialects/no_vertex.ply", "no element vertex"),
        ("clouds/dialects/plane.laz", "no cloud format has the extension .laz, known are"),
        ("vicon/pyomeca_markers.csv", "neither a row of numbers nor a header"),
        ("step/revolve_vase_shell_myfreecad.step", "no cloud format has the extension .step"),
    ],
)
def test_real_files_that_are_refused(name: str, message: str) -> None:
    with pytest.raises(SketchloftError, match=re.escape(message)):
        read_cloud(DATA / name)
