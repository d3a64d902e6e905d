"""Joint positions of a robot from the topic ``joint_states``, and states as messages."""

from __future__ import annotations

import math
import threading
import time

from gazelle.array_types import Floats
from gazelle.kinematics import RobotModel
from gazelle.planning import NoPlanError, PlanOutcome
from gazelle_ros.msgs import moveit_msgs, sensor_msgs
from gazelle_ros.node import Node

_REGULAR_S = 0.5
"""Between messages that come regularly, at most."""
_PERIODS, _FRESH_S = 4.0, 1.0
"""For how many of these times, and how long at most, a fresh state is waited for."""


class JointStateMonitor:
    """Subscriber of joint states.

    Args:
        node: On the graph.
        robot: Robot of the joints; others are ignored.
        topic: Of the joint states.
    """

    def __init__(self, node: Node, robot: RobotModel, topic: str = "joint_states") -> None:
        self._robot = robot
        self._stamp = -1
        self._received, self._period = -math.inf, math.inf
        self._positions = robot.zero()
        self._unknown = {each.name for each in robot.variables if not each.mimics}
        self._news = threading.Condition()
        node.subscribe(topic, sensor_msgs.msg.JointState, self._receive_states)

    def _receive_states(self, message: sensor_msgs.msg.JointState) -> None:
        columns = {name: column for column, name in enumerate(self._robot.names)}
        with self._news:
            for name, position in zip(message.name, message.position, strict=False):
                if name in columns and math.isfinite(position):
                    self._positions[columns[name]] = position
                    self._unknown.discard(name)
            self._stamp = max(self._stamp, message.header.stamp.to_nsec())
            now = time.monotonic()
            self._period, self._received = now - self._received, now
            self._news.notify_all()

    def current(self) -> Floats:
        """Return all variables, zero for those without a message yet, shape (variables,)."""
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

    def wait_newer(self, moment: int, timeout: float) -> bool:
        """Wait for a message with a stamp of a moment or later; whether there is one.

        Args:
            moment: On the graph's clock [ns].
            timeout: The longest wait [s of the wall's clock].
        """
        with self._news:
            return self._news.wait_for(lambda: self._stamp >= moment, timeout)

    def refresh(self, moment: int) -> None:
        """Wait for a message with a stamp of a moment [ns] or later, if they come regularly.

        A state published seldom or once is used as it is: the wait is a few of the times
        between messages, and none where these are long.
        """
        with self._news:
            period = self._period
            if period < _REGULAR_S and time.monotonic() - self._received < _PERIODS * period:
                wait = min(_PERIODS * period, _FRESH_S)
                self._news.wait_for(lambda: self._stamp >= moment, wait)


def state_of_message(
    robot: RobotModel, message: moveit_msgs.msg.RobotState, current: Floats
) -> Floats:
    """Convert a ``moveit_msgs/RobotState`` to positions; other joints stay as they are.

    Args:
        robot: Robot of the state.
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


def state_message(robot: RobotModel, state: Floats) -> moveit_msgs.msg.RobotState:
    """Return a ``moveit_msgs/RobotState`` of all variables, shape (variables,)."""
    message = moveit_msgs.msg.RobotState()
    message.joint_state.header.frame_id = robot.frame
    message.joint_state.name = list(robot.names)
    message.joint_state.position = state.tolist()
    message.multi_dof_joint_state.header = message.joint_state.header
    return message


def _refuse(text: str) -> None:
    raise NoPlanError(text, PlanOutcome.INVALID_ROBOT_STATE)
