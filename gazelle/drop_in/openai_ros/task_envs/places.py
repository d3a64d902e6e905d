"""Tasks in which a robot goes to a place."""

from __future__ import annotations

from typing import Any

from gazelle.array_types import Bools, Floats
from gazelle.drop_in.openai_ros.task_envs.geometry import coordinates, euler_of, one
from gazelle.drop_in.openai_ros.task_envs.graph_task import GraphTask
from gazelle.envs.goal_rules import distance_to, is_at
from gazelle_ros.msgs import geometry_msgs


class DesiredPoint(GraphTask):
    """Part of a task: a place to reach.

    Attributes:
        desired_point: The goal, a ``geometry_msgs/Point`` [m].
        previous_distance_from_des_point: Distance from it after the step before [m].
    """

    desired_point: Any
    previous_distance_from_des_point: float = 0.0

    def _comes_nearer(self, distance: float) -> Bools:
        """Return whether a distance from the goal [m] is less than the last one, and keep it."""
        nearer = one(distance < self.previous_distance_from_des_point)
        self.previous_distance_from_des_point = distance
        return nearer

    def _edges(self, axis: str) -> tuple[float, float]:
        """Return the least and the largest place along an axis in the work space [m]."""
        return self.number(f"work_space/{axis}_min"), self.number(f"work_space/{axis}_max")

    def _goal(self) -> Floats:
        """Return x, y and z of the goal [m], shape (3,)."""
        return coordinates(self.desired_point).reshape(-1)

    def is_in_desired_position(
        self, current_position: geometry_msgs.msg.Point, epsilon: float = 0.05
    ) -> bool:
        """Return whether a place is the goal; heights do not count."""
        return bool(is_at(coordinates(current_position), self._goal(), epsilon)[0])

    def get_distance_from_desired_point(self, current_position: geometry_msgs.msg.Point) -> float:
        """Return how far a place is from the goal [m]."""
        return float(distance_to(coordinates(current_position), self._goal())[0])

    def get_orientation_euler(
        self, quaternion_vector: geometry_msgs.msg.Quaternion
    ) -> tuple[float, float, float]:
        """Return roll, pitch and yaw [rad]."""
        return euler_of(quaternion_vector)
