"""Methods that MoveIt gives the message ``AllowedCollisionMatrix``."""

from __future__ import annotations

from typing import Any

from gazelle_ros.msgs import moveit_msgs


def set_default(matrix: moveit_msgs.msg.AllowedCollisionMatrix, obj: str, allow: bool) -> None:  # noqa: FBT001  # MoveIt's interface
    """Set the default for collisions of an object with others."""
    if obj in matrix.default_entry_names:
        matrix.default_entry_values[matrix.default_entry_names.index(obj)] = allow
    else:
        matrix.default_entry_names.append(obj)
        matrix.default_entry_values.append(allow)


def set_allowed(
    matrix: moveit_msgs.msg.AllowedCollisionMatrix,
    obj: str,
    other: str | None = None,
    allow: bool = True,  # noqa: FBT001, FBT002
) -> None:
    """Set whether an object may touch another, or all others by default.

    Raises:
        ValueError: The other is not in the matrix.
    """
    if other is None:
        set_default(matrix, obj, allow)
        return
    second = matrix.entry_names.index(other)
    if obj not in matrix.entry_names:
        matrix.entry_names.append(obj)
        for entry in matrix.entry_values:
            entry.enabled.append(False)
        row = moveit_msgs.msg.AllowedCollisionEntry
        matrix.entry_values.append(row(enabled=[False] * len(matrix.entry_names)))
    first = matrix.entry_names.index(obj)
    matrix.entry_values[first].enabled[second] = allow
    matrix.entry_values[second].enabled[first] = allow


def extend_messages() -> None:
    """Add both methods to the message class."""
    kind: Any = moveit_msgs.msg.AllowedCollisionMatrix
    kind.set_default, kind.set_allowed = set_default, set_allowed
