"""Every picture of the README and the docs, made anew by the examples (`make docs-pictures`).

Run as `python docs/pictures.py [FOLDER]`; the folder is `docs/pictures` if not given.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from PIL import Image

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "examples"))

from hero import draw_hero  # noqa: E402

import comparison  # noqa: E402  found only with the line above
import demo  # noqa: E402
import directions  # noqa: E402
import distortion  # noqa: E402
import lamp  # noqa: E402
import quantify  # noqa: E402
import slices  # noqa: E402
from sketchloft import reconstruct  # noqa: E402
from trial import N, cloud_of, trial  # noqa: E402

__all__ = ["main", "shrink"]

WIDEST = 1400
"""Pixels across."""
LARGE = 200_000
"""Bytes from which on a picture has to make do with fewer colours."""
COLOURS = 255
"""With dither, so many are enough for the eye; they take less than half the room of all colours."""
ALMOST_WHITE = 247


def main(folder: Path, n: int = N) -> list[Path]:
    """Make every picture, and make it small."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures = [draw_hero(trial(cloud_of("lamp", n)), folder / "hero.png")]
    pictures += demo.draw_findings(reconstruct(cloud_of(demo.NAME, n)), folder)
    for example in (slices, quantify, distortion, comparison, lamp, directions):
        pictures += example.main(folder, n)
    for picture in pictures:
        shrink(picture)
    return pictures


def shrink(path: Path) -> None:
    """Write a picture again with fewer pixels and, where it is large, fewer colours."""
    with Image.open(path) as opened:
        picture = opened.convert("RGB")
    if picture.width > WIDEST:
        size = WIDEST, round(picture.height * WIDEST / picture.width)
        picture = picture.resize(size, Image.Resampling.LANCZOS)
    picture.save(path, optimize=True)
    if path.stat().st_size < LARGE:
        return
    palette = picture.quantize(COLOURS, Image.Quantize.MAXCOVERAGE)
    colours = np.array(palette.getpalette(), dtype=int).reshape(-1, 3)
    colours[(colours > ALMOST_WHITE).all(axis=1)] = 255  # or the background may become one of these
    palette.putpalette(colours.ravel().tolist())
    picture.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)


if __name__ == "__main__":
    begun = time.perf_counter()
    made = main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "pictures")
    for picture in made:
        print(f"{picture}  {picture.stat().st_size / 1024:.0f} kB")
    print(f"{len(made)} pictures in {time.perf_counter() - begun:.0f} s")
