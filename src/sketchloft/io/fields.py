"""The fields of a line of text.

Values stand between blanks, or between one of tab, comma, semicolon with or without blanks
beside it. Comments go from # or // to the end of the line. A number is what C's strtod
reads, less the hexadecimal forms: 1, -1.5, .5, 1e-3, nan, inf. Beside semicolons a comma
is a decimal comma.
"""

from __future__ import annotations

import re

import numpy as np

__all__ = ["BLANK", "is_number", "is_tidy", "line_feeds", "sniff", "split", "tidy", "without_comments"]

BLANK = b" "

_NUMBER = re.compile(rb"[+-]?((\d+\.?\d*|\.\d+)(e[+-]?\d+)?|nan|inf|infinity)", re.IGNORECASE)
_COMMENT = re.compile(rb"(#|//)[^\n]*")


def is_number(field: bytes) -> bool:
    """Tell whether a field holds a number and nothing else."""
    return _NUMBER.fullmatch(field) is not None


def line_feeds(text: bytes) -> bytes:
    """End every line in a line feed, whatever system the text is from."""
    return text.replace(b"\r\n", b"\n").replace(b"\r", b"\n") if b"\r" in text else text


def sniff(row: bytes) -> bytes:
    """Return the delimiter of a row."""
    if b";" in row:
        return b";"
    cells = [cell.strip() for cell in row.strip().split(b"\t")]
    if len(cells) > 1 and all(cell and BLANK not in cell for cell in cells):
        return b"\t"
    return b"," if b"," in row else BLANK


def split(line: bytes, delimiter: bytes) -> list[bytes]:
    """Return the fields of one line; none for a blank line or a comment."""
    row = tidy(line, delimiter)
    return row.split(delimiter) if row else []


def without_comments(text: bytes) -> bytes:
    """Take the comments out, and leave their lines empty."""
    return _COMMENT.sub(b"", text) if b"#" in text or b"/" in text else text


def tidy(text: bytes, delimiter: bytes) -> bytes:
    """Leave nothing but rows, fields and single delimiters.

    Parameters
    ----------
    text : bytes
        Lines that end in a line feed.
    delimiter : bytes
        As `sniff` found it.

    Returns
    -------
    bytes
        The rows, without blank lines, comments, quotes and needless blanks.
    """
    text = without_comments(text)
    if b'"' in text:
        text = text.replace(b'"', b"")
    if delimiter == b";":
        text = text.replace(b",", b".")
    if delimiter != b"\t":
        text = text.replace(b"\t", BLANK)
    if BLANK in text:
        text = _squeeze(text, BLANK).replace(b" \n", b"\n").replace(b"\n ", b"\n").strip(BLANK)
        if delimiter != BLANK:
            text = text.replace(BLANK + delimiter, delimiter).replace(delimiter + BLANK, delimiter)
    return _squeeze(text, b"\n").strip(b"\n")


def is_tidy(text: bytes, delimiter: bytes) -> bool:
    """Tell, faster than `tidy` does it, whether nothing but a last line feed would go."""
    alien = {b'"', b"#", b"/", b"\t", BLANK} - {delimiter}
    if delimiter == b";":
        alien.add(b",")
    if any(mark in text for mark in alien):
        return False
    values = np.frombuffer(b"\n" + text, np.uint8)
    gap = (values == ord("\n")) | (values == ord(delimiter))
    return not (gap[1:] & gap[:-1]).any() and not text.endswith(BLANK)


def _squeeze(text: bytes, mark: bytes) -> bytes:
    while mark + mark in text:
        text = text.replace(mark + mark, mark)
    return text
