"""Source location of a piece of a description, for error messages."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Source:
    """A place in a file.

    Attributes:
        file: Path or name of the file; None when made by code.
        line: Line in that file, counted from 1.
        element: Path of the element, such as ``model[@name='r1']/link[@name='base']``.
    """

    file: str | None = None
    line: int | None = None
    element: str | None = None
