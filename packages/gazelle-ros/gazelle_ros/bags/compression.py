"""Compression of chunks: none, bz2, or lz4 (its frame format)."""

from __future__ import annotations

import bz2
import importlib
from typing import Any

from gazelle_ros.bags.errors import BagError, BagFormatError
from gazelle_ros.base.errors import MissingExtraError, did_you_mean

NONE, BZ2, LZ4 = "none", "bz2", "lz4"
KINDS = (NONE, BZ2, LZ4)
LARGEST = 512 * 1024 * 1024
"""Limit of a decompressed chunk; ROS writes 768 KiB and the message that passes it [bytes]."""


def check(kind: str) -> str:
    """Return the name of a compression.

    Raises:
        BagError: There is none of that name.
        MissingExtraError: It needs a package that is not installed.
    """
    if kind not in KINDS:
        raise BagError(f"'{kind}' is not a compression", hint=did_you_mean(kind, KINDS))
    if kind == LZ4:
        _lz4()
    return kind


def compress(kind: str, data: bytes) -> bytes:
    """Return compressed data.

    Raises:
        MissingExtraError: It needs a package that is not installed.
    """
    if kind == BZ2:
        return bz2.compress(data)
    if kind == LZ4:
        # roslz4 reads independent blocks, a checksum of the content, and no stored size.
        packed = _lz4().compress(data, block_linked=False, content_checksum=True, store_size=False)
        return bytes(packed)
    return data


def decompress(kind: str, data: bytes | memoryview, size: int) -> bytes:
    """Return decompressed data.

    Args:
        kind: Kind of compression.
        data: The compressed data.
        size: Its length before, for a check; 0 if unknown.

    Raises:
        BagFormatError: The data are damaged, of another length, or beyond the limit.
        MissingExtraError: It needs a package that is not installed.
    """
    if kind not in KINDS:
        raise BagFormatError(f"the compression '{kind}' is unknown")
    most = min(size or LARGEST, LARGEST)
    reader = bz2.BZ2Decompressor() if kind == BZ2 else _lz4().LZ4FrameDecompressor()
    try:
        found = bytes(reader.decompress(bytes(data), max_length=most + 1))
    except (OSError, ValueError, RuntimeError, EOFError) as error:
        raise BagFormatError(f"a chunk cannot be decompressed: {error}") from None
    if len(found) > most:
        raise BagFormatError(f"a chunk holds more than {most} bytes, of {len(data)} in the file")
    if not reader.eof:
        raise BagFormatError("a chunk cannot be decompressed: its end is missing")
    if size and len(found) != size:
        raise BagFormatError(f"a chunk holds {len(found)} bytes instead of {size}")
    return found


def _lz4() -> Any:
    try:
        return importlib.import_module("lz4.frame")
    except ImportError:
        raise MissingExtraError("lz4", "bags", "gazelle-ros") from None
