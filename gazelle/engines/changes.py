"""Which methods of an engine change what it computes."""

from __future__ import annotations

from gazelle.engines.engine import Engine
from gazelle.engines.history import CHANGES


def changes_of(engine: Engine) -> tuple[str, ...]:
    """Names of them: ``CHANGES``, and what an engine names as its ``own_changes``."""
    own: tuple[str, ...] = getattr(engine, "own_changes", ())
    return (*CHANGES, *own)
