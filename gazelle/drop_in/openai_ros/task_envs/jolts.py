"""Driving tasks that an acceleration ends, too."""

from __future__ import annotations

import math
from typing import Any

from gazelle.drop_in.openai_ros.task_envs.steering import SteeringTask
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import geometry_msgs


class ImuSteeringTask(SteeringTask):
    """A `SteeringTask` of a robot with an IMU, by which it notices that it has hit something."""

    imu: Any

    def _read_steering(self) -> None:
        super()._read_steering()
        self.max_linear_aceleration = self.number("max_linear_aceleration")

    def _is_done(self, observations: Any) -> bool:
        if self.get_vector_magnitude(self.imu.linear_acceleration) > self.max_linear_aceleration:
            rospy.logwarn("the robot has hit something")
            self._episode_done = True
        return super()._is_done(observations)

    def get_vector_magnitude(self, vector: geometry_msgs.msg.Vector3) -> float:
        """Return the length of a vector."""
        return math.hypot(vector.x, vector.y, vector.z)
