"""Odometry from a model's true motion, as most of Gazebo's drives publish it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gazelle.plugins.frames import frames_output
from gazelle.rotations import seen_on_ground
from gazelle.simulation import Odometry, Output, Robot, Transform, Transforms
from gazelle.simulation.values import SixNumbers

POSE_VARIANCE: SixNumbers = (1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3)
"""Of planar bases that are sure of x, y and yaw."""

_ABOUT_Z = np.array([0.0, 0.0, 1.0])


def true_odometry(
    robot: Robot,
    frame: str,
    child_frame: str,
    pose_variance: SixNumbers = POSE_VARIANCE,
    twist_variance: SixNumbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
) -> Odometry:
    """The model's pose in the world, and its velocity on the ground as seen from its heading."""
    place, motion = robot.placement(), robot.motion()
    return Odometry(
        robot.simulation.clock.now_ns,
        frame,
        child_frame,
        place.position,
        place.quaternion,
        seen_on_ground(place.quaternion, motion.linear),
        motion.angular * _ABOUT_Z,
        pose_variance,
        twist_variance,
    )


class OdometryOutputs:
    """A robot's odometry and the frame of tf that says the same, computed once for both.

    Args:
        robot: Gets the outputs ``odom`` and ``odom_tf``.
        topic: Of the odometry.
        measure: The odometry now.
        namespace: Whose frame it is.
        told: Whether there is ``odom``.
        framed: Whether there is ``odom_tf``.
    """

    def __init__(
        self,
        robot: Robot,
        topic: str,
        measure: Callable[[], Odometry],
        namespace: str,
        *,
        told: bool = True,
        framed: bool = True,
    ) -> None:
        self._measure = measure
        self._odom: Output[Odometry] | None = None
        self._frame: Output[Transforms] | None = None
        if told:
            self._odom = robot.outputs["odom"] = Output(
                topic, Odometry, measure, namespace=namespace
            )
        if framed:
            self._frame = robot.outputs["odom_tf"] = frames_output(
                lambda: as_transforms(measure()), namespace
            )

    @property
    def wanted(self) -> bool:
        """Whether anybody listens to either."""
        odom, frame = self._odom, self._frame
        return (odom is not None and odom.wanted) or (frame is not None and frame.wanted)

    def publish(self) -> None:
        """Compute the odometry and hand it to all who listen, if anybody does."""
        if not self.wanted:
            return
        odometry = self._measure()
        if self._odom is not None and self._odom.wanted:
            self._odom.hand(odometry)
        if self._frame is not None and self._frame.wanted:
            self._frame.hand(as_transforms(odometry))


def as_transforms(odometry: Odometry) -> Transforms:
    """The same pose as a frame of tf."""
    place = Transform(odometry.frame, odometry.child_frame, odometry.position, odometry.quaternion)
    return Transforms(odometry.stamp, (place,))
