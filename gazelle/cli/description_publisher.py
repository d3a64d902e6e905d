"""Description and transforms of the robot that ``gazelle run --ros`` simulates."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.errors import Error

if TYPE_CHECKING:
    from gazelle.bridges import RosServer
    from gazelle.simulation import Robot, Simulation
    from gazelle_ros.robot import JointTree

_PARAMETER = "/robot_description"
_NODE = "robot_state_publisher"


@contextmanager
def publishing_descriptions(sim: Simulation, server: RosServer) -> Iterator[None]:
    """Publish ``robot_description`` and the transforms of its links while the simulation runs.

    A launch file does this with ``robot_state_publisher``; a robot of ``--spawn`` has no launch
    file. A node of that name that starts later replaces this one, as nodes do in ROS, and a
    ``robot_description`` that is there already is left alone. The first robot of a URDF file
    that has no namespace is published: frames of a second one would have the same names.

    Args:
        sim: Its robots.
        server: The simulation on the graph.
    """
    text = None if server.node.has_param(_PARAMETER) else _first_urdf(sim)
    joints = None if text is None else _joints(text)
    if joints is None:
        yield
        return
    from gazelle_ros import Node
    from gazelle_ros.robot import RobotStatePublisher

    server.node.set_param(_PARAMETER, text)
    with Node(_NODE, master_uri=server.master_uri) as node:
        RobotStatePublisher(node, joints)
        yield


def urdf_of(robot: Robot) -> str | None:
    """Return the URDF of a robot with xacro expanded, None if it comes from no such file.

    Raises:
        Error: Xacro cannot expand it.
    """
    from gazelle.clients.descriptions import read_urdf

    source = robot.description.source
    file = Path(source.file) if source is not None and source.file else None
    if file is None or not file.is_file() or file.suffix not in (".urdf", ".xacro"):
        return None
    return read_urdf(file)


def _first_urdf(sim: Simulation) -> str | None:
    roots = [robot for robot in sim.robots.values() if robot.namespace in ("", "/")]
    return next((text for robot in roots if (text := urdf_of(robot)) is not None), None)


def _joints(text: str) -> JointTree | None:
    from gazelle_ros.robot import read_joints

    try:
        return read_joints(text)
    except Error:  # its first load reported the error
        return None
