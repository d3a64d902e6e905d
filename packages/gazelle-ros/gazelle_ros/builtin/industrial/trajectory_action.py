"""The node ``joint_trajectory_action``: trajectories for a robot controller (http://wiki.ros.org/industrial_robot_client)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Sequence

from gazelle_ros.actions import ActionServer, ServerGoalHandle
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.industrial.joint_names import controller_joints
from gazelle_ros.builtin.parameters import private_values, warn_of_others
from gazelle_ros.builtin.speeds import repeat
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import control_msgs, industrial_msgs, trajectory_msgs
from gazelle_ros.node import Node

_NAME = "joint_trajectory_action"
_SILENCE_NS = SECOND
"""A controller that is silent for longer is not there [ns]."""
_WATCH_HZ = 10.0
_QUEUE = 10
"""A command to stop and the next trajectory are both sent."""
_THRESHOLD = 0.01
_ON = industrial_msgs.msg.TriState.TRUE
_RESULT = control_msgs.msg.FollowJointTrajectoryResult
_LOG = logging.getLogger("gazelle.ros.industrial")


def main(arguments: Sequence[str]) -> int:
    """Serve the action until shutdown; returns the exit code."""
    return run_node(arguments, _NAME, TrajectoryAction)


class TrajectoryAction:
    """Goals of ``joint_trajectory_action`` as ``joint_path_command``, until the joints are there.

    Args:
        node: On the graph; joints are those of ``controller_joint_names``, else of the described robot.

    Raises:
        Error: A parameter is wrong, or there are no joints.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._lock = threading.RLock()
        self._joints = controller_joints(node)
        warn_of_others(node, ["constraints"])
        constraints = private_values(node).get("constraints", {})
        values = constraints if isinstance(constraints, dict) else {}
        self._within = abs(value_of(values, "goal_threshold", _THRESHOLD)) / 2.0
        self._goal: ServerGoalHandle | None = None
        self._moved, self._due = False, 0
        self._seen: int | None = None
        self._in_motion = industrial_msgs.msg.TriState.UNKNOWN
        command, feedback = (
            trajectory_msgs.msg.JointTrajectory,
            control_msgs.msg.FollowJointTrajectoryFeedback,
        )
        self._commands = node.advertise("joint_path_command", command, queue_size=_QUEUE)
        node.subscribe("feedback_states", feedback, self._check)
        node.subscribe("robot_status", industrial_msgs.msg.RobotStatus, self._take_status)
        action = control_msgs.msg.FollowJointTrajectoryAction
        self._server = ActionServer(node, _NAME, action, self._begin, self._cancel)

    def run(self, stop: threading.Event) -> None:
        """Watch the controller until shutdown."""
        repeat(self._node, _WATCH_HZ, self._watch, stop)

    def _take_status(self, message: industrial_msgs.msg.RobotStatus) -> None:
        with self._lock:
            self._in_motion = message.in_motion.val
            self._moved = self._moved or self._in_motion == _ON

    def _watch(self) -> None:
        """End the goal of a controller that is silent."""
        with self._lock:
            now = self._node.clock.now()
            if self._seen is not None and now - self._seen > _SILENCE_NS:
                self._seen = None
                _LOG.warning("%s: the controller has been silent for 1 s", self._node.name)
                self._abort("the controller is silent")

    def _begin(self, handle: ServerGoalHandle) -> None:
        trajectory = handle.get_goal().trajectory
        with self._lock:
            refusal = self._refusal(trajectory)
            if refusal is not None:
                _LOG.error("%s: a goal is rejected: %s", self._node.name, refusal[1])
                handle.set_rejected(_RESULT(error_code=refusal[0]), refusal[1])
                return
            self._abort("a new goal came")
            handle.set_accepted()
            self._goal, self._moved = handle, False
            duration = trajectory.points[-1].time_from_start.to_nsec()
            self._due = self._node.clock.now() + duration // 2
            self._commands.publish(trajectory)

    def _refusal(self, trajectory: trajectory_msgs.msg.JointTrajectory) -> tuple[int, str] | None:
        """Return the error code and the reason for which a goal is rejected, or None."""
        if self._seen is None:
            return _RESULT.INVALID_GOAL, "Waiting for (initial) feedback from controller"
        if not trajectory.points:
            return _RESULT.INVALID_GOAL, "Empty trajectory"
        if sorted(trajectory.joint_names) != sorted(self._joints):
            return _RESULT.INVALID_JOINTS, "Joint names do not match"
        if len(trajectory.points[-1].positions) != len(trajectory.joint_names):
            return _RESULT.INVALID_GOAL, "The last point has not as many positions as joints"
        return None

    def _cancel(self, handle: ServerGoalHandle) -> None:
        with self._lock:
            if self._goal == handle:
                self._stop()
                handle.set_canceled()
                self._goal = None

    def _check(self, message: control_msgs.msg.FollowJointTrajectoryFeedback) -> None:
        """End the goal when the joints are where it ends."""
        with self._lock:
            self._seen = now = self._node.clock.now()
            if self._goal is None:
                return
            due = self._moved or now >= self._due
            if due and self._in_motion != _ON and self._arrived(message):
                self._goal.set_succeeded()
                self._goal = None

    def _arrived(self, message: control_msgs.msg.FollowJointTrajectoryFeedback) -> bool:
        """Return whether all joints are within the threshold of the goal's last point."""
        if self._goal is None or sorted(message.joint_names) != sorted(self._joints):
            return False
        trajectory = self._goal.get_goal().trajectory
        wanted = dict(zip(trajectory.joint_names, trajectory.points[-1].positions, strict=True))
        there = dict(zip(message.joint_names, message.actual.positions, strict=False))
        return all(
            name in there and abs(there[name] - position) <= self._within
            for name, position in wanted.items()
        )

    def _abort(self, text: str) -> None:
        """Stop the robot, and end the goal if there is one."""
        if self._goal is not None:
            self._stop()
            self._goal.set_aborted(text=text)
            self._goal = None

    def _stop(self) -> None:
        self._commands.publish(trajectory_msgs.msg.JointTrajectory(joint_names=self._joints))
