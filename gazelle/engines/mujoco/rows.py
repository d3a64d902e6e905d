"""Rows of arrays over worlds."""

from __future__ import annotations

from gazelle.array_types import Worlds


def rows_of(worlds: Worlds | None) -> slice | Worlds:
    """An index for these worlds, all if None."""
    return slice(None) if worlds is None else worlds
