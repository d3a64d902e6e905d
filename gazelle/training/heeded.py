"""Table of recipe values and the algorithms that use them.

A value that changes nothing is an error and not a comment, so it is said here, once, which
algorithms read it; a test compares this with what they read.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any, ClassVar, Protocol, TypeVar

from gazelle.errors import TaskError


class RecipeValues(Protocol):
    """A dataclass with values of a recipe."""

    __dataclass_fields__: ClassVar[dict[str, Any]]


Held = TypeVar("Held", bound=RecipeValues)

_NOISY = ("td3", "ddpg")
_EXPLORING = ("dqn",)
_REMEMBERING = ("dqn", "sac", "td3", "ddpg", "tqc", "qrdqn")

SOME_HEED: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("hindsight", "hindsight_redraw"), _REMEMBERING),
    **dict.fromkeys(
        (
            "action_noise",
            "random_actions",
            "action_penalty",
            "bound_values",
            "demonstrator",
            "imitation",
        ),
        _NOISY,
    ),
    "bfloat16": ("ppo", "sac", *_NOISY),
    "policy_delay": ("sac", *_NOISY),
    "initial_entropy_weight": ("sac",),
    **dict.fromkeys(
        ("exploration_fraction", "exploration_final", "target_update_interval"), _EXPLORING
    ),
}
"""Of a `Recipe` or of `OffPolicySettings`, values that not all its algorithms support."""


def heeds(algo: str, name: str) -> bool:
    """Return whether an algorithm uses a value that such a recipe has."""
    return algo in SOME_HEED.get(name, (algo,))


def check_heeded(algo: str, holder: RecipeValues) -> None:
    """Check for settings that an algorithm does not support and that are not the defaults.

    Args:
        algo: Name of the algorithm.
        holder: A `Recipe`, or `OffPolicySettings`.

    Raises:
        TaskError: There is one.
    """
    for name in _unheeded(algo, holder):
        raise unheeded_error(algo, name, SOME_HEED[name])


def heeded_only(algo: str, holder: Held) -> Held:
    """Return the settings with the default for each value that an algorithm does not support."""
    return dataclasses.replace(holder, **_unheeded(algo, holder))


def unheeded_error(algo: str, name: str, others: Iterable[str]) -> TaskError:
    """Return the error for a value that only other algorithms use."""
    hint = f"leave it out; {', '.join(others)} would take notice"
    return TaskError(f"{algo} takes no notice of '{name}'", hint=hint)


def _unheeded(algo: str, holder: RecipeValues) -> dict[str, Any]:
    """Return the defaults of changed values that the algorithm ignores, by name."""
    return {
        each.name: each.default
        for each in dataclasses.fields(holder)
        if not heeds(algo, each.name) and getattr(holder, each.name) != each.default
    }
