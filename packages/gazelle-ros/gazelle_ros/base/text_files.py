"""Text files in UTF-8."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

from gazelle_ros.base.errors import FormatError

MAX_BYTES = 256 * 2**20
"""Size of a file that is read as a whole: some devices never end."""
_PIECE = 2**20


def read_bytes(file: Path) -> bytes:
    """Return the content of a file, which may be a pipe.

    Raises:
        FormatError: It is larger than the limit.
        OSError: It cannot be read.
    """
    content = bytearray()
    with file.open("rb") as opened:
        while piece := opened.read(_PIECE):
            content += piece
            if len(content) > MAX_BYTES:
                raise FormatError(
                    f"it has more than the limit of {MAX_BYTES:,} bytes", file=str(file)
                )
    return bytes(content)


def read_text(file: Path) -> str:
    """Return the text of a file.

    Raises:
        FormatError: It is not in UTF-8, where the error names the line, or larger than the limit.
        OSError: It cannot be read.
    """
    try:
        text = read_bytes(file).decode("utf-8")
        return text.replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        raise FormatError(
            f"this is not UTF-8 text: {error.reason} (byte {error.object[error.start]:#04x})",
            file=str(file),
            line=error.object.count(b"\n", 0, error.start) + 1,
            hint="save it as UTF-8",
        ) from None


def read_rows(file: Path, *, whole: bool = False) -> tuple[list[str], list[dict[str, Any]]]:
    """Return the columns and the rows of a ``.csv`` file.

    Args:
        file: The table.
        whole: Leave out a last line that was cut short.

    Raises:
        FormatError: It is not a table, or not in UTF-8; the error names the line.
        OSError: It cannot be read.
    """
    lines = read_text(file).splitlines(keepends=True)
    reader = csv.DictReader(line for line in lines if line.endswith("\n") or not whole)
    try:
        return [*(reader.fieldnames or ())], [*reader]
    except csv.Error as error:  # such as a quote that is never closed
        raise FormatError(
            f"this is not a table: {error}", file=str(file), line=reader.line_num
        ) from None
