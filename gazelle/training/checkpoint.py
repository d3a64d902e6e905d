"""Save and restore everything that a training run depends on.

A checkpoint is a folder:

- ``learner.pt``: weights and optimisers, read with ``weights_only=True``;
- ``state.json`` and ``state.npz``: counters, random generators, the adapter's
  and the environment's state, the replay memory; see `portable`;
- ``policy.npz``: the policy alone; see `Actor`.

A run that is continued from a checkpoint does exactly what it would have done
without the break, as long as the environment can save its state.
"""

from __future__ import annotations

import contextlib
import io
import pickle
import random
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import torch

from gazelle.bounded_npz import BROKEN
from gazelle.errors import FormatError, SimulationWarning
from gazelle.training import portable
from gazelle.training.export import export_actor
from gazelle.training.learners import Learner
from gazelle.training.state_arrays import saved_array

_COUNTERS = (
    "num_timesteps",
    "_total_timesteps",
    "_n_updates",
    "_episode_num",
    "_current_progress_remaining",
    "_n_calls",
    "exploration_rate",
    "least_reward",
    "greatest_reward",
)


def write_checkpoint(folder: Path, learner: Learner, extra: dict[str, Any]) -> None:
    """Write the state of a learner and its environment into an empty folder.

    Args:
        folder: An existing folder.
        learner: Between two rollouts; an update that runs ahead is waited for.
        extra: More to remember; see `portable.pack` for what it may hold.
    """
    # Not to the file: torch's own writer makes a RuntimeError of a full disk.
    buffer = io.BytesIO()
    torch.save(_torch_state(learner), buffer)
    (folder / "learner.pt").write_bytes(buffer.getbuffer())
    export_actor(learner.policy).save(folder / "policy.npz")
    state: dict[str, Any] = {
        "counters": {name: getattr(learner, name) for name in _COUNTERS if hasattr(learner, name)},
        "generators": _generators(learner),
        "environment": learner.env.get_state(),
        "extra": extra,
    }
    if getattr(learner, "_last_lstm_states", None) is not None:
        state["recurrent"] = [_plain(part) for part in learner._last_lstm_states]  # noqa: SLF001
    ahead = getattr(learner, "ahead", None)
    if ahead is not None:
        state["ahead"] = ahead.get_state()
    reward_scale = getattr(learner, "reward_scale", None)
    if reward_scale is not None:
        state["reward_scale"] = reward_scale.get_state()
    memory = getattr(learner, "replay_buffer", None)
    if memory is not None:
        state["memory"] = memory.get_state()
    portable.save(folder / "state", state)


def read_checkpoint(folder: Path, learner: Learner) -> dict[str, Any]:
    """Restore the state of a checkpoint in a new learner and its environment.

    If the environment cannot restore its state, its episodes start again and a
    `SimulationWarning` says so.

    Returns:
        What was given to `write_checkpoint` as ``extra``.

    Raises:
        FormatError: The checkpoint is damaged or belongs to another recipe.
    """
    state = portable.load(folder / "state")
    _set_torch_state(learner, folder / "learner.pt")
    with usable(folder):
        for name, value in state["counters"].items():
            setattr(learner, name, type(getattr(learner, name))(value))
        if "recurrent" in state:
            present = learner._last_lstm_states  # noqa: SLF001
            parts = map(_tensors, state["recurrent"], present)
            learner._last_lstm_states = type(present)(*parts)  # noqa: SLF001
        if "ahead" in state:
            learner.resume_update(state["ahead"])
        if getattr(learner, "reward_scale", None) is not None:
            learner.reward_scale.set_state(state["reward_scale"])
        if "memory" in state:
            learner.replay_buffer.set_state(state["memory"])
        _restore_environment(learner, state)
        _set_generators(learner, state["generators"])
        extra: dict[str, Any] = state["extra"]
    return extra


