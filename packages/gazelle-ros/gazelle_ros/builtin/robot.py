"""``robot_state_publisher``, ``joint_state_publisher`` and ``joint_state_publisher_gui``."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.node import Node
from gazelle_ros.robot import JointStatePublisher, JointTree, RobotStatePublisher, read_joints

_PARAMETER = "robot_description"
_SLIDERS = "~sliders"
_LOG = logging.getLogger("gazelle.ros.joints")


def state_main(arguments: Sequence[str]) -> int:
    """Send the transforms of a robot with moving joints; returns the exit code."""
    found = parse_arguments(arguments, "robot_state_publisher")
    with found.start() as node:
        RobotStatePublisher(node, described_joints(node))
        return spin(node)


def joint_main(arguments: Sequence[str]) -> int:
    """Send positions of joints without sensors; returns the exit code."""
    found = parse_arguments(arguments, "joint_state_publisher")
    with found.start() as node:
        JointStatePublisher(node, described_joints(node))
        return spin(node)


def sliders_main(arguments: Sequence[str]) -> int:
    """Send positions of joints as sliders of a page say; returns the exit code."""
    found = parse_arguments(arguments, "joint_state_publisher_gui")
    with found.start() as node:
        JointStatePublisher(node, described_joints(node), [_SLIDERS])
        _LOG.warning(
            "%s opens no window: its sliders are the panel 'Joint sliders' of `gazelle view`, which "
            "publishes on %s",
            node.name,
            node.resolve(_SLIDERS),
        )
        return spin(node)


def described_joints(node: Node) -> JointTree:
    """Return the joints of the robot in the nearest parameter ``robot_description``.

    Raises:
        RosError: There is none, or it is malformed.
    """
    name = node.resolve(_PARAMETER)
    if not node.has_param(name):
        name = node.search_param(_PARAMETER) or ""
    text = node.get_param(name, None) if name else None
    if not isinstance(text, str):
        raise RosError(
            f"there is no parameter '{_PARAMETER}'",
            hint="set it before, as with <param name='robot_description' command='xacro ...'/>",
        )
    return read_joints(text)
