"""Plugins that stand for drives and sensors of Stage's models."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.description import Plugin


@dataclass(frozen=True, slots=True)
class StagePlugin(Plugin):
    """Drives or sees for one of Stage's models where no engine runs that as Stage does.

    One of the same kind of another source is no ``StagePlugin``, and runs everywhere.
    """
