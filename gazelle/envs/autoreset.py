"""When a vector environment begins the next episode after one ended."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import ArrayLike, NDArray

from gazelle.envs.options import check_name
from gazelle.envs.row_checks import action_array
from gazelle.errors import TaskError


def autoreset_mode(mode: AutoresetMode | str) -> AutoresetMode:
    """Return the mode of that name: ``NextStep``, ``SameStep`` or ``Disabled``.

    Raises:
        TaskError: There is no such mode.
    """
    if isinstance(mode, AutoresetMode):
        return mode
    names = {each.value: each for each in AutoresetMode}
    if not isinstance(mode, str):
        raise TaskError(f"autoreset_mode must be one of {', '.join(names)}, not {mode!r}")
    check_name("autoreset mode", mode, names)
    return names[mode]


def with_idle(actions: ArrayLike, space: gym.Space[Any], over: NDArray[np.intp]) -> ArrayLike:
    """Return actions with a valid one for worlds that start a new episode instead.

    Args:
        actions: Shape (nworld, ...); what has another shape is left to the task to refuse.
        space: Of the actions of one world.
        over: The worlds with an ignored action, shape (n,).
    """
    rows = action_array(actions)
    if rows.ndim == 0 or len(rows) <= over.max(initial=-1):
        return actions
    if isinstance(space, gym.spaces.Discrete):
        idle: Any = space.start
    elif isinstance(space, gym.spaces.Box):
        idle = np.clip(0.0, space.low, space.high)
    else:
        return actions
    changed = rows.copy()
    changed[over] = idle
    return changed
