"""Tasks in which a robot goes to a place."""

from __future__ import annotations

from typing import Any

from gazelle.compat.openai_ros.task_envs.geometry import distance, euler_of, is_at, point
from gazelle.compat.openai_ros.task_envs.steering import SteeringTask


class DesiredPoint:
    """Common base of tasks with a position to reach.

    Attributes:
        desired_point: The goal, a ``geometry_msgs/Point`` [m].
        previous_distance_from_des_point: How far it was in the step before [m].
    """

    desired_point: Any
    previous_distance_from_des_point: float = 0.0

    def _comes_nearer(self, place: Any) -> bool:
        """Return whether a position is nearer to the goal than the last; store the distance."""
        left = self.get_distance_from_desired_point(place)
        nearer = left < self.previous_distance_from_des_point
        self.previous_distance_from_des_point = left
        return nearer

    def is_in_desired_position(self, current_position: Any, epsilon: float = 0.05) -> bool:
        """Return whether a position is the goal; heights do not count."""
        return is_at(current_position, self.desired_point, epsilon)

    def get_distance_from_desired_point(self, current_position: Any) -> float:
        """From a place to the goal [m]."""
        return distance(current_position, self.desired_point)

    def get_orientation_euler(self, quaternion_vector: Any) -> tuple[float, float, float]:
        """Roll, pitch and yaw [rad]."""
        return euler_of(quaternion_vector)


class PlaceTask(DesiredPoint, SteeringTask):
    """The parameter ``desired_pose`` says where to go.

    Attributes:
        odom: The robot's last ``nav_msgs/Odometry``, of its robot environment.
    """

    odom: Any

    def _read_place(self) -> None:
        """Take the goal from the parameters; after `_read_steering`."""
        self.desired_point = point(*(self.parameter(f"desired_pose/{axis}") for axis in "xyz"))
        self.previous_distance_from_des_point = 0.0

    def _init_env_variables(self) -> None:
        super()._init_env_variables()
        self.previous_distance_from_des_point = self.get_distance_from_desired_point(
            self.odom.pose.pose.position
        )
