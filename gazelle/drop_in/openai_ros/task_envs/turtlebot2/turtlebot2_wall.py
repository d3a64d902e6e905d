"""TurtleBot2 goes to a place behind a wall."""

from __future__ import annotations

from typing import ClassVar

from gazelle.drop_in.openai_ros.robot_envs.turtlebot2_env import TurtleBot2Env
from gazelle.drop_in.openai_ros.task_envs.steering import SteeringTask
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import register_task
from gazelle.envs.discrete_drive.rules import WALL, DriveRules, StepRewards
from gazelle_ros.msgs import sensor_msgs

register_task("MyTurtleBot2Wall-v0", "TurtleBot2Wall-v0")

_X, _Y = (-1.0, 6.0), (-3.0, 3.0)  # where the robot may be [m]


class TurtleBot2WallEnv(SteeringTask, TurtleBot2Env):
    """Go to ``desired_pose``; parameters under ``/turtlebot2``.

    Observation: samples of the scan in whole metres, then x and y [m] with two decimals. Actions: see
    `SteeringTask`. Reward: 5 forward, 1 for a turn, 5 more when nearer to the goal, 200 for the goal,
    -200 for any other end. End: a sampled range below 0.5 m, x outside (-1, 6] or y outside (-3, 3],
    or the goal within 0.05 m along x and along y.
    """

    space: ClassVar[str] = "turtlebot2"
    published: ClassVar[DriveRules] = WALL
    place_at: ClassVar[slice | None] = slice(-2, None)

    def __init__(self) -> None:
        workspace = self._begin(
            "turtlebot2/turtlebot2_wall", "turtlebot_gazebo", "start_world_wall.launch"
        )
        super().__init__(workspace)
        self._read_steering()
        self._read_motion_rewards()
        self.new_ranges = int(self.parameter("new_ranges"))
        scan = self.discretize_observation(self.laser_scan, self.new_ranges)
        self.observation_space = self._space(scan, _X, _Y)  # openai_ros declares the scan's part

    def _step_rewards(self) -> StepRewards:
        forward, turn = self.forwards_reward, self.turn_reward
        return ((forward, forward + forward), (turn, turn + forward))

    def _get_obs(self) -> list[float]:
        scan = self.discretize_observation(self.laser_scan, self.new_ranges)
        place = self.odom.pose.pose.position
        return [*scan, round(place.x, 2), round(place.y, 2)]

    def discretize_observation(
        self, data: sensor_msgs.msg.LaserScan, new_ranges: int
    ) -> list[float]:
        """Return about ``new_ranges`` ranges of a ``sensor_msgs/LaserScan`` [m]; see `_observe`."""
        return self.discretize_scan_observation(data, new_ranges)
