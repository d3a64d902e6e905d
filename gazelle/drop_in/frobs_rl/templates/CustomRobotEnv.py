"""The beginning of an environment of a robot of your own."""

from __future__ import annotations

from typing import Any

from gazelle.drop_in.frobs_rl.envs import robot_BasicEnv


class CustomRobotEnv(robot_BasicEnv.RobotBasicEnv):
    """Sensors and motion of a robot; tasks derive from it.

    Args:
        options: See `RobotBasicEnv`.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        # Here go publishers and subscribers.

    def _check_subs_and_pubs_connection(self) -> bool:
        """Wait until sensors and controllers answer, such as with ``rospy.wait_for_message``."""
        return True
