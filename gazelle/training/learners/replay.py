"""A replay memory that forgets the steps an environment spent on its reset."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from stable_baselines3.common.buffers import ReplayBuffer
from stable_baselines3.common.type_aliases import ReplayBufferSamples


class MaskedReplayBuffer(ReplayBuffer):  # type: ignore[misc]  # untyped base
    """Stable-Baselines3's replay buffer, drawing from the valid transitions only.

    Args:
        args: As Stable-Baselines3's ``ReplayBuffer`` takes them.
        n_steps: Control steps of a transition; fewer where its episode ends, or was played no further.
        gamma: Discount of one of them, if there are several.
        kwargs: As there.
    """

    def __init__(self, *args: Any, n_steps: int = 1, gamma: float = 1.0, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.n_steps, self.gamma = n_steps, gamma
        self.valid = np.ones((self.buffer_size, self.n_envs), dtype=np.bool_)
        self.steps = 0  # control steps, overwritten ones too

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
        self.steps += 1
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
        first, last = max(self.steps - self.buffer_size, 0), min(rows, self.steps)
        if first >= last:
            return None
        drawn = np.random.randint(first, last, size=batch_size)  # noqa: NPY002  # as the parent draws
        at = drawn % self.buffer_size
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
        return state | {"pos": self.pos, "full": self.full, "steps": self.steps}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a memory that `get_state` returned."""
        for name in self._names():
            getattr(self, name)[: len(state[name])] = state[name]
        self.pos, self.full = int(state["pos"]), bool(state["full"])
        self.steps = int(state.get("steps", self.pos + self.full * self.buffer_size))

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
        return self._transitions(rows, slots, lambda at: self.rewards[at, slots])

    def _transitions(
        self,
        rows: npt.NDArray[np.intp],
        slots: npt.NDArray[np.intp],
        rewards_at: Callable[[npt.NDArray[np.intp]], npt.NDArray[np.float32]],
    ) -> dict[str, npt.NDArray[Any]]:
        """Return the same, with rewards as `_summed` takes them."""
        last, following = self._summed(rows, slots, rewards_at)
        cut_off = self.timeouts[last, slots]
        return {
            "observations": self.observations[rows, slots],
            "actions": self.actions[rows, slots],
            "next_observations": self.next_observations[last, slots],
            "dones": (self.dones[last, slots] * (1.0 - cut_off))[:, None],
            **following,
        }

    def _summed(
        self,
        rows: npt.NDArray[np.intp],
        slots: npt.NDArray[np.intp],
        rewards_at: Callable[[npt.NDArray[np.intp]], npt.NDArray[np.float32]],
    ) -> tuple[npt.NDArray[np.intp], dict[str, npt.NDArray[np.float32]]]:
        """Return the last rows of transitions, with their rewards and, of several steps, discounts.

        Args:
            rows: Their first rows, shape (n,).
            slots: Their copies.
            rewards_at: Returns the rewards of the steps at given rows, shape (n,).
        """
        last, rewards = rows, rewards_at(rows)
        discounts = np.full(len(rows), self.gamma, np.float32)
        for _ in range(self.n_steps - 1):
            after = (last + 1) % self.buffer_size
            goes_on = (self.dones[last, slots] == 0.0) & (after != self.pos)
            last = np.where(goes_on, after, last)
            rewards = rewards + goes_on * discounts * rewards_at(last)
            discounts = np.where(goes_on, discounts * np.float32(self.gamma), discounts)
        several = {"discounts": discounts[:, None]} if self.n_steps > 1 else {}
        return last, {"rewards": rewards[:, None], **several}


def targets(batch: Any, values: torch.Tensor, gamma: float) -> torch.Tensor:
    """Return what a transition is worth, shape (n, 1), by the values of what follows it.

    Args:
        batch: A sample of a memory.
        values: Shape (n, 1).
        gamma: Discount of one control step.
    """
    discounts = gamma if batch.discounts is None else batch.discounts
    worth: torch.Tensor = batch.rewards + (1.0 - batch.dones) * discounts * values
    return worth
