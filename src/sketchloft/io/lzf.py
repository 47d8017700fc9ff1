"""LZF: the compression inside PCD files.

A stream of runs. A control byte c < 32 is followed by c + 1 literal bytes. Otherwise it
copies earlier output: c >> 5 is the length less 2 (7: add the next byte), and
c & 31 with the next byte the distance less 1, high bits first. A copy may overlap its
own output.

References
----------
Marc Lehmann, LibLZF, http://software.schmorp.de/pkg/liblzf.html
"""

from __future__ import annotations

__all__ = ["decompress"]

LITERAL = 32


def decompress(data: bytes) -> bytes:
    """Return the bytes that `data` was compressed from.

    Parameters
    ----------
    data : bytes
        A whole LZF stream, without any header.

    Returns
    -------
    bytes

    Raises
    ------
    ValueError
        If the stream ends inside a run or copies from before its start.

    Notes
    -----
    Every run depends on the ones before it, so this is a loop: about 0.3 s per million runs.
    """
    out = bytearray()
    at, end = 0, len(data)
    while at < end:
        control = data[at]
        at += 1
        if control < LITERAL:
            stop = at + control + 1
            if stop > end:
                raise ValueError("the LZF stream ends inside a run")
            out += data[at:stop]
            at = stop
            continue
        size = control >> 5
        if at + (size == 7) >= end:
            raise ValueError("the LZF stream ends inside a run")
        if size == 7:
            size += data[at]
            at += 1
        size += 2
        start = len(out) - ((control & 31) << 8) - data[at] - 1
        at += 1
        if start < 0:
            raise ValueError("the LZF stream copies from before its start")
        run = out[start : start + size]
        if len(run) < size:  # the copy overlaps itself: it repeats
            run = (run * (size // len(run) + 1))[:size]
        out += run
    return bytes(out)
