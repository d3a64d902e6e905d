"""TurtleBot2 goes to a place behind a wall."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.compat.gym.spaces import Box
from gazelle.compat.openai_ros.robot_envs.turtlebot2_env import TurtleBot2Env
from gazelle.compat.openai_ros.task_envs.geometry import point
from gazelle.compat.openai_ros.task_envs.places import PlaceTask
from gazelle.compat.openai_ros.task_envs.task_commons import begin_task
from gazelle.compat.openai_ros.task_envs.task_envs_list import register_task

register_task("MyTurtleBot2Wall-v0", "TurtleBot2Wall-v0")

_LEAST, _MOST = (-1.0, -3.0), (6.0, 3.0)  # where the robot may be: x and y [m]


class TurtleBot2WallEnv(PlaceTask, TurtleBot2Env):
    """Go to ``desired_pose``; parameters under ``/turtlebot2``.

    Observation: samples of the scan in whole metres, then x and y [m] with two decimals. Actions: see
    `SteeringTask`. Reward: 5 forward, 1 for a turn, 5 more when nearer to the goal, 200 for the goal,
    -200 for any other end. End: a sampled range below 0.5 m, x outside (-1, 6] or y outside (-3, 3],
    or the goal within 0.05 m along x and along y.
    """

    def __init__(self) -> None:
        workspace = begin_task(
            "turtlebot2",
            "turtlebot2",
            "turtlebot2_wall.yaml",
            "turtlebot_gazebo",
            "start_world_wall.launch",
        )
        super().__init__(workspace)
        self._read_steering("turtlebot2")
        self.new_ranges = int(self.parameter("new_ranges"))
        self._read_laser()
        self.forwards_reward = self.parameter("forwards_reward")
        self.turn_reward = self.parameter("turn_reward")
        self.end_episode_points = self.parameter("end_episode_points")
        self._read_place()
        count = len(self.discretize_observation(self.laser_scan, self.new_ranges))
        # openai_ros declares the scan's part only.
        self.observation_space = Box(
            np.array([self.min_laser_value] * count + list(_LEAST), np.float32),
            np.array([self.max_laser_value] * count + list(_MOST), np.float32),
        )

    def _get_obs(self) -> list[float]:
        scan = self.discretize_observation(self.laser_scan, self.new_ranges)
        place = self.odom.pose.pose.position
        return [*scan, round(place.x, 2), round(place.y, 2)]

    def _is_done(self, observations: Any) -> bool:
        x, y = observations[-2:]
        inside = _LEAST[0] < x <= _MOST[0] and _LEAST[1] < y <= _MOST[1]
        if not inside or self.is_in_desired_position(point(x, y)):
            self._episode_done = True
        return self._episode_done

    def _compute_reward(self, observations: Any, done: bool) -> float:  # noqa: FBT001  # openai_ros' interface
        place = point(*observations[-2:])
        nearer = self._comes_nearer(place)
        reward = self._way_reward(done)
        if done and self.is_in_desired_position(place):
            reward = float(self.end_episode_points)
        elif not done and nearer:
            reward += float(self.forwards_reward)
        return self._count(reward)

    def discretize_observation(self, data: Any, new_ranges: int) -> list[float]:
        """Samples of a ``sensor_msgs/LaserScan`` [m]; notes whether one is too near."""
        return self._metres_seen(data, new_ranges)
