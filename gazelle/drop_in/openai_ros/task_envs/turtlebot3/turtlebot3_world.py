"""TurtleBot3 wanders among the pillars of its world."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.openai_ros.robot_envs.turtlebot3_env import TurtleBot3Env
from gazelle.drop_in.openai_ros.task_envs.jolts import ImuSteeringTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.discrete_drive.rules import TURTLEBOT3_WORLD, DriveRules
from gazelle_ros.msgs import sensor_msgs

register_task("TurtleBot3World-v0")


class TurtleBot3WorldEnv(ImuSteeringTask, TurtleBot3Env):
    """Go without touching anything; parameters under ``/turtlebot3``.

    Observation: every ``round(n / new_ranges)``-th of the n ranges, cut to whole metres; 6 for no return.
    Actions: see `SteeringTask`. Reward: 5 forward, 1 for a turn, -200 for the end. End: a sampled range
    below 0.2 m, or an acceleration above ``max_linear_aceleration`` (the IMU of this robot shows gravity).
    """

    space: ClassVar[str] = "turtlebot3"
    published: ClassVar[DriveRules] = TURTLEBOT3_WORLD

    def __init__(self) -> None:
        workspace = self._begin("turtlebot3/turtlebot3_world", "turtlebot3_gazebo")
        super().__init__(workspace)
        self._read_steering()
        self._read_motion_rewards()
        self.new_ranges = int(self.parameter("new_ranges"))
        self.observation_space = self._space(self._get_obs())

    def _get_obs(self) -> list[float]:
        return self.discretize_scan_observation(self.laser_scan, self.new_ranges)

    def discretize_scan_observation(
        self, data: sensor_msgs.msg.LaserScan, new_ranges: int
    ) -> list[float]:
        """Return about ``new_ranges`` ranges of a ``sensor_msgs/LaserScan`` [m]; see `_observe`."""
        step = max(1, round(len(data.ranges) / new_ranges))
        return self._observe(self._rules(), data.ranges, step)
