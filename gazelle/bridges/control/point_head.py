"""The node ``point_head_action`` of ``pr2_head_action``: a head that looks at places.

It stands beside a trajectory controller of the two joints of a head, in its namespace: ``state`` says
where they are, ``command`` moves them. Its action has the name of the node.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from functools import partial

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.control.description import find_model
from gazelle.bridges.conversions import point
from gazelle.errors import ControlError, Error
from gazelle.kinematics import RobotModel
from gazelle.kinematics.pointing import Pointing
from gazelle.rotations import rotate
from gazelle_ros.actions import SimpleActionServer
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.msgs import control_msgs, geometry_msgs, tf2_msgs, trajectory_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import FrameTree, TransformException, take_transforms
from gazelle_ros.time import Duration

_PATIENCE_S = 10.0  # for the controller's first words
_GRACE_S = 3.0  # after the time that a motion is to take
_LOOK_S = 0.05  # between two looks whether a goal was given up
_SPEED = 1.0  # of a joint whose description has no limit [rad/s]


def main(arguments: Sequence[str]) -> int:
    """Serve goals for pointing the head until shutdown; returns the exit code."""
    found = parse_arguments(arguments, "point_head_action")
    with found.start() as node:
        HeadPointer(node)
        return spin(node)


class HeadPointer:
    """Points a head.

    Args:
        node: Serves ``control_msgs/PointHead`` under its own name. Parameters: ``~tilt_link``
            (head_tilt_link), which points where a goal names no frame, and
            ``~success_angle_threshold`` (0.1 rad).

    Raises:
        ControlError: There is no ``robot_description``.
    """

    def __init__(self, node: Node) -> None:
        model = find_model(node, node.name.rpartition("/")[0])
        if model is None:
            raise ControlError(
                "there is no parameter 'robot_description' with a robot that has a head"
            )
        self._node, self._robot, self._tree = node, RobotModel(model), FrameTree()
        self._link = str(node.get_param("~tilt_link", "head_tilt_link"))
        self._threshold = float(node.get_param("~success_angle_threshold", 0.1))
        self._state: control_msgs.msg.JointTrajectoryControllerState | None = None
        self._news = threading.Condition()
        frames = tf2_msgs.msg.TFMessage
        for topic, static in (("/tf", False), ("/tf_static", True)):
            node.subscribe(topic, frames, partial(self._place, static=static))
        node.subscribe(
            "state", control_msgs.msg.JointTrajectoryControllerState, self._receive_state
        )
        self._kind = trajectory_msgs.msg.JointTrajectory
        self._command = node.advertise("command", self._kind, queue_size=1)
        self._feedback = control_msgs.msg.PointHeadFeedback
        action = control_msgs.msg.PointHeadAction
        self._server = SimpleActionServer(node, node.name, action, self._work)

    def _place(self, message: tf2_msgs.msg.TFMessage, *, static: bool) -> None:
        take_transforms(self._tree, message, authority="point_head_action", static=static)

    def _receive_state(self, state: control_msgs.msg.JointTrajectoryControllerState) -> None:
        with self._news:
            self._state = state
            self._news.notify_all()

    def _work(self, goal: control_msgs.msg.PointHeadGoal) -> None:
        try:
            self._point(goal)
        except Error as error:
            self._server.set_aborted(text=error.message)

    def _point(self, goal: control_msgs.msg.PointHeadGoal) -> None:
        """Point the head to a goal.

        Raises:
            Error: It cannot be done.
        """
        state = self._next(None)
        axis = point(goal.pointing_axis)
        pointing = Pointing(
            self._robot,
            list(state.joint_names),
            goal.pointing_frame.lstrip("/") or self._link,
            axis if any(axis) else (1.0, 0.0, 0.0),
        )
        place = self._in_frame(pointing.base, goal.target)
        here = np.array(state.actual.positions)
        there, left = pointing.solve(place, here)
        seconds = max(goal.min_duration.to_sec(), self._shortest(state, there - here, goal))
        self._send(state, there, seconds)
        end = state.header.stamp.to_sec() + seconds + _GRACE_S
        while True:
            state = self._next(state)
            angle = pointing.angle(state.actual.positions, place)
            self._server.publish_feedback(self._feedback(pointing_angle_error=angle))
            if angle < self._threshold:
                self._server.set_succeeded()
                return
            if self._server.is_preempt_requested():
                self._send(state, np.array(state.actual.positions), 0.1)
                self._server.set_preempted()
                return
            arrived = np.abs(np.array(state.actual.positions) - there).max() < self._threshold / 4.0
            if arrived or state.header.stamp.to_sec() > end:
                why = "its joints' limits" if left > self._threshold else "its controller"
                raise ControlError(f"the head is {angle:.3f} rad off the target: {why}")

    def _next(
        self, known: control_msgs.msg.JointTrajectoryControllerState | None
    ) -> control_msgs.msg.JointTrajectoryControllerState:
        """Return the controller's state that follows a known one.

        Raises:
            ControlError: None comes.
        """
        with self._news:
            for _ in range(round(_PATIENCE_S / _LOOK_S)):
                if self._state is not None and self._state is not known:
                    return self._state
                if self._node.closed:
                    break
                self._news.wait(_LOOK_S)
        name = self._node.resolve("state")
        raise ControlError(
            f"no trajectory controller publishes on '{name}' the position of the head"
        )

    def _in_frame(self, base: str, target: geometry_msgs.msg.PointStamped) -> Floats:
        """Return a point in the frame of a link.

        Raises:
            ControlError: The transform of its frame is unknown.
        """
        place, frame = np.array(point(target.point)), target.header.frame_id.lstrip("/")
        if not frame:
            raise ControlError("the target has no frame_id")
        try:
            found = self._tree.lookup(base, frame)
        except TransformException as error:
            raise ControlError(f"the target's frame '{frame}' is not known: {error}") from None
        moved: Floats = rotate(np.array(found.rotation), place) + np.array(found.translation)
        return moved

    def _shortest(
        self,
        state: control_msgs.msg.JointTrajectoryControllerState,
        change: Floats,
        goal: control_msgs.msg.PointHeadGoal,
    ) -> float:
        """Return the least duration of a motion [s], by the limits of joints and goal."""
        bounds = {variable.name: variable.bounds.velocity for variable in self._robot.variables}
        most = np.array([bounds.get(name) or _SPEED for name in state.joint_names])
        most = np.where(np.isfinite(most), most, _SPEED)
        if goal.max_velocity > 0.0:
            most = np.minimum(most, goal.max_velocity)
        return float((np.abs(change) / most).max())

    def _send(
        self,
        state: control_msgs.msg.JointTrajectoryControllerState,
        positions: Floats,
        seconds: float,
    ) -> None:
        message = self._kind(joint_names=list(state.joint_names))
        made = trajectory_msgs.msg.JointTrajectoryPoint(
            positions=positions.tolist(), velocities=[0.0] * len(positions)
        )
        made.time_from_start = Duration.from_sec(max(seconds, 0.01))
        message.points = [made]
        self._command.publish(message)
