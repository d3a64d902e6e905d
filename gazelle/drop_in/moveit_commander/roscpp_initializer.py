"""The beginning and the end of what is C++ in MoveIt."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.drop_in.moveit_client.session import session

__all__ = ["roscpp_initialize", "roscpp_shutdown"]

_NAME = "move_group_commander_wrappers"


def roscpp_initialize(args: Sequence[str]) -> None:
    """Set remappings of a command line; a node's name among them is the script's own."""
    session.prepare(_NAME, [each for each in args if not each.startswith("__name:=")])


def roscpp_shutdown() -> None:
    """Shut down a node that is not rospy's."""
    session.close()
