"""Where a robot's joints are, by the topic ``joint_states``, and states as messages."""

from __future__ import annotations

import math
import threading
from typing import Any

from gazelle.array_types import Floats
from gazelle.planning import NoPlanError, PlanOutcome, RobotModel
from gazelle.ros.messages import load_message
from gazelle.ros.node import Node
from gazelle.ros.time import Time


class JointStateMonitor:
    """Hears where the joints are.

    Args:
        node: On the graph.
        robot: Whose joints; what is said of others is passed over.
    """

    def __init__(self, node: Node, robot: RobotModel) -> None:
        self._robot = robot
        self._positions = robot.zero()
        self._unknown = {each.name for each in robot.variables if not each.mimics}
        self._news = threading.Condition()
        node.subscribe("joint_states", load_message("sensor_msgs/JointState"), self._hear)

    def _hear(self, message: Any) -> None:
        columns = {name: column for column, name in enumerate(self._robot.names)}
        with self._news:
            for name, position in zip(message.name, message.position, strict=False):
                if name in columns and math.isfinite(position):
                    self._positions[columns[name]] = position
                    self._unknown.discard(name)
            self._news.notify_all()

    def current(self) -> Floats:
        """Of all variables, zero where nobody has said anything yet, shape (variables,)."""
        with self._news:
            return self._robot.complete(self._positions.copy())

    @property
    def unknown(self) -> list[str]:
        """Joints of which nothing is known yet."""
        with self._news:
            return sorted(self._unknown)

    def wait(self, timeout: float) -> bool:
        """Wait for all joints, at most some time [s] of the wall's clock; whether they are known."""
        with self._news:
            return self._news.wait_for(lambda: not self._unknown, timeout)


def state_of_message(robot: RobotModel, message: Any, current: Floats) -> Floats:
    """A ``moveit_msgs/RobotState`` as positions; joints that it does not name stay as they are.

    Args:
        robot: Whose state.
        message: The state.
        current: Of all variables, shape (variables,).

    Raises:
        NoPlanError: It names a joint that is not there, or a position is not finite.
    """
    joints = message.joint_state
    state = current.copy()
    if len(joints.name) != len(joints.position):
        _refuse(f"a state has {len(joints.name)} joints and {len(joints.position)} positions")
    columns = {name: column for column, name in enumerate(robot.names)}
    for name, position in zip(joints.name, joints.position, strict=True):
        if name not in columns:
            _refuse(f"the robot has no joint '{name}'")
        if not math.isfinite(position):
            _refuse(f"the position of joint '{name}' is {position}")
        state[columns[name]] = position
    return robot.complete(state)


def state_message(robot: RobotModel, state: Floats, now: int = 0) -> Any:
    """A ``moveit_msgs/RobotState`` of all variables, shape (variables,), at a time [ns]."""
    message: Any = load_message("moveit_msgs/RobotState")()
    message.joint_state.header.frame_id = robot.frame
    message.joint_state.header.stamp = Time(nsecs=now)
    message.joint_state.name = list(robot.names)
    message.joint_state.position = state.tolist()
    message.multi_dof_joint_state.header = message.joint_state.header
    return message


def _refuse(text: str) -> None:
    raise NoPlanError(text, PlanOutcome.INVALID_ROBOT_STATE)
