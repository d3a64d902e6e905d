"""A replay memory that forgets the steps an environment spent on its reset."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from stable_baselines3.common.buffers import ReplayBuffer
from stable_baselines3.common.type_aliases import ReplayBufferSamples


class MaskedReplayBuffer(ReplayBuffer):  # type: ignore[misc]  # untyped base
    """Stable-Baselines3's replay buffer, drawing from the valid transitions only."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.valid = np.ones((self.buffer_size, self.n_envs), dtype=np.bool_)

    def add(
        self,
        obs: npt.NDArray[Any],
        next_obs: npt.NDArray[Any],
        action: npt.NDArray[Any],
        reward: npt.NDArray[Any],
        done: npt.NDArray[Any],
        infos: list[dict[str, Any]],
    ) -> None:
        """Add one control step of all copies."""
        self.valid[self.pos] = [not info.get("reset_step", False) for info in infos]
        super().add(obs, next_obs, action, reward, done, infos)

    def sample(self, batch_size: int, env: Any = None) -> Any:
        """Sample transitions uniformly from the valid ones."""
        del env
        return self._gather(*self._draw(batch_size))

    def sample_first(self, batch_size: int, rows: int) -> Any:
        """Sample transitions of the first control steps, with their own goals.

        Args:
            batch_size: Number of samples.
            rows: Number of control steps of all copies that count as the first.

        Returns:
            Fewer where some are not valid; None where no such step is in the memory any more, or
            none that was drawn is valid.
        """
        first, last = (self.pos, rows) if self.full else (0, min(rows, self.pos))
        if first >= last:
            return None
        at = np.random.randint(first, last, size=batch_size)  # noqa: NPY002  # as the parent draws
        slots = np.random.randint(0, self.n_envs, size=batch_size)  # noqa: NPY002
        kept = self.valid[at, slots]
        if not kept.any():
            return None
        parts = MaskedReplayBuffer._parts(self, at[kept], slots[kept])
        return ReplayBufferSamples(**{name: self.to_torch(part) for name, part in parts.items()})

    def _draw(self, count: int) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
        """Return rows and slots of a given number of valid transitions."""
        filled = self.buffer_size if self.full else self.pos
        rows = np.random.randint(0, filled, size=count)  # noqa: NPY002  # as the parent draws
        slots = np.random.randint(0, self.n_envs, size=count)  # noqa: NPY002
        bad = np.flatnonzero(~self.valid[rows, slots])
        while len(bad):
            rows[bad] = np.random.randint(0, filled, size=len(bad))  # noqa: NPY002
            slots[bad] = np.random.randint(0, self.n_envs, size=len(bad))  # noqa: NPY002
            bad = bad[~self.valid[rows[bad], slots[bad]]]
        return rows, slots

    def get_state(self) -> dict[str, Any]:
        """Return the memory as arrays, only as far as it is filled."""
        filled = self.buffer_size if self.full else self.pos
        state: dict[str, Any] = {name: getattr(self, name)[:filled] for name in self._names()}
        return state | {"pos": self.pos, "full": self.full}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a memory that `get_state` returned."""
        for name in self._names():
            getattr(self, name)[: len(state[name])] = state[name]
        self.pos, self.full = int(state["pos"]), bool(state["full"])

    def _names(self) -> list[str]:
        names = ["observations", "next_observations", "actions", "rewards", "dones", "timeouts"]
        return [*names, "valid"]

    def _gather(self, rows: npt.NDArray[np.intp], slots: npt.NDArray[np.intp]) -> Any:
        """Return the transitions at the given rows and slots, as tensors."""
        parts = self._parts(rows, slots)
        return ReplayBufferSamples(**{name: self.to_torch(part) for name, part in parts.items()})

    def _parts(
        self, rows: npt.NDArray[np.intp], slots: npt.NDArray[np.intp]
    ) -> dict[str, npt.NDArray[Any]]:
        """Return the transitions at the given rows and slots, arrays of their own."""
        cut_off = self.timeouts[rows, slots]
        return {
            "observations": self.observations[rows, slots],
            "actions": self.actions[rows, slots],
            "next_observations": self.next_observations[rows, slots],
            "dones": (self.dones[rows, slots] * (1.0 - cut_off))[:, None],
            "rewards": self.rewards[rows, slots][:, None],
        }
