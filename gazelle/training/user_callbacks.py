"""Callbacks of the user's own, by name."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from types import ModuleType
from typing import Any

from stable_baselines3.common.callbacks import BaseCallback

from gazelle.errors import TaskError, did_you_mean
from gazelle.training.importing import TaskModule, load_all


def find_callbacks(texts: Iterable[str]) -> tuple[tuple[TaskModule, ...], tuple[str, ...]]:
    """Find callbacks: their modules, and their names as a run stores them.

    Args:
        texts: Each ``module:Class``, or ``file.py:Class``.

    Raises:
        TaskError: One is of another form, or is not there.
    """
    modules, names = [], []
    for text in texts:
        module, colon, name = text.rpartition(":")
        if not colon:
            raise TaskError(f"'{text}' is not a callback", hint="expected module:Class")
        (found,) = load_all([module])
        modules.append(found)
        names.append(f"{found.name}:{name}")
    make_callbacks(names)
    return tuple(modules), tuple(names)


def make_callbacks(names: Iterable[str]) -> list[Any]:
    """Create callbacks; their modules were found before.

    Raises:
        TaskError: One is not there, is not a callback, or cannot be created without arguments.
    """
    made = []
    for text in names:
        module, _, name = text.rpartition(":")
        home = _imported(module, text)
        kind = getattr(home, name, None)
        if kind is None:
            hint = did_you_mean(name, [each for each in vars(home) if not each.startswith("_")])
            raise TaskError(f"{module} has no callback '{name}'", hint=hint)
        if not (isinstance(kind, type) and issubclass(kind, BaseCallback)):
            raise TaskError(
                f"{text} is not a callback",
                hint="derive it from stable_baselines3.common.callbacks.BaseCallback",
            )
        try:
            made.append(kind())
        except Exception as error:  # code of the user's
            raise TaskError(f"cannot create the callback '{text}': {error}") from error
    return made


def _imported(module: str, text: str) -> ModuleType:
    """Return the module of a callback.

    Raises:
        TaskError: It cannot be imported.
    """
    try:
        return importlib.import_module(module)
    except Exception as error:  # of the module's own, too; ValueError: there is no name
        reason = f"cannot import the callback '{text}': {error}"
        raise TaskError(reason, hint="expected module:Class") from error
