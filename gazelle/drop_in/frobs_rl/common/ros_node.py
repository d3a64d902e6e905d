"""Start and end nodes."""

from __future__ import annotations

import contextlib

from gazelle.drop_in.frobs_rl.common.connection import reporting
from gazelle.drop_in.shared import background
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.errors import RosError


@reporting
def ros_node_from_pkg(
    pkg_name: str,
    node_name: str,
    launch_master: bool = False,  # noqa: FBT001, FBT002  # frobs_rl's interface
    launch_master_term: bool = True,  # noqa: FBT001, FBT002
    launch_new_term: bool = True,  # noqa: FBT001, FBT002
    name: str | None = None,
    ns: str = "/",
    output: str = "log",
) -> None:
    """Start a node of a package, and a master if there is none; they end with the script.

    Args:
        pkg_name: The package.
        node_name: The program in it.
        launch_master: Taken; a master is started if there is none.
        launch_master_term: Taken; nothing here needs a terminal.
        launch_new_term: Likewise.
        name: Of the node; the program's if None.
        ns: Its namespace.
        output: ``screen`` or ``log``.
    """
    del launch_master, launch_master_term, launch_new_term
    background.processes().start_node(
        pkg_name, node_name, name=name, namespace=ns, screen=output == "screen"
    )


def ros_kill_node(node_name: str) -> bool:
    """Request a node to shut down; returns True, also if there is none."""
    with contextlib.suppress(RosError):
        background.processes().kill(node_name)
    return True


def ros_kill_all_nodes() -> bool:
    """Request all nodes but this one to shut down; returns True, also if there is no master."""
    own = process.node.name if process.node is not None else None
    with contextlib.suppress(RosError):
        started = background.processes()
        started.kill(*(each for each in started.nodes() if each != own))
    return True


def ros_kill_master() -> bool:
    """Request the master to shut down; returns True, also if there is none."""
    with contextlib.suppress(RosError):
        background.processes().kill_master()
    return True


def ros_kill_all_processes() -> bool:
    """Stop what this script has started, all nodes but this one, and the master; returns True."""
    background.stop_all()
    ros_kill_all_nodes()
    return ros_kill_master()
