"""The nodelet ``yocs_diff_drive_pose_controller``: smooth curves to a pose (http://wiki.ros.org/yocs_diff_drive_pose_controller).

J. J. Park and B. Kuipers, "A smooth control law for graceful motion of differential wheeled mobile robots in
2D environment", ICRA 2011.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from dataclasses import dataclass, replace
from typing import Any

from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.parameters import private_values, settings_of
from gazelle_ros.builtin.speeds import Speeds, repeat, twist_of
from gazelle_ros.builtin.switching import EnableSwitch
from gazelle_ros.msgs import geometry_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform, TransformException
from gazelle_ros.tf.listening import FrameListener

_ORIENTATION_GAIN = 0.3
_EPSILON = 0.2  # Share of a threshold by which a reached pose may be left again
_STRAIGHT = 1e-9
_QUIET_S = 1.0
_QUEUE = 10
_LOG = logging.getLogger("gazelle.ros.pose_controller")


@dataclass(frozen=True, slots=True)
class PoseControllerSettings:
    """Parameters of ``yocs_diff_drive_pose_controller``, with its defaults.

    Attributes:
        base_frame_name: Frame of the robot.
        goal_frame_name: Frame of the pose to reach.
        start_enabled: Whether it begins without ``~enable``.
        spin_rate: Rate of the commands [Hz].
        v_min: Least speed while it drives [m/s].
        v_max: Greatest speed [m/s].
        w_min: Least rate of turning while it turns [rad/s].
        w_max: Greatest rate of turning [rad/s].
        k_1: Ratio of the rate of change of theta to that of the distance.
        k_2: Gain of the direction.
        beta: Decrease of the speed with the curvature.
        lambda_: Exponent of the curvature; the parameter is ``lambda``.
        dist_thres: Distance at which the place is reached [m].
        orient_thres: Difference of headings at which the pose is reached [rad].
        dist_eps: More distance at which a reached pose is left [m].
        orient_eps: More difference of headings, likewise [rad].
    """

    base_frame_name: str = "base_footprint"
    goal_frame_name: str = "base_goal_pose"
    start_enabled: bool = True
    spin_rate: float = 20.0
    v_min: float = 0.01
    v_max: float = 0.5
    w_min: float = 0.01
    w_max: float = 0.5 * math.pi / 4.0
    k_1: float = 1.0
    k_2: float = 3.0
    beta: float = 0.4
    lambda_: float = 2.0
    dist_thres: float = 0.01
    orient_thres: float = 0.02
    dist_eps: float = 0.01 * _EPSILON * _EPSILON
    orient_eps: float = 0.02 * _EPSILON

    @classmethod
    def read(cls, node: Node) -> PoseControllerSettings:
        """Read the private parameters of a node.

        Raises:
            Error: One is of another kind, or out of range.
        """
        values = private_values(node)
        found = settings_of(node, cls, others=("lambda",))
        positive("spin_rate", found.spin_rate)
        derived: dict[str, Any] = {"lambda_": float(values.get("lambda", found.lambda_))}
        if "w_max" not in values:
            derived["w_max"] = found.v_max * math.pi / 4.0
        if "orient_eps" not in values:
            derived["orient_eps"] = found.orient_thres * _EPSILON
        return replace(found, **derived)

    def command(self, distance: float, delta: float, theta: float, before: float) -> Speeds:
        """Return the speeds on the way to the pose.

        Args:
            distance: To it [m].
            delta: Heading of the robot against the line to it [rad].
            theta: Heading of the pose against that line [rad].
            before: Last speed [m/s].
        """
        bend = math.atan2(-self.k_1 * theta, 1.0)
        slope = 1.0 + self.k_1 / (1.0 + (self.k_1 * theta) ** 2)
        curvature = -(self.k_2 * (delta - bend) + slope * math.sin(delta)) / distance
        speed = self.v_max / (1.0 + self.beta * abs(curvature) ** self.lambda_)
        speed = min(_least(speed, self.v_min), self.v_max)
        turn = self._turn(curvature * speed)
        if abs(curvature) > _STRAIGHT:
            speed = turn / curvature
        speed = min(max(_least(speed, self.v_min), self.v_min), self.v_max)
        most = self.v_max / self.spin_rate
        return before + min(max(speed - before, -most), most), turn

    def turning(self, difference: float) -> float:
        """Return the rate of turning on the spot [rad/s] at a difference of headings [rad]."""
        return self._turn(_ORIENTATION_GAIN * difference)

    def _turn(self, rate: float) -> float:
        return min(max(_least(rate, self.w_min), -self.w_max), self.w_max)


def _least(value: float, least: float) -> float:
    """Return a value, or the least one of its sign."""
    return min(value, -least) if value < 0.0 else max(value, least)


class PoseController:
    """Commands on ``~command_velocity`` that bring the robot to the pose of a frame.

    ``~enable`` names another frame, or none for the same; ``~control_max_vel`` changes the greatest speed.
    ``~pose_reached`` reports once that the pose is reached.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.settings = PoseControllerSettings.read(node)
        self._goal = self.settings.goal_frame_name
        self._speed, self._reached = 0.0, False
        self._warned = -math.inf
        self.tree = FrameListener(node).tree
        self._output = node.advertise(
            "~command_velocity", geometry_msgs.msg.Twist, queue_size=_QUEUE
        )
        self._done = node.advertise("~pose_reached", std_msgs.msg.Bool, queue_size=_QUEUE)
        self.switch = EnableSwitch(
            node, on=self.settings.start_enabled, kind=std_msgs.msg.String, change=self._change
        )
        node.subscribe("~control_max_vel", std_msgs.msg.Float32, self._limit, _QUEUE)

    def run(self, stop: threading.Event) -> None:
        """Publish commands until shutdown."""
        repeat(self._node, self.settings.spin_rate, self.step, stop)

    def step(self) -> None:
        """Publish a command, if it is enabled and the pose is known."""
        if not self.switch.on:
            return
        base = self.settings.base_frame_name.strip("/")
        try:
            found = self.tree.lookup(base, self._goal.strip("/"))
        except TransformException as error:
            if time.monotonic() - self._warned > _QUIET_S:
                self._warned = time.monotonic()
                _LOG.warning("%s: the goal is not known: %s", self._node.name, error)
            return
        speeds = self._towards(found)
        self._output.publish(twist_of((0.0, 0.0) if self._reached else speeds))

    def _towards(self, goal: StampedTransform) -> Speeds:
        """Return the speeds to a pose in the robot's frame, and note whether it is reached."""
        own, (x, y, _) = self.settings, goal.translation
        distance, delta = math.hypot(x, y), math.atan2(-y, x)
        theta = math.remainder(_yaw(goal) + delta, 2.0 * math.pi)
        difference = math.remainder(theta - delta, 2.0 * math.pi)
        near = distance <= own.dist_thres
        if near:
            speeds = 0.0, own.turning(difference)
        else:
            speeds = own.command(distance, delta, theta, self._speed)
        self._speed = speeds[0]
        if near and abs(difference) <= own.orient_thres:
            if not self._reached:
                self._reached = True
                self._done.publish(std_msgs.msg.Bool(data=True))
        elif distance > own.dist_thres + own.dist_eps or (
            abs(difference) > own.orient_thres + own.orient_eps
        ):
            self._reached = False
        return speeds

    def _change(self, message: Any) -> None:
        """Take the frame of a message that enables; stop with one that disables."""
        self._goal = getattr(message, "data", "") or self._goal
        if not self.switch.on:
            self._speed = 0.0

    def _limit(self, message: std_msgs.msg.Float32) -> None:
        if message.data > 0.0:
            self.settings = replace(self.settings, v_max=float(message.data))


def _yaw(transform: StampedTransform) -> float:
    x, y, z, w = transform.rotation
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
