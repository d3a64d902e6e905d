"""What goes wrong with a tool."""

from __future__ import annotations

from gazelle.errors import RosError


class ToolError(RosError):
    """What was asked for is not there, or cannot be done."""
