"""Menus of interactive markers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.interactive_markers.interactive_marker_server import (
    InteractiveMarkerFeedback,
)
from gazelle_ros.msgs import visualization_msgs

MenuEntry = visualization_msgs.msg.MenuEntry

__all__ = ["InteractiveMarkerFeedback", "MenuEntry", "MenuHandler"]

_NO_BOX, _CHECKED, _UNCHECKED = 0, 1, 2
_BOXES = {_NO_BOX: "", _CHECKED: "[x] ", _UNCHECKED: "[ ] "}


@dataclass
class _MenuItem:
    """An entry, with the handles of those below it."""

    title: str
    command_type: int
    command: str
    function: Callable[[Any], Any] | None
    below: list[int] = field(default_factory=list)
    visible: bool = True
    box: int = _NO_BOX


class MenuHandler:
    """One menu, for any number of markers."""

    NO_CHECKBOX = _NO_BOX
    CHECKED = _CHECKED
    UNCHECKED = _UNCHECKED

    def __init__(self) -> None:
        self._entries: dict[int, _MenuItem] = {}
        self._top: list[int] = []
        self._markers: set[str] = set()

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = MenuEntry.FEEDBACK,
        command: str = "",
        callback: Callable[[Any], Any] | None = None,
    ) -> int | None:
        """Add an entry; returns its handle, or None if there is no such parent.

        Args:
            title: Title.
            parent: Handle of the entry that it is below.
            command_type: Of MenuEntry.
            command: Command of a viewer, by the type.
            callback: Called with the feedback when it is chosen.
        """
        siblings = self._top
        if parent is not None:
            if parent not in self._entries:
                rospy.logerr(f"there is no menu entry {parent}")
                return None
            siblings = self._entries[parent].below
        handle = len(self._entries) + 1
        self._entries[handle] = _MenuItem(title, command_type, command, callback)
        siblings.append(handle)
        return handle

    def setVisible(self, handle: int, visible: bool) -> bool:  # noqa: FBT001, N802  # ROS's name
        """Show or hide an entry; returns whether there is one."""
        if handle in self._entries:
            self._entries[handle].visible = visible
        return handle in self._entries

    def setCheckState(self, handle: int, check_state: int) -> bool:  # noqa: N802  # ROS's name
        """Check an entry, or not, or give it no box; returns whether there is one."""
        if handle in self._entries:
            self._entries[handle].box = check_state
        return handle in self._entries

    def getCheckState(self, handle: int) -> int | None:  # noqa: N802  # ROS's name
        """Return whether an entry is checked; None if there is none."""
        return self._entries[handle].box if handle in self._entries else None

    def getTitle(self, handle: int) -> str | None:  # noqa: N802  # ROS's name
        """Return what an entry is called; None if there is none."""
        return self._entries[handle].title if handle in self._entries else None

    def apply(self, server: Any, marker_name: str) -> bool:
        """Set the menu of a marker; returns whether there is one.

        The server's changes are to be applied. The server's changes are to be applied.
        """
        marker = server.get(marker_name)
        if marker is None:
            self._markers.discard(marker_name)
            return False
        marker.menu_entries = list(self._shown(self._top, 0))
        server.insert(marker, self.processFeedback, InteractiveMarkerFeedback.MENU_SELECT)
        self._markers.add(marker_name)
        return True

    def reApply(self, server: Any) -> bool:  # noqa: N802  # ROS's name
        """Set the menu of all its markers again; returns whether all exist."""
        found = [self.apply(server, name) for name in sorted(self._markers)]
        return all(found)

    def _shown(self, handles: list[int], parent: int) -> Iterator[Any]:
        for handle in handles:
            entry = self._entries[handle]
            if entry.visible:
                title = _BOXES[entry.box] + entry.title
                yield MenuEntry(handle, parent, title, entry.command, entry.command_type)
                yield from self._shown(entry.below, handle)

    def processFeedback(self, feedback: visualization_msgs.msg.InteractiveMarkerFeedback) -> None:  # noqa: N802  # ROS's name
        """Call the function of the entry that was chosen."""
        entry = self._entries.get(feedback.menu_entry_id)
        if entry is not None and entry.function is not None:
            entry.function(feedback)
