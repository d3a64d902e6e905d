"""Preparation for reading or writing a bag: a file, an index, headers of connections."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import IO, Any

from gazelle_ros.bags.errors import BagUnindexedError
from gazelle_ros.bags.operations import reindex
from gazelle_ros.bags.reader import BagReader
from gazelle_ros.typed import class_for


class Streamed:
    """A bag in a stream, which needs a file as long as it is open.

    Args:
        stream: The stream.
        mode: ``r`` or ``w``.

    Attributes:
        path: The file.

    Raises:
        TypeError: It is no binary stream.
        ValueError: The mode is another.
    """

    def __init__(self, stream: IO[bytes], mode: str) -> None:
        if not hasattr(stream, "read" if mode == "r" else "write"):
            raise TypeError("a bag is opened by its path, or with a binary stream")
        if mode == "a":
            raise ValueError("a bag in a stream can be read or written, not appended to")
        self._stream = stream
        self._writes = mode == "w"
        self._folder = tempfile.TemporaryDirectory(prefix="bag-")
        self.path = Path(self._folder.name) / "stream.bag"
        if not self._writes:
            with self.path.open("wb") as file:
                shutil.copyfileobj(stream, file)

    def finish(self) -> None:
        """Copy the file to the stream, and delete the file."""
        with self._folder:
            if self._writes:
                with self.path.open("rb") as file:
                    shutil.copyfileobj(file, self._stream)


def ensure_index(path: Path) -> None:
    """Repair a bag without an index; unreadable parts are cut off.

    Raises:
        BagError: It is not a bag.
    """
    try:
        BagReader(path).close()
    except BagUnindexedError:
        old, _ = reindex(str(path), force=True)
        old.unlink()


def header_of(message: Any) -> dict[str, str]:
    """Return the header of a message's connection."""
    return {
        "type": message._type,
        "md5sum": message._md5sum,
        "message_definition": message._full_text,
    }


def raw_header(message: Any) -> dict[str, str]:
    """Return the header of a raw message's connection.

    Raises:
        ValueError: It has not four or five parts.
    """
    if len(message) not in {4, 5}:
        raise ValueError("msg must be of length 4 or 5")
    kind, _, checksum = message[:3]
    made = message[-1]
    if made is None:
        made = class_for({"type": kind, "md5sum": checksum})
    return {"type": kind, "md5sum": checksum, "message_definition": made._full_text}
