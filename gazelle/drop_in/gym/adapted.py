"""An environment of Gymnasium with the interface of the old gym."""

from __future__ import annotations

from typing import Any

import gymnasium

from gazelle.drop_in.gym.core import Env, Step


class OldInterface(Env):
    """An environment of Gymnasium: ``reset`` returns one value, ``step`` four.

    What was truncated has ``TimeLimit.truncated`` in its dictionary, as gym's own time limit writes.

    Args:
        env: With Gymnasium's interface.
    """

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        self.env = env
        self.action_space = env.action_space
        self.observation_space = env.observation_space
        self.metadata = env.metadata
        self.spec = env.spec
        self._next_seed: int | None = None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "env":
            raise AttributeError(f"{type(self).__name__} has no {name}")
        return getattr(self.env, name)

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        seed, self._next_seed = self._next_seed, None
        return self.env.reset(**{"seed": seed, **options})[0]

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, terminated, truncated, info = self.env.step(action)
        if truncated:
            info["TimeLimit.truncated"] = not terminated
        return observation, reward, terminated or truncated, info

    def seed(self, seed: int | None = None) -> list[int] | None:
        """Set the seed of the random numbers from the next ``reset`` on."""
        self._next_seed = seed
        return None if seed is None else [seed]

    def render(self, mode: str = "human") -> Any:
        """Return a picture, where it can make one; there is no window, whatever the mode."""
        del mode
        inner = self.env.unwrapped
        if inner.render_mode is None and "rgb_array" in inner.metadata.get("render_modes", ()):
            inner.render_mode = "rgb_array"
        return inner.render()

    def close(self) -> None:
        """Close the environment."""
        self.env.close()
