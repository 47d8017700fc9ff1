"""Content: what a file holds by its first bytes, whatever its name says."""

from __future__ import annotations

from collections.abc import Iterable

from sketchloft.io.format import Format

__all__ = ["HEAD", "recognise"]

HEAD = 64
"""Number of bytes from the start of a file that `recognise` wants to see."""

_FOREIGN: tuple[tuple[bytes, str], ...] = (
    (b"ISO-10303-21", "a STEP model"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"BZh", "a bzip2 archive"),
    (b"\xfd7zXZ\0", "an xz archive"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (b"LASF", "a LAS cloud"),
    (b"ASTM-E57", "an E57 cloud"),
    (b"tilT", "a Tilt Brush drawing"),
    (b"glTF", "a GLB model"),
    (b"OFF\n", "an OFF mesh"),
    (b"OFF\r", "an OFF mesh"),
    (b"solid ", "an STL model"),
    (b"PathFileType", "a TRC motion capture"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"%PDF", "a PDF document"),
    (b"\x89HDF", "an HDF5 file"),
    (b"<?xml", "an XML file"),
    (b"<!DOCTYPE", "an HTML page"),
    (b"<html", "an HTML page"),
    (b"{", "a JSON file"),
)


def recognise(head: bytes, formats: Iterable[Format]) -> Format | str | None:
    """Say what a file holds.

    Parameters
    ----------
    head : bytes
        The first `HEAD` bytes of the file, or all of it if it is shorter.
    formats : iterable of Format
        The formats that can be read.

    Returns
    -------
    Format, str or None
        One of `formats`; or what else it is, in words; or None where the start tells nothing.
    """
    for one in formats:
        if head.startswith(one.starts):
            return one
    return next((what for start, what in _FOREIGN if head.startswith(start)), None)
