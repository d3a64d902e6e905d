"""Cut episodes after some steps."""

from __future__ import annotations

from typing import Any

from gazelle.drop_in.gym.core import Step, Wrapper
from gazelle.drop_in.gym.error import ResetNeeded


class TimeLimit(Wrapper):
    """Ends an episode after some steps; then ``info["TimeLimit.truncated"]`` is whether it went on.

    Args:
        env: Any environment.
        max_episode_steps: By default those of its registration.
    """

    def __init__(self, env: Any, max_episode_steps: int | None = None) -> None:
        super().__init__(env)
        registered = None if self.spec is None else self.spec.max_episode_steps
        self._max_episode_steps = max_episode_steps or registered
        self._elapsed_steps: int | None = None

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        self._elapsed_steps = 0
        return self.env.reset(**options)

    def step(self, action: Any) -> Step:
        """Step the environment.

        Raises:
            ResetNeeded: No episode has begun.
        """
        if self._elapsed_steps is None:
            raise ResetNeeded("call reset() before step()")
        observation, reward, done, info = self.env.step(action)
        self._elapsed_steps += 1
        if self._max_episode_steps and self._elapsed_steps >= self._max_episode_steps:
            info["TimeLimit.truncated"] = not done
            done = True
        return observation, reward, done, info