@contextlib.contextmanager
def usable(folder: Path) -> Iterator[None]:
    """Raise an error if a checkpoint's state does not fit its target in the block.

    Raises:
        FormatError: It does not.
    """
    try:
        yield
    except (ArithmeticError, AttributeError, LookupError, ValueError, TypeError) as error:
        hint = "it is damaged, or was written by another version"
        raise FormatError(
            f"cannot use the checkpoint: {error}", file=str(folder), hint=hint
        ) from error


def _plain(part: tuple[torch.Tensor, ...]) -> list[Any]:
    return [tensor.numpy() for tensor in part]


def _tensors(part: list[Any], present: tuple[torch.Tensor, ...]) -> tuple[torch.Tensor, ...]:
    """Return saved tensors in place of the present ones."""
    saved = dict(enumerate(part))
    return tuple(
        torch.as_tensor(saved_array(saved, place, tensor.numpy()))
        for place, tensor in enumerate(present)
    )


def _restore_environment(learner: Learner, state: dict[str, Any]) -> None:
    env = learner.env
    if state["environment"] is None:
        warnings.warn(
            "this environment cannot save its state: its episodes start again, "
            "so the resumed run is not bit for bit equal to an uninterrupted one",
            SimulationWarning,
            stacklevel=2,
        )
        env.reset()
    else:
        env.set_state(state["environment"])
    # SB3 has no public names for what it acts on next.
    learner._last_obs, learner._last_episode_starts = env.obs, env.starts  # noqa: SLF001


def _generators(learner: Learner) -> dict[str, Any]:
    """Return the state of every random generator that training uses."""
    state: dict[str, Any] = {
        "python": random.getstate(),
        "numpy": np.random.get_state(),  # noqa: NPY002  # SB3 draws from the global one
        "torch": torch.get_rng_state().numpy(),
        "actions": learner.action_space.np_random.bit_generator.state,
    }
    if hasattr(learner, "action_rng"):
        state["sampling"] = learner.action_rng.bit_generator.state
        state["batches"] = learner.rollout_buffer.rng.bit_generator.state
    return state


def _set_generators(learner: Learner, state: dict[str, Any]) -> None:
    random.setstate(state["python"])
    np.random.set_state(state["numpy"])  # noqa: NPY002
    torch.set_rng_state(torch.as_tensor(state["torch"]))
    learner.action_space.np_random.bit_generator.state = state["actions"]
    if hasattr(learner, "action_rng"):
        learner.action_rng.bit_generator.state = state["sampling"]
        learner.rollout_buffer.rng.bit_generator.state = state["batches"]


def _torch_state(learner: Learner) -> dict[str, Any]:
    modules, tensors = learner._get_torch_save_params()  # noqa: SLF001  # SB3's own list
    return {
        "modules": {name: _attribute(learner, name).state_dict() for name in modules},
        "tensors": {name: _attribute(learner, name).detach() for name in tensors},
    }


def _set_torch_state(learner: Learner, file: Path) -> None:
    try:
        state = torch.load(file, weights_only=True, map_location="cpu")
        for name, values in state["modules"].items():
            _attribute(learner, name).load_state_dict(values)
        for name, tensor in state["tensors"].items():
            _attribute(learner, name).data.copy_(tensor)
    except (pickle.UnpicklingError, *BROKEN) as error:
        hint = "it is damaged, or belongs to another recipe"
        # What torch says of an unpickling error advises to load the file without this protection.
        unsafe = isinstance(error, pickle.UnpicklingError)
        reason = "they hold more than numbers" if unsafe else (str(error) or "it is cut off")
        reason = reason.splitlines()[0]
        raise FormatError(
            f"cannot use these weights: {reason}", file=str(file), hint=hint
        ) from error


def _attribute(learner: Learner, path: str) -> Any:
    """Return the attribute of a path: ``policy.optimizer`` is the optimiser of the policy."""
    value = learner
    for name in path.split("."):
        value = getattr(value, name)
    return value
