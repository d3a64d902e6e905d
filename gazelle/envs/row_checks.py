"""Checks of what a task is given and returns: arrays with a row a world."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.errors import TaskError

_NUMBERS = "biuf"


def action_array(actions: Any) -> NDArray[Any]:
    """Return actions as an array of numbers; their shape is for the task to check.

    Raises:
        TaskError: They are not numbers, or in rows of different lengths.
    """
    if type(actions) is np.ndarray and actions.dtype.kind in _NUMBERS:
        return actions
    try:
        rows = np.asarray(actions)
    except ValueError:  # the rows are not alike
        rows = np.asarray(None)
    if rows.dtype.kind not in _NUMBERS:
        raise TaskError(f"actions must be an array of numbers, not {actions!r:.60}")
    return rows


def checked_reward(values: Any, count: int) -> Floats:
    """Return rewards as float64, shape (count,).

    Raises:
        TaskError: They have another shape, or one is not finite.
    """
    reward = _checked(
        "reward", values, (count,), f"one number a world, such as np.zeros({count})", _NUMBERS
    )
    # One pass finds that all are finite; squares of very large ones are not.
    if not math.isfinite(reward.dot(reward)) and np.count_nonzero(np.isfinite(reward)) < count:
        where = int(np.flatnonzero(~np.isfinite(reward))[0])
        raise TaskError(f"the reward of world {where} is {reward[where]}; rewards must be finite")
    return reward if reward.dtype == np.float64 else reward.astype(np.float64)


def checked_ends(name: str, values: Any, count: int) -> Bools:
    """Return where episodes end, shape (count,).

    Raises:
        TaskError: They have another shape, or are no bools.
    """
    return _checked(
        name, values, (count,), f"one bool a world, such as np.zeros({count}, bool)", "b"
    )


def checked_observation(values: Any, count: int, shape: tuple[int, ...]) -> NDArray[Any]:
    """Return observations, shape (count, ...) as the space says.

    Raises:
        TaskError: They have another shape.
    """
    hint = "a row a world, an entry for each bound of observation_space"
    return _checked("observation", values, (count, *shape), hint, _NUMBERS)


def checked_info(info: dict[str, Any], count: int) -> dict[str, NDArray[Any]]:
    """Return info as arrays, shape (count, ...).

    Raises:
        TaskError: A value is not a number or array of numbers for each world.
    """
    checked = dict(info)
    for name, values in info.items():
        known = type(values) is np.ndarray and values.ndim and len(values) == count
        if not known or values.dtype.kind not in _NUMBERS:
            hint = f"a row a world; for one value in all of them np.full({count}, value)"
            checked[name] = _checked(f"info['{name}']", values, (count, ...), hint, _NUMBERS)
    return checked


def _checked(name: str, values: Any, shape: tuple[Any, ...], hint: str, kinds: str) -> NDArray[Any]:
    """Return values as an array of a shape, in which ``...`` stands for any more axes."""
    if type(values) is np.ndarray and values.shape == shape and values.dtype.kind in kinds:
        return values
    try:
        rows = np.asarray(values)
    except ValueError:
        raise TaskError(f"{name} has rows of different lengths", hint=hint) from None
    leading = shape[:-1] if shape[-1:] == (...,) else shape
    fits = rows.shape[: len(leading)] == leading
    if not fits or (leading is shape and rows.ndim != len(shape)):
        expected = f"({', '.join('...' if side is ... else str(side) for side in shape)}"
        expected += ",)" if len(shape) == 1 else ")"
        raise TaskError(f"{name} has shape {rows.shape}, expected {expected}", hint=hint)
    if rows.dtype.kind not in kinds:
        what = "bools" if kinds == "b" else "numbers"
        raise TaskError(f"{name} is of {rows.dtype}, expected {what}", hint=hint)
    return rows
