"""Names of ROS's command-line tools, and the corresponding commands of Gazelle."""

from __future__ import annotations

from collections.abc import Sequence

COMMANDS: dict[str, tuple[str, ...]] = {
    "rosbag": ("bag",),
    "roscore": ("launch", "--core"),
    "roslaunch": ("launch", "--nodes-survive", "--verbose"),
    "rosmaster": ("master", "--no-rosout"),
    "rosmsg": ("msg",),
    "rosnode": ("node",),
    "rosparam": ("param",),
    "rosrun": ("exec",),
    "rosservice": ("service",),
    "rossrv": ("srv",),
    "rostest": ("launch", "--test"),
    "rostopic": ("topic",),
}
"""From a tool to the words after ``gazelle``."""

NODES: dict[str, tuple[str, str]] = {
    "gazebo": ("gazebo_ros", "gazebo"),
    "gz": ("gazebo_ros", "gz"),
    "gzclient": ("gazebo_ros", "gzclient"),
    "gzserver": ("gazebo_ros", "gzserver"),
    "rospack": ("rospack", "rospack"),
    "xacro": ("xacro", "xacro"),
}
"""From a tool to the package and the type of a built-in node."""

_NAMES_NOTHING = {"--nodes-survive", "--verbose"}
"""Options that leave a process its name."""


def translated(words: Sequence[str]) -> list[str]:
    """Return the words after ``gazelle`` for a command line of ROS's.

    Args:
        words: Such as ``rostopic echo /scan`` or ``xacro robot.xacro``; others stay as they are.
    """
    first = words[0] if words else ""
    if first in COMMANDS:
        return [*COMMANDS[first], *words[1:]]
    if first in NODES:
        return ["exec", *NODES[first], *words[1:]]
    return list(words)


def process_name(words: Sequence[str]) -> str | None:
    """Return ROS's name of the process that a command line of Gazelle's stands for.

    A script that is executed keeps its own name, as with ROS.

    Args:
        words: Arguments after ``gazelle``.

    Returns:
        A name such as ``rostopic``; None if there is none.
    """
    if not words or words[0] == "exec":
        return None
    if words[0] == "master":
        return "rosmaster"
    names = {
        name: set(known[1:]) - _NAMES_NOTHING
        for name, known in COMMANDS.items()
        if known[0] == words[0]
    }
    exact = [name for name, options in names.items() if options and options <= set(words)]
    plain = [name for name, options in names.items() if not options]
    return next(iter(exact + plain), None)
