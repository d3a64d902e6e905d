"""Pictures on surfaces, as the shader reads them."""

from __future__ import annotations

import hashlib
import warnings
from pathlib import Path

import numpy as np

from gazelle.array_types import Bytes, Ints64
from gazelle.errors import EngineWarning, FormatError
from gazelle.rendering import columns as c

Rgb = tuple[float, float, float]

LARGEST = 512
"""Pixels along a side; larger pictures are made smaller, which also keeps far ones from flickering."""


class TextureTable:
    """The textures of a world, each read once.

    Attributes:
        count: Number of textures.
    """

    def __init__(self) -> None:
        self._numbers: dict[Path | bytes, int | None] = {}
        self._pixels: list[Bytes] = []

    @property
    def count(self) -> int:
        """Number of textures."""
        return len(self._pixels)

    def number(self, picture: Path | Bytes) -> int | None:
        """Return the number of a texture; None, with a warning, if it cannot be read.

        Args:
            picture: A file, or red, green and blue of shape (height, width, 3), top row first.
        """
        if isinstance(picture, np.ndarray):
            key = hashlib.blake2b(picture.tobytes(), digest_size=16).digest()
            if key not in self._numbers:
                self._pixels.append(_ready(picture))
                self._numbers[key] = len(self._pixels) - 1
            return self._numbers[key]
        path = picture
        if path not in self._numbers:
            try:
                self._pixels.append(_read(path))
                self._numbers[path] = len(self._pixels) - 1
            except FormatError as error:
                self._numbers[path] = None
                text = f"the texture '{path}' is not shown: {error.message}"
                warnings.warn(EngineWarning(text), stacklevel=2)
        return self._numbers[path]

    def mean(self, number: int) -> Rgb:
        """Return the colour of a texture from afar."""
        red, green, blue = (self._pixels[number].reshape(-1, 3).mean(axis=0) / 255.0).tolist()
        return (red, green, blue)

    def rows(self) -> Ints64:
        """Return rows by ``columns.FIRST_TEXEL`` and those that follow, shape (t, TEXTURE)."""
        made = np.zeros((len(self._pixels), c.TEXTURE), np.int64)
        first = 0
        for row, pixels in zip(made, self._pixels, strict=True):
            row[:] = first, pixels.shape[1], pixels.shape[0]
            first += pixels.shape[0] * pixels.shape[1]
        return made

    def texels(self) -> Bytes:
        """Return red, green and blue of all pixels, bottom row first, shape (x, 3)."""
        flat = [pixels.reshape(-1, 3) for pixels in self._pixels]
        return np.ascontiguousarray(np.vstack([np.zeros((0, 3), np.uint8), *flat]))


def _read(path: Path) -> Bytes:
    """Read red, green, blue, bottom row first, shape (height, width, 3)."""
    from gazelle.formats.picture import read_picture

    pixels = read_picture(path)
    color = pixels[..., :3] if pixels.shape[2] >= len("rgb") else np.repeat(pixels[..., :1], 3, 2)
    return _ready(color)


def _ready(color: Bytes) -> Bytes:
    """Return a picture of limited size, bottom row first."""
    from PIL import Image

    size = max(color.shape[:2])
    if size > LARGEST:
        height, width = (max(1, side * LARGEST // size) for side in color.shape[:2])
        smaller = Image.fromarray(np.ascontiguousarray(color)).resize(
            (width, height), Image.Resampling.BOX
        )
        color = np.asarray(smaller, np.uint8)
    return np.ascontiguousarray(color[::-1])
