"""TurtleBot2 wanders in a maze."""

from __future__ import annotations

import dataclasses
import math
from typing import ClassVar

from gazelle.drop_in.openai_ros.robot_envs.turtlebot2_env import TurtleBot2Env
from gazelle.drop_in.openai_ros.task_envs.steering import SteeringTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.discrete_drive.rules import MAZE, DriveRules
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import sensor_msgs

register_task("MyTurtleBot2Maze-v0", "TurtleBot2Maze-v0")


class TurtleBot2MazeEnv(SteeringTask, TurtleBot2Env):
    """Go without touching a wall; parameters under ``/turtlebot2``.

    Observation: ``n_observations`` ranges of the scan, rounded to ``number_decimals_precision_obs``; the
    scan's largest for no return. Actions: see `SteeringTask`. Reward: 5 forward, 1 for a turn, -200 for
    the end. End: a sampled range below 0.5 m.
    """

    space: ClassVar[str] = "turtlebot2"
    published: ClassVar[DriveRules] = MAZE

    def __init__(self) -> None:
        workspace = self._begin(
            "turtlebot2/turtlebot2_maze", "turtlebot_gazebo", "start_world_maze_loop_brick.launch"
        )
        super().__init__(workspace)
        self._read_steering()
        self._read_motion_rewards()
        self.dec_obs = int(rospy.get_param("/turtlebot2/number_decimals_precision_obs", 1))
        self.n_observations = int(self.parameter("n_observations"))
        self.new_ranges = math.ceil(len(self.laser_scan.ranges) / self.n_observations)
        self.observation_space = self._space(self._get_obs())

    def _get_obs(self) -> list[float]:
        return self.discretize_observation(self.laser_scan, self.new_ranges)

    def discretize_observation(
        self, data: sensor_msgs.msg.LaserScan, new_ranges: int
    ) -> list[float]:
        """Return every ``new_ranges``-th range of a ``sensor_msgs/LaserScan`` [m]; see `_observe`."""
        rules = dataclasses.replace(
            self._rules(),
            decimals=self.dec_obs,
            far=round(data.range_max, self.dec_obs),
            least=round(data.range_min, self.dec_obs),
        )
        return self._observe(rules, data.ranges, new_ranges)
