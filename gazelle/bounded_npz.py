"""Arrays from untrusted ``.npz`` files: no Python objects, and limited sizes."""

from __future__ import annotations

import math
import sys
import tokenize
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np

MAX_BYTES = 1 << 30
"""Size of all arrays of a file together, unpacked."""

BROKEN = (
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    NotImplementedError,
    OSError,
    RuntimeError,
    SyntaxError,
    TypeError,
    ValueError,
    tokenize.TokenError,
    zipfile.BadZipFile,
    zlib.error,
)
"""Errors that reading a damaged file raises."""


@contextmanager
def open_npz(source: Path | IO[bytes], most: int = MAX_BYTES) -> Iterator[Any]:
    """Open a file as ``numpy.load`` does, once its sizes are known to be possible.

    Args:
        source: The file.
        most: Size of all arrays together [bytes].

    Raises:
        ValueError: The arrays are larger, one says that it is larger than it is, or one has text
            that is no Unicode; any of ``BROKEN`` for a file that is damaged in another way.
    """
    with zipfile.ZipFile(source) as archive:
        total = sum(member.file_size for member in archive.infolist())
        if total > most:
            raise ValueError(f"its arrays have {total:,} bytes, more than the limit of {most:,}")
        for member in archive.infolist():
            with archive.open(member) as file:
                _refuse_damaged(file, member)
    if not isinstance(source, Path):
        source.seek(0)
    with np.load(source, allow_pickle=False) as arrays:
        yield arrays


def _refuse_damaged(file: IO[bytes], member: zipfile.ZipInfo) -> None:
    """Raise an error for a truncated array, before all of its memory is allocated, and for wrong text."""
    read = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }
    header = read.get(np.lib.format.read_magic(file))
    if header is None:
        raise ValueError(f"'{member.filename}' is of another version")
    shape, _, dtype = header(file)
    if math.prod(shape) * dtype.itemsize > member.file_size:
        raise ValueError(f"'{member.filename}' is cut off")
    if dtype.names is not None:
        raise ValueError(f"'{member.filename}' has fields")
    if dtype.kind == "U":  # numpy makes such texts, which then cannot be encoded
        points = np.frombuffer(file.read(), np.dtype("u4").newbyteorder(dtype.byteorder))
        if points.max(initial=0) > sys.maxunicode:
            raise ValueError(f"'{member.filename}' has text that is not Unicode")
