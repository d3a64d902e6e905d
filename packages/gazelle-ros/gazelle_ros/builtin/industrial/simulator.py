"""The node ``industrial_robot_simulator``: a robot controller that follows trajectories exactly (http://wiki.ros.org/industrial_robot_simulator)."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Sequence
from typing import Any

from gazelle_ros import __version__
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.base.real_numbers import real
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.industrial.joint_names import given_joints
from gazelle_ros.builtin.industrial.motion import WaypointMotion, waypoints_of
from gazelle_ros.builtin.parameters import warn_of_others
from gazelle_ros.builtin.speeds import repeat
from gazelle_ros.clock import SECOND
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import control_msgs, industrial_msgs, sensor_msgs, trajectory_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_LOG = logging.getLogger("gazelle.ros.industrial")


def main(arguments: Sequence[str]) -> int:
    """Run a simulated robot controller until shutdown; returns the exit code."""
    return run_node(arguments, "industrial_robot_simulator", RobotSimulator)


class RobotSimulator:
    """Joints that follow ``joint_path_command``, on ``joint_states`` and ``feedback_states``.

    A trajectory that comes during another one stops it, as an empty one does.

    Args:
        node: On the graph. Its namespace has the parameters ``pub_rate``, ``motion_update_rate``,
            ``controller_joint_names`` and ``initial_joint_state``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._lock = threading.Lock()
        self._joints = given_joints(node) or _JOINTS
        self._positions = _initial_positions(node, len(self._joints))
        self._motion: WaypointMotion | None = None
        self._began = 0
        self._rate = positive("pub_rate", node.get_param("pub_rate", 10.0))
        update = real(node.get_param("motion_update_rate", 100.0))
        if update is None or not math.isfinite(update):
            raise RosError(
                "the parameter 'motion_update_rate' must be a number; 0: no interpolation"
            )
        self._interpolated = update > 0.0
        self._info = _robot_info(node)
        warn_of_others(node, ["robot_info"])
        feedback = control_msgs.msg.FollowJointTrajectoryFeedback
        self._states = node.advertise("joint_states", sensor_msgs.msg.JointState, queue_size=1)
        self._feedback = node.advertise("feedback_states", feedback, queue_size=1)
        self._status = node.advertise("robot_status", industrial_msgs.msg.RobotStatus, queue_size=1)
        node.subscribe("joint_path_command", trajectory_msgs.msg.JointTrajectory, self._command)
        node.serve("get_robot_info", industrial_msgs.srv.GetRobotInfo, lambda _request: self._info)

    def run(self, stop: threading.Event) -> None:
        """Publish the state until shutdown."""
        repeat(self._node, self._rate, self._publish, stop)

    def _command(self, message: trajectory_msgs.msg.JointTrajectory) -> None:
        now = self._node.clock.now()
        with self._lock:
            self._advance(now)
            if self._motion is not None:
                if message.points:
                    _LOG.error("a trajectory came during another one, which is stopped")
                self._motion = None
                return
            try:
                points = waypoints_of(message, self._joints)
            except RosError as error:
                _LOG.error("%s", error.message)
                return
            if points:
                start, smooth = self._positions, self._interpolated
                self._motion = WaypointMotion(start, points, interpolated=smooth)
                self._began = now

    def _advance(self, now: int) -> None:
        """Move the joints to where they are at a time [ns]."""
        if self._motion is not None:
            passed = (now - self._began) / SECOND
            self._positions = self._motion.at(passed)
            if passed >= self._motion.duration:
                self._motion = None

    def _publish(self) -> None:
        now = self._node.clock.now()
        with self._lock:
            self._advance(now)
            positions, moves = list(self._positions), self._motion is not None
        stamp = Time(nsecs=now)
        state = sensor_msgs.msg.JointState(name=self._joints, position=positions)
        state.header.stamp = stamp
        self._states.publish(state)
        feedback = control_msgs.msg.FollowJointTrajectoryFeedback(joint_names=self._joints)
        feedback.header.stamp, feedback.actual.positions = stamp, positions
        self._feedback.publish(feedback)
        self._status.publish(_status(stamp, moves=moves))


def _status(stamp: Time, *, moves: bool) -> industrial_msgs.msg.RobotStatus:
    """Return the status of a robot without faults."""
    states = industrial_msgs.msg.TriState
    made = industrial_msgs.msg.RobotStatus()
    made.header.stamp = stamp
    made.mode.val = industrial_msgs.msg.RobotMode.AUTO
    made.drives_powered.val = made.motion_possible.val = states.TRUE
    made.e_stopped.val = made.in_error.val = states.FALSE
    made.in_motion.val = states.TRUE if moves else states.FALSE
    return made


def _initial_positions(node: Node, number: int) -> list[float]:
    """Return the parameter ``initial_joint_state`` [rad or m]; zeros where it does not fit."""
    given = node.get_param("initial_joint_state", None)
    if given is None:
        return [0.0] * number
    numbers = [real(each) for each in given] if isinstance(given, list) else []
    found = [each for each in numbers if each is not None and math.isfinite(each)]
    if len(found) != number or len(numbers) != number:
        _LOG.warning("initial_joint_state is not %d numbers; all joints begin at 0", number)
        return [0.0] * number
    return found


def _robot_info(node: Node) -> industrial_msgs.srv.GetRobotInfoResponse:
    """Return the names of the controller and the robot, by the parameter ``~robot_info``.

    Raises:
        RosError: It holds anything else.
    """
    given = node.get_param("~robot_info", None)
    known = {"sw_version": __version__}
    default = {"controller": known | {"model": "Industrial Robot Simulator Controller"},
               "robots": [known | {"model": "Industrial Robot Simulator Manipulator"}]}  # fmt: skip
    info: Any = default if given is None else given
    try:
        devices = [info["controller"], *info["robots"][:1]]
        controller, *robots = [industrial_msgs.msg.DeviceInfo(**each) for each in devices]
    except (TypeError, KeyError, AttributeError) as error:
        hint = "controller and robots have model, serial_number, hw_version, sw_version, address"
        raise RosError(f"the parameter '~robot_info' is wrong: {error}", hint=hint) from None
    made = industrial_msgs.srv.GetRobotInfoResponse(controller=controller, robots=robots)
    made.code.val = industrial_msgs.msg.ServiceReturnCode.SUCCESS
    return made
