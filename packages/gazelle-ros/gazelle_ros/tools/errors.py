"""Error of the tools."""

from __future__ import annotations

from gazelle_ros.base.errors import RosError


class ToolError(RosError):
    """Error of a tool: something does not exist or cannot be done."""
