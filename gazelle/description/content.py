"""Content of files with details of a world that descriptions have no terms for."""

from __future__ import annotations

from typing import Protocol


class FileContent(Protocol):
    """All that a file says of a world or model, in the terms of its format."""

    @property
    def kind(self) -> str:
        """Name of the format, by which what runs, lays out and records it is found."""
