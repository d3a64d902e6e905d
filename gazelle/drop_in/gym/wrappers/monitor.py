"""Note the lengths and rewards of episodes in a folder."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.drop_in.gym.core import Step, Wrapper
from gazelle.drop_in.gym.error import Error
from gazelle_ros.base.writing import write_text

_PREFIX = "openaigym"


class Monitor(Wrapper):
    """Writes what every episode came to; videos are not made.

    The folder has ``openaigym.episode_batch.0.PID.stats.json`` with ``episode_lengths``,
    ``episode_rewards``, ``episode_types``, ``timestamps`` (s since 1970) and ``initial_reset_timestamp``,
    and ``openaigym.manifest.0.PID.manifest.json`` that names it. An episode that is reset before its end
    counts as it is.

    Args:
        env: Any environment.
        directory: The folder; made if it is not there.
        video_callable: Taken, as no videos are made.
        force: Delete what another monitor wrote there.
        resume: Leave it there.
        write_upon_reset: Write with every reset, not only at the end.
        uid: Put after the process's number in the names.
        mode: ``training`` or ``evaluation``.

    Raises:
        Error: Another monitor wrote there, and neither ``force`` nor ``resume`` is given.
    """

    def __init__(
        self,
        env: Any,
        directory: str | os.PathLike[str],
        video_callable: Callable[[int], bool] | bool | None = None,  # noqa: FBT001  # gym's interface
        force: bool = False,  # noqa: FBT001, FBT002
        resume: bool = False,  # noqa: FBT001, FBT002
        write_upon_reset: bool = False,  # noqa: FBT001, FBT002
        uid: str | None = None,
        mode: str | None = None,
    ) -> None:
        super().__init__(env)
        del video_callable
        self.directory = Path(directory)
        self.directory.mkdir(parents=True, exist_ok=True)
        self._clear(force=force, resume=resume)
        self._often = write_upon_reset
        self._mode = mode or "training"
        self._infix = f"0.{os.getpid()}" + (f".{uid}" if uid else "")
        self._begun: float | None = None
        self._lengths: list[int] = []
        self._rewards: list[float] = []
        self._ends: list[float] = []
        self._steps = 0
        self._reward = 0.0
        self._total = 0

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        self._end_episode()
        observation = self.env.reset(**options)
        if self._begun is None:
            self._begun = time.time()
        if self._often:
            self._write()
        return observation

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, done, info = self.env.step(action)
        self._steps += 1
        self._total += 1
        self._reward += float(reward)
        if done:
            self._end_episode()
        return observation, reward, done, info

    def close(self) -> None:
        """Write, and close the environment."""
        self._end_episode()
        self._write()
        super().close()

    def get_total_steps(self) -> int:
        """Return the number of steps of all episodes."""
        return self._total

    def get_episode_rewards(self) -> list[float]:
        """Return the total reward of each episode."""
        return self._rewards

    def get_episode_lengths(self) -> list[int]:
        """Return the number of steps of each episode."""
        return self._lengths

    def _flush(self, force: bool = False) -> None:  # noqa: FBT001, FBT002  # gym's interface
        """Write now; scripts call it though gym does not offer it."""
        del force
        self._write()

    def _end_episode(self) -> None:
        if self._steps:
            self._lengths.append(self._steps)
            self._rewards.append(self._reward)
            self._ends.append(time.time())
        self._steps, self._reward = 0, 0.0

    def _clear(self, *, force: bool, resume: bool) -> None:
        old = sorted(self.directory.glob(f"{_PREFIX}.*.json"))
        if force:
            for path in old:
                path.unlink()
        elif old and not resume:
            raise Error(
                f"another monitor wrote into {self.directory}: {old[0].name}; "
                "force=True deletes that, resume=True leaves it"
            )

    def _write(self) -> None:
        stats = f"{_PREFIX}.episode_batch.{self._infix}.stats.json"
        figures = {
            "initial_reset_timestamp": self._begun,
            "timestamps": self._ends,
            "episode_lengths": self._lengths,
            "episode_rewards": self._rewards,
            "episode_types": [self._mode[0]] * len(self._lengths),
        }
        manifest = {
            "stats": stats,
            "videos": [],
            "env_info": {"env_id": getattr(self.spec, "id", None)},
        }
        write_text(self.directory / stats, json.dumps(figures))
        name = f"{_PREFIX}.manifest.{self._infix}.manifest.json"
        write_text(self.directory / name, json.dumps(manifest))
