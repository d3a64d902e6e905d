"""Picture files as arrays of bytes, through Pillow."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes, Floats
from gazelle.errors import FormatError
from gazelle.formats.lfs import refuse_pointer_file
from gazelle.formats.limits import refuse_special

if TYPE_CHECKING:
    from PIL.Image import Image

T = TypeVar("T")

MAX_PIXELS = 2**27


_WITH_ALPHA = {"LA", "La", "PA", "RGBa"}


def read_picture(path: Path) -> Bytes:
    """Read pixels, shape (height, width, channels): grey, RGB or RGBA; the top row first.

    Grey of 16 bits keeps its upper byte.

    Raises:
        FormatError: The file cannot be read, is not a picture, or larger than ``MAX_PIXELS``.
    """
    return _read(path, _pixels)


def read_elevations(path: Path) -> Floats:
    """Read a picture of one channel, values unchanged, shape (height, width); top row first.

    Raises:
        FormatError: As ``read_picture``, or it has several channels.
    """
    return _read(path, _elevations)


def _read(path: Path, values_of: Callable[[Image], T]) -> T:
    import PIL.Image

    _register_double_tiff()
    refuse_special(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PIL.Image.DecompressionBombWarning)
            with PIL.Image.open(path) as picture:
                _check_size(picture, path)
                return values_of(picture)
    except FormatError:
        raise
    except PIL.UnidentifiedImageError:
        refuse_pointer_file(path)
        raise FormatError("this is not a picture that can be read", file=str(path)) from None
    except Exception as error:  # decoders raise anything on a broken file
        text = " ".join(str(error).split()) or type(error).__name__
        raise FormatError(f"the picture cannot be read: {text}", file=str(path)) from error


@cache
def _register_double_tiff() -> None:
    """Register TIFF files of 64-bit numbers with Pillow, which can decode them."""
    from PIL.TiffImagePlugin import II, MM, OPEN_INFO

    for order, kind in ((II, "F;64F"), (MM, "F;64BF")):
        OPEN_INFO.setdefault((order, 1, (3,), 1, (64,), ()), ("F", kind))


def _check_size(picture: Image, path: Path) -> None:
    if picture.width * picture.height > MAX_PIXELS:
        raise FormatError(f"the picture has more than {MAX_PIXELS} pixels", file=str(path))


def _elevations(picture: Image) -> Floats:
    channels = len(picture.getbands())
    if channels != 1 or picture.mode == "P":
        what = "a palette of colours" if picture.mode == "P" else f"{channels} channels"
        raise FormatError(
            f"a picture of elevations has one channel, this has {what}",
            hint="save it as grey, of 8, 16 or 32 bits or with fractions",
        )
    values: Floats = np.asarray(picture).astype(np.float64)
    return values


def _pixels(picture: Image) -> Bytes:
    mode = picture.mode
    if mode == "F":
        raise FormatError(
            "a picture of elevations, with fractions, has no colours",
            hint="save it as a grey PNG",
        )
    if mode.startswith("I"):
        deep: NDArray[np.int64] = np.asarray(picture).astype(np.int64)
        grey: Bytes = np.clip(deep >> 8, 0, 255).astype(np.uint8)
        return grey[..., None]
    if mode == "1":
        picture = picture.convert("L")
    elif mode in _WITH_ALPHA or "transparency" in picture.info:
        picture = picture.convert("RGBA")
    elif mode not in {"L", "RGB", "RGBA"}:
        picture = picture.convert("RGB")
    pixels: Bytes = np.asarray(picture, dtype=np.uint8)
    return pixels if pixels.ndim == 3 else pixels[..., None]
