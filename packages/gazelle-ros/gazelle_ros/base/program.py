"""Name of the command that the user started, for messages and hints."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from importlib.util import find_spec

_VARIABLE = "GAZELLE_PROGRAM"
"""Inherited by the processes that a command starts; the user reads their messages, too."""


def program_name() -> str:
    """Return ``gazelle`` or ``gazelle-ros``: the one that was started, else the one that is installed."""
    return os.environ.get(_VARIABLE) or ("gazelle" if find_spec("gazelle") else "gazelle-ros")


@contextlib.contextmanager
def running(name: str) -> Iterator[None]:
    """Set the name of the program in this process and those it starts, while the block lasts."""
    before = os.environ.get(_VARIABLE)
    os.environ[_VARIABLE] = name
    try:
        yield
    finally:
        if before is None:
            del os.environ[_VARIABLE]
        else:
            os.environ[_VARIABLE] = before
