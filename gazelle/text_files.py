"""Text files in UTF-8."""

from __future__ import annotations

from pathlib import Path

from gazelle.errors import FormatError


def read_text(file: Path) -> str:
    """Return the text of a file.

    Raises:
        FormatError: It is not in UTF-8; the error names the line.
        OSError: It cannot be read.
    """
    try:
        return file.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise FormatError(
            f"this is no text in UTF-8: {error.reason} (byte {error.object[error.start]:#04x})",
            file=str(file),
            line=error.object.count(b"\n", 0, error.start) + 1,
            hint="save it as UTF-8",
        ) from None
