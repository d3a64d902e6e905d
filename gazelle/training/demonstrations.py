"""Demonstrations: a function that acts before the first update; the learner imitates its steps.

A. Nair et al., "Overcoming Exploration in Reinforcement Learning with Demonstrations", 2018, arXiv
1709.10089: demonstrations are in the memory, the policy is drawn towards their actions, and only
where the critic holds these for better than its own.
"""

from __future__ import annotations

import dataclasses
import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats32
from gazelle.errors import TaskError, did_you_mean
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.recipe import OffPolicySettings, Recipe

Demonstrator = Callable[[Floats32], NDArray[Any]]
"""Takes observations in rows, shape (n, entries), and gives actions of the task, (n, ...)."""


def find_demonstrator(text: str) -> Demonstrator:
    """Return a demonstrator by its name.

    Args:
        text: ``module:function``, or ``file.py:function``.

    Raises:
        TaskError: It is of another form, or is not there.
    """
    found, name = _parted(text)
    home = importlib.import_module(found.name)
    function: Demonstrator | None = getattr(home, name, None)
    if not callable(function):
        hint = did_you_mean(name, [each for each in vars(home) if not each.startswith("_")])
        raise TaskError(f"{found.name} has no function '{name}'", hint=hint)
    return function


def with_demonstrator_found(recipe: Recipe) -> tuple[Recipe, tuple[TaskModule, ...]]:
    """Return the recipe as a run remembers it, and where its demonstrator is, if it has one.

    Raises:
        TaskError: See `find_demonstrator`.
    """
    settings = recipe.settings
    if not isinstance(settings, OffPolicySettings) or settings.demonstrator is None:
        return recipe, ()
    find_demonstrator(settings.demonstrator)
    found, name = _parted(settings.demonstrator)
    settings = dataclasses.replace(settings, demonstrator=f"{found.name}:{name}")
    own = found.folder is None or found.name.startswith("gazelle.")
    return dataclasses.replace(recipe, settings=settings), () if own else (found,)


def _parted(text: str) -> tuple[TaskModule, str]:
    """Return the module, imported, and the name in it."""
    module, colon, name = text.rpartition(":")
    if not colon:
        raise TaskError(f"'{text}' is not a demonstrator", hint="expected module:function")
    (found,) = load_all([module])
    return found, name


def shown_actions(
    demonstrator: Demonstrator, rows: Floats32, shape: tuple[int, ...]
) -> NDArray[np.float32]:
    """Return actions of a demonstrator.

    Raises:
        TaskError: They are not of this shape, or not finite.
    """
    actions = np.asarray(demonstrator(rows), np.float32)
    if actions.shape != shape or not np.isfinite(actions).all():
        raise TaskError(
            f"the demonstrator returned an array of shape {actions.shape}, not finite ones of {shape}",
            hint="it must return one row of actions per row of observations",
        )
    return actions
