"""Tables of a run that a training adds rows to."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import FormatError
from gazelle_ros.base.text_files import read_rows


def row_bytes(
    rows: Iterable[Mapping[str, Any]], columns: Sequence[str], *, header: bool = False
) -> bytes:
    """Return rows of a table as its file has them.

    Args:
        rows: Values by column; others are left out, and missing ones are empty.
        columns: Of the table.
        header: Whether the names of the columns come first.
    """
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, columns, restval="", extrasaction="ignore")
    if header:
        writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()


def rows_until(file: Path, column: str, steps: int) -> list[dict[str, str]]:
    """Return the rows of a table up to a number of control steps; none if there is no table.

    Args:
        file: The table.
        column: Column with the number of control steps.
        steps: Rows beyond these are left out.

    Raises:
        FormatError: A row has no such number, or this is not a table.
    """
    if not file.exists():
        return []
    rows = []
    for number, row in enumerate(read_rows(file)[1], 2):
        try:
            done = int(row[column])
        except (KeyError, TypeError, ValueError):
            hint = "a training writes this table: delete it, or put back how it was"
            message = f"expected a whole number in the column '{column}'"
            raise FormatError(message, file=str(file), line=number, hint=hint) from None
        if done <= steps:
            rows.append({name: value for name, value in row.items() if name is not None})
    return rows
