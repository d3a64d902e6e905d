"""The two fields that nearly every answer of Gazebo's services has."""

from __future__ import annotations

from typing import Any

Answer = Any
"""A response, or a dict of its fields."""


def yes(text: str) -> dict[str, Any]:
    """Return the answer of a successful call."""
    return {"success": True, "status_message": text}


def no(text: str) -> dict[str, Any]:
    """Return the answer of a failed call, with the reason."""
    return {"success": False, "status_message": text}
