"""Detection of characters copied from web pages and word processors in files."""

from __future__ import annotations

import re
from typing import Literal, Protocol

from gazelle.description import Source
from gazelle_ros.base import characters


class Report(Protocol):
    """Callback for faults in the text of a file."""

    def __call__(
        self, message: str, source: Source, severity: Literal["error", "warning"] = "error"
    ) -> None:
        """Report a fault and its place."""


def plain_bytes(data: bytes, name: str, comment: re.Pattern[str], report: Report) -> bytes:
    """Return the text of a file with plain blanks; unusual ones give one warning.

    Args:
        data: Content of the file; it stays as it is where it is not UTF-8.
        name: The file.
        comment: Pattern of a comment, whose blanks are not reported.
        report: Takes the warning.
    """
    clean, line = characters.plain_bytes(data, comment)
    if line is not None:
        report(characters.MESSAGE, Source(name, line), "warning")
    return clean
