"""Pictures and films as files: PNG, JPEG, WebP; GIF, MP4."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from gazelle.argument_checks import checked
from gazelle.array_types import Picture
from gazelle.errors import Error, MissingExtraError, did_you_mean
from gazelle.viewer.limits import MAX_GIF_PIXELS, MAX_PICTURES, check_picture, check_rate
from gazelle_ros.base.writing import replacing

if TYPE_CHECKING:
    from av.video.stream import VideoStream

STILLS = (".png", ".jpg", ".jpeg", ".webp")
FILMS = (".gif", ".mp4")
_COLORS = 128  # of a GIF's palette
_LEAST = 2  # hundredths of a second that viewers of GIFs show a picture for


def writable(path: str | Path, suffixes: tuple[str, ...]) -> Path:
    """Return the file of a path that can be written.

    Raises:
        Error: It ends otherwise, or there is no such folder.
    """
    file = Path(path)
    if file.suffix.lower() not in suffixes:
        raise Error(
            f"'{file.name}' does not end with {' or '.join(suffixes)}",
            hint=did_you_mean(file.suffix, suffixes),
        )
    if not file.absolute().parent.is_dir():
        raise Error(f"there is no folder '{file.parent}' to write '{file.name}' to")
    return file


def write_picture(file: Path, picture: Picture) -> None:
    """Write a picture of shape (height, width, 3), in the format of the suffix.

    Raises:
        Error: The format holds no picture of this size.
        OSError: It cannot be written.
    """
    check_picture(picture, file)
    with replacing(file) as draft:
        Image.fromarray(picture).save(draft)


@checked(Error)
def write_film(path: str | Path, pictures: Iterable[Picture], rate: float) -> int:
    """Write pictures of one size as a film.

    Args:
        path: ``.gif``, or ``.mp4`` with the extra ``film``.
        pictures: One after another, each of shape (height, width, 3); drawn as they are written.
        rate: Pictures a second, from 0.01 to 1000.

    Returns:
        How many there were.

    Raises:
        Error: The suffix is not a film's, the rate is invalid, there is no picture, they are too
            many, or one cannot be in this film.
        MissingExtraError: MP4 is requested, and its writer is not installed.
    """
    file = writable(path, FILMS)
    check_rate(rate)
    stream = iter(pictures)
    first = next(stream, None)
    if first is None:
        raise Error(f"there is no picture to make '{file.name}' of")
    every = _alike(file, chain([first], stream))
    write = _write_mp4 if file.suffix.lower() == ".mp4" else _write_gif
    with replacing(file) as draft:
        return write(draft, every, rate)


def _alike(file: Path, pictures: Iterable[Picture]) -> Iterator[Picture]:
    """Yield pictures as far as they are of one size and not too many."""
    shape = None
    for number, picture in enumerate(pictures):
        check_picture(picture, file)
        shape = shape or picture.shape
        if picture.shape != shape:
            raise Error(
                f"pictures of a film have one size: picture {number} of '{file.name}' has "
                f"{picture.shape[1]} x {picture.shape[0]} pixels, the first {shape[1]} x {shape[0]}"
            )
        if number >= MAX_PICTURES:
            raise Error(f"'{file.name}' has more than the limit of {MAX_PICTURES:,} pictures")
        if file.suffix.lower() == ".gif" and (number + 1) * shape[0] * shape[1] > MAX_GIF_PIXELS:
            raise Error(
                f"'{file.name}' has more than the limit of {MAX_GIF_PIXELS:,} pixels in {number} "
                "pictures",
                hint="write an .mp4, or take fewer or smaller pictures",
            )
        yield picture


def _write_gif(file: Path, pictures: Iterable[Picture], rate: float) -> int:
    frames = [
        Image.fromarray(picture).quantize(_COLORS, dither=Image.Dither.NONE) for picture in pictures
    ]
    shown = max(_LEAST, round(100.0 / rate)) * 10
    frames[0].save(file, save_all=True, append_images=frames[1:], duration=shown, loop=0)
    return len(frames)


def _write_mp4(file: Path, pictures: Iterable[Picture], rate: float) -> int:
    try:
        import av
    except ImportError as error:
        raise MissingExtraError("av", "film") from error
    count = 0
    with av.open(str(file), "w") as container:
        stream: VideoStream | None = None
        for picture in pictures:
            even = _even(picture)
            if stream is None:
                pace = Fraction(rate).limit_denominator(1000)
                stream = container.add_stream("h264", rate=pace)
                stream.height, stream.width = even.shape[:2]
                stream.pix_fmt = "yuv420p"
                stream.options = {"crf": "20", "preset": "fast"}
            container.mux(stream.encode(av.VideoFrame.from_ndarray(even, format="rgb24")))
            count += 1
        if stream is not None:
            container.mux(stream.encode())
    return count


def _even(picture: Picture) -> Picture:
    """Return a picture with even sides, which H.264's colours require."""
    height, width = picture.shape[:2]
    edge = ((0, height % 2), (0, width % 2), (0, 0))
    return np.ascontiguousarray(np.pad(picture, edge, mode="edge"))
