"""Long messages in pieces, and text as the pixels of a PNG: rosbridge's two transformations."""

from __future__ import annotations

import base64
import io
import json
import math
import time
from typing import Any

from gazelle_ros.base.errors import RosError

_MOST_OPEN = 100
"""Messages of one client that may wait for pieces at a time."""


def split_text(text: str, size: int, identifier: str) -> list[str]:
    """Return the ``fragment`` messages of a text, with `size` characters of it each.

    A text that is not longer is one message: itself.
    """
    if len(text) <= size:
        return [text]
    total = math.ceil(len(text) / size)
    return [
        json.dumps(
            {
                "op": "fragment",
                "id": identifier,
                "data": text[number * size : (number + 1) * size],
                "num": number,
                "total": total,
            }
        )
        for number in range(total)
    ]


class FragmentBuffer:
    """Puts fragments together.

    Args:
        most_bytes: Characters that may wait in all.
        patience: Seconds after which an incomplete message is dropped.
    """

    def __init__(self, most_bytes: int, patience: float) -> None:
        self._most, self._patience = most_bytes, patience
        self._open: dict[Any, dict[int, str]] = {}
        self._totals: dict[Any, int] = {}
        self._touched: dict[Any, float] = {}

    def add(self, identifier: Any, number: int, total: int, data: str) -> str | None:
        """Add a piece; returns the whole text with the last missing one.

        Raises:
            RosError: The numbers are impossible or differ from those before, or too much waits.
        """
        self._forget_old()
        if total < 1 or not 0 <= number < total:
            raise RosError(f"fragment {number} of {total} is invalid")
        if self._totals.setdefault(identifier, total) != total:
            self._drop(identifier)
            raise RosError(f"the fragments of {identifier} say different totals")
        pieces = self._open.setdefault(identifier, {})
        self._touched[identifier] = time.monotonic()
        pieces[number] = data
        if len(pieces) == total:
            self._drop(identifier)
            return "".join(pieces[index] for index in range(total))
        waiting = sum(len(piece) for each in self._open.values() for piece in each.values())
        if waiting > self._most or len(self._open) > _MOST_OPEN:
            self._drop(identifier)
            raise RosError(
                f"more than {self._most} bytes or {_MOST_OPEN} messages wait for their fragments"
            )
        return None

    def _forget_old(self) -> None:
        limit = time.monotonic() - self._patience
        for identifier in [key for key, then in self._touched.items() if then < limit]:
            self._drop(identifier)

    def _drop(self, identifier: Any) -> None:
        for table in (self._open, self._totals, self._touched):
            table.pop(identifier, None)


def text_as_png(text: str) -> str:
    """Encode a text as a PNG in base64.

    Its bytes are those of an RGB picture, filled up with line ends.
    """
    from PIL import Image

    data = text.encode("utf-8")
    width = max(1, math.isqrt(len(data) // 3))
    height = max(1, math.ceil(len(data) / 3 / width))
    picture = Image.frombytes("RGB", (width, height), data.ljust(3 * width * height, b"\n"))
    buffer = io.BytesIO()
    picture.save(buffer, "png")
    return base64.b64encode(buffer.getvalue()).decode("ascii")


def text_of_png(data: str, most_bytes: int) -> str:
    """Return the text in a PNG.

    Raises:
        RosError: It is none, or its text is longer than `most_bytes`.
    """
    from PIL import Image

    try:
        picture = Image.open(io.BytesIO(base64.b64decode(data)), formats=("PNG",))
        if picture.width * picture.height * 3 > most_bytes:
            raise RosError(f"the text of a PNG has more than {most_bytes} bytes")
        return picture.convert("RGB").tobytes().decode("utf-8")
    except (OSError, ValueError, SyntaxError) as error:
        raise RosError(f"this is not a PNG with text: {error}") from None
