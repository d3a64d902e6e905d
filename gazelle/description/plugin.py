"""A plugin as a file names it: which code, and its parameters, kept whole."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.parameters import Parameters
from gazelle.description.source import Source


@dataclass(frozen=True, slots=True)
class Plugin:
    """A ``<plugin>`` element.

    Attributes:
        name: Its name in the file.
        filename: Code: ``libgazebo_ros_diff_drive.so`` or ``package.module:Class``.
        parameters: The element, without the two attributes above, for typed access to its children.
    """

    name: str
    filename: str
    parameters: Parameters = field(default_factory=lambda: Parameters("plugin"))
    source: Source | None = field(default=None, compare=False, repr=False)
