"""A robot of the parameter server and where its joints are, shared by all clients of a process."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterable

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.moveit.description import (
    DESCRIPTION,
    description_text,
    robot_of_parameters,
)
from gazelle.bridges.moveit.robot_states import JointStateMonitor
from gazelle.drop_in.moveit_client.robot_names import RobotNames
from gazelle.drop_in.moveit_client.session import LOG, session
from gazelle.errors import Error
from gazelle_ros import names
from gazelle_ros.msgs import moveit_msgs
from gazelle_ros.node import Node

_WAIT_S = 1.0
"""For a state that is as new as the question, as MoveIt's clients wait."""


class RobotAccess:
    """Client-side model of a robot, which needs no calls to ``move_group``.

    Args:
        node: On the graph.
        description: Parameter with its URDF.
        namespace: Of its ``joint_states``.

    Attributes:
        robot: Its kinematics.
        names: Its joints, links and groups, as MoveIt lists them.

    Raises:
        RuntimeError: There is no description, or it cannot be read.
    """

    def __init__(self, node: Node, description: str, namespace: str) -> None:
        self.node = node
        try:
            self.robot = robot_of_parameters(node, description)
            self.names = RobotNames(description_text(node, description), self.robot.semantics)
        except Error as error:
            text = (
                "Unable to construct robot model. Please make sure all needed information is on the"
            )
            LOG.critical("%s parameter server: %s", text, error)
            raise RuntimeError(f"{text} parameter server: {error}") from error
        self._monitor = JointStateMonitor(node, self.robot, names.join(namespace, "joint_states"))

    # -- states --------------------------------------------------------------------------

    def default(self) -> Floats:
        """Return all variables at zero, or in the middle of limits without zero."""
        lower, upper = self.robot.limits()
        with np.errstate(invalid="ignore"):
            middle = (lower + upper) / 2.0
        inside = (lower <= 0.0) & (upper >= 0.0)
        return self.robot.complete(np.where(inside, 0.0, middle))

    def current(self, wait: float = _WAIT_S) -> Floats | None:
        """Return the present positions, shape (variables,); None if none arrive in time.

        Args:
            wait: The longest wait for a message that is not older than the question [s].
        """
        if not self._monitor.wait_newer(self.node.clock.now(), wait):
            LOG.error("Failed to fetch current robot state")
            return None
        return self._monitor.current()

    def known(self, wait: float = _WAIT_S) -> Floats:
        """Return the last known positions, after a wait for all joints [s] if some are not known yet."""
        if not self._monitor.wait(wait):
            LOG.warning(
                "Joint values for monitored state are requested but the full state is not known: %s",
                ", ".join(self._monitor.unknown),
            )
        return self._monitor.current()

    def with_message(self, message: moveit_msgs.msg.RobotState, state: Floats) -> Floats | None:
        """Return a ``moveit_msgs/RobotState`` over a state; None, logged, if it is invalid."""
        joints = message.joint_state
        if (
            not message.is_diff
            and not joints.name
            and not message.multi_dof_joint_state.joint_names
        ):
            LOG.error("Found empty JointState message")
            return None
        if len(joints.name) != len(joints.position):
            LOG.error("Different number of names and positions in JointState message")
            return None
        made = state.copy()
        for name, position in zip(joints.name, joints.position, strict=True):
            if name in self.robot.names:
                made[self.robot.column(name)] = position
        return self.robot.complete(made)

    def message(self, state: Floats) -> moveit_msgs.msg.RobotState:
        """Return a ``moveit_msgs/RobotState`` of all variables, without a time."""
        made = moveit_msgs.msg.RobotState()
        made.joint_state.header.frame_id = self.robot.frame
        made.multi_dof_joint_state.header.frame_id = self.robot.frame
        ordered = self.ordered()
        made.joint_state.name = ordered
        made.joint_state.position = state[self.robot.columns(ordered)].tolist()
        return made

    def ordered(self) -> list[str]:
        """Return names of all variables, in MoveIt's order."""
        own = set(self.robot.names)
        listed = [name for name in self.names.variable_names() if name in own]
        return [*(name for name in self.robot.names if "/" in name), *listed]

    # -- limits --------------------------------------------------------------------------

    def within(self, state: Floats, variables: Iterable[str], margin: float) -> bool:
        """Return whether variables are within their limits, but for a margin [m or rad]."""
        for name in variables:
            column = self.robot.column(name)
            bounds = self.robot.variables[column].bounds
            if not bounds.lower - margin <= state[column] <= bounds.upper + margin:
                return False
        return True

    def bounded(self, state: Floats) -> Floats:
        """Return a state with each variable clipped to its limits, and continuous ones wrapped."""
        lower, upper = self.robot.limits()
        made = np.clip(state, lower, upper)
        for column, variable in enumerate(self.robot.variables):
            if variable.endless:
                made[column] = math.remainder(made[column], 2.0 * math.pi)
        return self.robot.complete(made)


_lock = threading.Lock()
_known: dict[tuple[int, str, str], RobotAccess] = {}


def shared_robot(description: str, namespace: str) -> RobotAccess:
    """Return the robot of a description in a namespace; read once as long as the node lives.

    Args:
        description: Name of the parameter; ``robot_description`` if empty.
        namespace: Of the robot's topics.

    Raises:
        RuntimeError: There is no description, or it cannot be read.
    """
    node = session.node()
    key = (id(node), description or DESCRIPTION, namespace)
    with _lock:
        for old in [each for each, access in _known.items() if access.node.closed]:
            del _known[old]
        if key not in _known:
            _known[key] = RobotAccess(node, *key[1:])
        return _known[key]
