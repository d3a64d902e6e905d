"""The beginning of a task of your own."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces

from gazelle.drop_in.frobs_rl.templates.CustomRobotEnv import CustomRobotEnv


class CustomTaskEnv(CustomRobotEnv):
    """Observations, actions and rewards of a task: here still empty.

    Args:
        options: See `RobotBasicEnv`.
    """

    def __init__(self, **options: Any) -> None:
        self.action_space = spaces.Box(-1.0, 1.0, (1,), np.float32)
        self.observation_space = spaces.Box(-1.0, 1.0, (1,), np.float32)
        super().__init__(**options)

    def _set_episode_init_params(self) -> None:
        """Initialise the variables of an episode."""

    def _send_action(self, action: Any) -> None:
        """Publish the action, and wait while it acts."""

    def _get_observation(self) -> Any:
        """Return the present observation."""
        return np.zeros(1, np.float32)

    def _get_reward(self) -> float:
        """Return the reward of the last action."""
        return 0.0

    def _check_if_done(self) -> bool:
        """Return whether the episode is over; set ``self.info["is_success"] = 1.0`` for a success."""
        return False
