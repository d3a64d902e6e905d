"""Cut episodes after some steps."""

from __future__ import annotations

from typing import Any

import gymnasium

from gazelle.drop_in.frobs_rl.envs.robot_BasicEnv import Result
from gazelle.drop_in.frobs_rl.wrappers.modern import EitherGymApi


class TimeLimitWrapper(EitherGymApi, gymnasium.Wrapper[Any, Any, Any, Any]):
    """Ends an episode after some steps, as no success; it is terminated and truncated then.

    Args:
        env: Any environment.
        max_steps: Of an episode.
    """

    def __init__(self, env: Any, max_steps: int = 100) -> None:
        super().__init__(env)
        self.max_steps = max_steps
        self.current_step = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None, **kwargs: Any
    ) -> tuple[Any, dict[str, Any]]:
        """Start an episode; returns the first observation and a dictionary."""
        self.current_step = 0
        return self.env.reset(seed=seed, options=options, **kwargs)

    def step(self, action: Any) -> Result:
        """Step the environment; a truncated episode has ``time_limit_reached`` in ``info``."""
        observation, reward, terminated, truncated, info = self.env.step(action)
        self.current_step += 1
        if self.current_step >= self.max_steps:
            if not terminated:
                info["is_success"] = 0.0
            info["time_limit_reached"] = True
            terminated = truncated = True
        return observation, float(reward), terminated, truncated, info
