"""Warnings of failed plugins, without which the simulation continues."""

from __future__ import annotations

import sys
import traceback
import warnings
from pathlib import Path

from gazelle.errors import Error, FilePlace, PluginWarning, describe, located

_LIBRARY = str(Path(__file__).parents[1])


def warn_of_fault(
    plugin: object, name: str, when: str, error: Exception, source: FilePlace | None = None
) -> None:
    """Warn of a plugin that failed, with the line where it did.

    Args:
        plugin: Plugin that failed.
        name: Such as "plugin 'drive' of 'r1'".
        when: Time of the failure, and its consequence.
        error: Its exception.
        source: Place in a file.
    """
    line = _line(plugin, error)
    if isinstance(error, Error):
        place = error if error.file or source is None else source
        said = f"{name} failed {when}: {error.message}{line}"
        text = describe(said, file=place.file, line=place.line, hint=error.hint)
    else:
        text = f"{name} failed {when}: {type(error).__name__}: {error}{line}"
        text = located(text, source)
    warnings.warn(PluginWarning(text), stacklevel=6)


def _line(plugin: object, error: Exception) -> str:
    """Return the innermost line of the plugin's own module, or else of all."""
    frames = traceback.extract_tb(error.__traceback__)
    module = getattr(sys.modules.get(type(plugin).__module__), "__file__", None)
    own = [frame for frame in frames if frame.filename == module]
    last = (own or frames)[-1]
    if isinstance(error, Error) and last.filename.startswith(_LIBRARY):
        return ""
    return f" ({last.filename}:{last.lineno})"
