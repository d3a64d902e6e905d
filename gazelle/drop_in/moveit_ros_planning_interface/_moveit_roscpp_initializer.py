"""The module that ``moveit_commander.roscpp_initializer`` stands on.

There is no roscpp here: the clients share rospy's node, or have one of their own where a script has
none. The name of a node given before counts for the latter.
"""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.drop_in.moveit_client.session import session

__all__ = ["roscpp_init", "roscpp_shutdown"]


def roscpp_init(name: str | Sequence[str] = "", args: Sequence[str] = ()) -> None:
    """Set the name and the command line of an own node.

    Args:
        name: Of the node; a command line alone may stand here.
        args: The command line, with remappings.
    """
    if isinstance(name, str):
        session.prepare(name, args)
    else:
        session.prepare("", name)


def roscpp_shutdown() -> None:
    """Shut down an own node."""
    session.close()
