"""The mixtures of the real ROS 1 and Gazelle in which the suites are run."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

USED = "run-by-gazelle"
"""The file that lists the scripts which Gazelle ran."""

_ROBOTS = Path(__file__).parent / "robots"
GAZELLE = Path(sys.executable).parent / "gazelle-ros"
_TOOLS = {
    "rosbag": "bag",
    "rosnode": "node",
    "rosparam": "param",
    "rosservice": "service",
    "rostopic": "topic",
    "roslaunch": "launch",
}


@dataclass(frozen=True)
class Stack:
    """What of Gazelle takes the real one's place; the rest is Debian's.

    Attributes:
        name: What the table calls it.
        master: The master and parameter server.
        clients: The Python modules of tests and nodes (rospy, actionlib, tf, ...).
        tools: rostopic and its like, as tests call them.
        launcher: rostest, which starts the tests and their nodes.
    """

    name: str
    master: bool = False
    clients: bool = False
    tools: bool = False
    launcher: bool = False

    @property
    def replaces(self) -> frozenset[str]:
        """Which parts are Gazelle's."""
        parts = {"master": self.master, "clients": self.clients, "tools": self.tools}
        return frozenset(part for part, ours in parts.items() if ours)


STACKS = {
    stack.name: stack
    for stack in (
        Stack("real"),
        Stack("master", master=True),
        Stack("clients", clients=True, tools=True),
        Stack("both", master=True, clients=True, tools=True),
        Stack("alone", master=True, clients=True, tools=True, launcher=True),
    )
}


def lay_out(stack: Stack, folder: Path) -> dict[str, str]:
    """Prepare the programs that a stack puts first on PATH.

    Args:
        stack: The mixture.
        folder: An empty folder for them; the suites' packages are in ``packages`` in it, message
            classes for the real client in ``generated``.

    Returns:
        The environment, but for ROS_HOME.
    """
    programs = folder / "bin"
    programs.mkdir(parents=True)
    _python(folder, ours=stack.clients)
    paths = [folder / ("borrowed" if stack.launcher else "generated")]
    if stack.master and not stack.launcher:
        paths.insert(0, Path(__file__).parent / "substitute")
        _script(programs / "rosmaster", _MASTER)
    if stack.tools:
        for tool, command in _TOOLS.items():
            _script(programs / tool, f'exec "{GAZELLE}" {command} "$@"')
    if stack.launcher:
        _script(programs / "rostest", f'shift; exec "{GAZELLE}" launch --test --results "$@"')
    # Tests ask where roslaunch lives; it is the real one that runs them.
    (folder / "installed").mkdir()
    (folder / "installed/roslaunch").symlink_to("/usr/share/roslaunch", target_is_directory=True)
    # One test of rospy's wants it, and a user's environment would have it.
    (folder / "borrowed").mkdir()
    (folder / "borrowed/psutil").symlink_to("/usr/lib/python3/dist-packages/psutil")
    kept = {key: os.environ[key] for key in ("HOME", "LANG", "TMPDIR") if key in os.environ}
    return kept | {
        "PATH": f"{programs}:/usr/bin:/bin:/usr/sbin:/sbin",
        "PYTHONPATH": ":".join(map(str, paths)),
        "PYTHONDONTWRITEBYTECODE": "1",
        "ROS_PACKAGE_PATH": f"{folder / 'packages'}:{folder / 'installed'}",
        "ROS_IP": "127.0.0.1",
        "ROS_ROOT": "/usr/share/ros",
        "ROS_DISTRO": "debian",
        "ROS_PYTHON_VERSION": "3",
        "MASTER_COMMAND": f"{GAZELLE} master --no-rosout --port {{port}}",
    }


def put_robots(robots: Mapping[str, str], package: Path) -> None:
    """Add programs to a package that start stand-ins of its robots, with Gazelle's Python."""
    for name, command in robots.items():
        _script(package / name, f'exec "{sys.executable}" "{_ROBOTS}/"{command} "$@"')


# rostest and roslaunch name the port; what else they ask for only the real one knows.
_MASTER = f"""port=11311
while [ $# -gt 0 ]; do
    case "$1" in -p) port="$2"; shift;; esac
    shift
done
exec "{GAZELLE}" master --no-rosout --port "$port\""""


def _python(folder: Path, *, ours: bool) -> None:
    """Write the interpreter: Gazelle's for files of the suites, Debian's for all others."""
    text = 'exec /usr/bin/python3 "$@"'
    if ours:
        text = f"""case "$1" in
{folder}/packages/*)
    export PYTHONPATH="{folder}/borrowed"
    echo "$1" >>"$ROS_HOME/{USED}"
    exec "{GAZELLE}" exec "$@";;
esac
{text}"""
    for name in ("python", "python3"):
        _script(folder / "bin" / name, text)


def _script(path: Path, text: str) -> None:
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
