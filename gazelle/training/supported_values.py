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

PARTIAL_SUPPORT: dict[str, tuple[str, ...]] = {
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
        (
            "exploration_fraction",
            "exploration_final",
            "target_update_interval",
            "double_q",
        ),
        _EXPLORING,
    ),
}
"""Of a `Recipe` or of `OffPolicySettings`, values that not all its algorithms support."""


def supports(algo: str, name: str) -> bool:
    """Return whether an algorithm uses a value that such a recipe has."""
    return algo in PARTIAL_SUPPORT.get(name, (algo,))


def check_supported(algo: str, holder: RecipeValues) -> None:
    """Check for settings that an algorithm does not support and that are not the defaults.

    Args:
        algo: Name of the algorithm.
        holder: A `Recipe`, or `OffPolicySettings`.

    Raises:
        TaskError: There is one.
    """
    for name in _unsupported(algo, holder):
        raise unsupported_error(algo, name, PARTIAL_SUPPORT[name])


def supported_only(algo: str, holder: Held) -> Held:
    """Return the settings with the default for each value that an algorithm does not support."""
    return dataclasses.replace(holder, **_unsupported(algo, holder))


def unsupported_error(algo: str, name: str, others: Iterable[str]) -> TaskError:
    """Return the error for a value that only other algorithms use."""
    hint = f"leave it out; {', '.join(others)} support it"
    return TaskError(f"{algo} does not support '{name}'", hint=hint)


def _unsupported(algo: str, holder: RecipeValues) -> dict[str, Any]:
    """Return the defaults of changed values that the algorithm ignores, by name."""
    return {
        each.name: each.default
        for each in dataclasses.fields(holder)
        if not supports(algo, each.name) and getattr(holder, each.name) != each.default
    }
