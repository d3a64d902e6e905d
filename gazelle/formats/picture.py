"""Picture files as arrays of bytes, through Pillow."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes
from gazelle.errors import FormatError

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_PIXELS = 2**27


_WITH_ALPHA = {"LA", "La", "PA", "RGBa"}


def read_picture(path: Path) -> Bytes:
    """The pixels, shape (height, width, channels): grey, RGB or RGBA; the top row first.

    Grey of 16 bits keeps its upper byte.

    Raises:
        FormatError: The file cannot be read, is no picture, or larger than ``MAX_PIXELS``.
    """
    import PIL.Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PIL.Image.DecompressionBombWarning)
            with PIL.Image.open(path) as picture:
                _check_size(picture, path)
                return _pixels(picture)
    except FormatError:
        raise
    except PIL.UnidentifiedImageError:
        raise FormatError("this is no picture that can be read", file=str(path)) from None
    except Exception as error:  # decoders raise anything on a broken file
        text = " ".join(str(error).split()) or type(error).__name__
        raise FormatError(f"the picture cannot be read: {text}", file=str(path)) from error


def _check_size(picture: Image, path: Path) -> None:
    if picture.width * picture.height > MAX_PIXELS:
        raise FormatError(f"the picture has more than {MAX_PIXELS} pixels", file=str(path))


def _pixels(picture: Image) -> Bytes:
    mode = picture.mode
    if mode == "F":
        raise FormatError(
            "a picture of elevations, with fractions, cannot be read",
            hint="save it as a grey PNG; <size> says how high white is",
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
