"""The definitions that come with Gazelle, one file a package.

A file has blocks that begin with ``msg NAME``, ``srv NAME`` or ``action NAME``; the indented lines
below are the definition, in ROS's language, without comments.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass, field
from pathlib import Path

from gazelle_ros.messages.parse import action_messages

_FOLDER = Path(__file__).parent / "definitions"
_BLOCK = re.compile(r"^(msg|srv|action) (\w+)\n((?:[ ].*\n|\n)*)", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Definition:
    """The text of a definition, and where it is from."""

    text: str
    file: str | None = None


@dataclass(slots=True)
class PackageDefinitions:
    """Definitions of a package, by name; the seven messages of an action are among the messages."""

    messages: dict[str, Definition] = field(default_factory=dict)
    services: dict[str, Definition] = field(default_factory=dict)
    actions: dict[str, Definition] = field(default_factory=dict)

    def add(self, kind: str, name: str, definition: Definition) -> None:
        """Add a definition of a kind: ``msg``, ``srv`` or ``action``.

        Raises:
            InvalidDefinitionError: An action has not three parts.
        """
        if kind == "srv":
            self.services[name] = definition
        elif kind == "action":
            self.actions[name] = definition
            texts = action_messages(name, definition.text, file=definition.file)
            for each, text in texts.items():
                self.messages.setdefault(each, Definition(text, definition.file))
        else:
            self.messages[name] = definition


@functools.cache
def bundled_packages() -> frozenset[str]:
    """Return names of the packages that come with Gazelle."""
    return frozenset(path.stem for path in _FOLDER.glob("*.defs"))


@functools.cache
def bundled(package: str) -> PackageDefinitions | None:
    """Return the definitions of a bundled package; None if it is not bundled."""
    if package not in bundled_packages():
        return None
    found = PackageDefinitions()
    text = (_FOLDER / f"{package}.defs").read_text(encoding="utf-8")
    for kind, name, body in _BLOCK.findall(text):
        lines = "\n".join(line.removeprefix("  ") for line in body.splitlines())
        found.add(kind, name, Definition(lines + "\n" if lines else ""))
    return found
