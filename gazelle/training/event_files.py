"""TensorBoard's files of events, written by whole records and cut where a run continues from.

TensorBoard's own writer has a thread; its errors would be tracebacks without the file. A run that
was killed has written curves beyond its last checkpoint, and writes those steps again when it
continues. The form of the files is that of TensorFlow's records: length (8 bytes), its
checksum (4), the event, its checksum (4).
"""

from __future__ import annotations

import itertools
import os
import socket
import struct
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from google.protobuf.message import DecodeError  # type: ignore[import-untyped]  # no types
from stable_baselines3.common.logger import TensorBoardOutputFormat
from tensorboard.compat.proto.event_pb2 import Event  # type: ignore[import-untyped]  # no types
from tensorboard.summary.writer.record_writer import (  # type: ignore[import-untyped]  # no types
    RecordWriter,
)
from torch.utils.tensorboard.writer import FileWriter, SummaryWriter

from gazelle_ros.base.writing import GrowingFile, write_bytes

_LENGTH = struct.Struct("<Q")
_HEAD, _FOOT = 12, 4
_count = itertools.count()


class EventTable(TensorBoardOutputFormat):  # type: ignore[misc]  # untyped base
    """The curves as a file of events.

    Args:
        folder: Of the file; one for each object.

    Raises:
        OSError: The file cannot be written.
    """

    def __init__(self, folder: Path) -> None:
        self.writer = _Summaries(str(folder))
        self._is_closed = False


class _Summaries(SummaryWriter):
    def _get_file_writer(self) -> Any:
        if self.file_writer is None:
            writer: Any = _EventWriter(self.log_dir)
            self.file_writer, self.all_writers = writer, {self.log_dir: writer}  # type: ignore[assignment]  # typed as None
        return self.file_writer


class _EventWriter(FileWriter):
    def __init__(self, log_dir: str) -> None:
        self.event_writer = _EventFile(Path(log_dir))


class _EventFile:
    """A file of events, in place of TensorBoard's ``EventFileWriter``."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        name = f"{int(time.time()):010d}.{socket.gethostname()}.{os.getpid()}.{next(_count)}"
        self._file = GrowingFile(folder / f"events.out.tfevents.{name}")
        self._records = RecordWriter(self._file)
        self.add_event(Event(wall_time=time.time(), file_version="brain.Event:2"))

    def add_event(self, event: Event) -> None:
        """Add an event."""
        self._records.write(event.SerializeToString())

    def flush(self) -> None:
        """Do nothing: events are in the file at once."""

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def trim_events(folder: Path, steps: int) -> None:
    """Remove the events after a given number of steps, and incomplete ones.

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
