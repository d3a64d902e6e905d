"""TensorBoard's files of events, cut where a run continues from.

A run that was killed has written curves beyond its last checkpoint, and writes those steps again
when it continues. The form of the files is that of TensorFlow's records: length (8 bytes), its
checksum (4), the event, its checksum (4).
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

from google.protobuf.message import DecodeError  # type: ignore[import-untyped]  # no types
from tensorboard.compat.proto.event_pb2 import Event  # type: ignore[import-untyped]  # no types

from gazelle.writing import write_bytes

_LENGTH = struct.Struct("<Q")
_HEAD, _FOOT = 12, 4


def trim_events(folder: Path, steps: int) -> None:
    """Remove the events after so many steps, and incomplete ones.

    Args:
        folder: Holds the files; there may be none.
        steps: The last step that stays.
    """
    for file in sorted(folder.glob("events.out.tfevents.*")):
        data = file.read_bytes()
        kept = b"".join(record for record, step in _records(data) if step <= steps)
        if kept != data:
            write_bytes(file, kept)


def _records(data: bytes) -> Iterator[tuple[bytes, int]]:
    """Yield whole records and the steps of their events, up to the first that is damaged."""
    at = 0
    while at + _HEAD <= len(data):
        (length,) = _LENGTH.unpack_from(data, at)
        end = at + _HEAD + length + _FOOT
        if end > len(data):
            return
        try:
            event = Event.FromString(data[at + _HEAD : end - _FOOT])
        except DecodeError:
            return
        yield data[at:end], int(event.step)
        at = end
