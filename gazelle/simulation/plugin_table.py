"""Table of the plugin libraries that Gazelle knows.

The rows are in a package above, ``gazelle.plugins.table``, which is imported by its name when a
description first has a plugin: this room runs plugins and knows none.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Mapping
from dataclasses import dataclass

_TABLE = "gazelle.plugins.table"


@dataclass(frozen=True, slots=True)
class KnownPlugin:
    """A row: plugin libraries that do one thing, and what Gazelle has for them.

    One of ``code``, ``missing`` and ``done_by`` is given.

    Attributes:
        files: Their names, without ``lib`` and ``.so``.
        what: Purpose, in a few words.
        code: The class that does it, as ``package.module:Class``.
        missing: Missing behaviour, for the warning.
        done_by: Reason why it is not needed; without a warning.
    """

    files: tuple[str, ...]
    what: str
    code: str = ""
    missing: str = ""
    done_by: str = ""

    @property
    def purpose(self) -> str:
        """Purpose of the plugin, and what Gazelle does instead where it does not simulate it."""
        if self.missing:
            return f"{self.what} (not simulated: {self.missing})"
        return f"{self.what} (nothing to do: {self.done_by})" if self.done_by else self.what


@functools.cache
def known_plugins() -> Mapping[str, KnownPlugin]:
    """Return the rows by file name, without ``lib`` and ``.so``."""
    rows: tuple[KnownPlugin, ...] = importlib.import_module(_TABLE).TABLE
    return {name: row for row in rows for name in row.files}
