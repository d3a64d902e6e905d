"""Find a task by its name and make many copies of it."""

from __future__ import annotations

import importlib.util
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gymnasium as gym
from gymnasium.vector import VectorEnv

from gazelle.errors import TaskError, did_you_mean
from gazelle.training.recipes import task_name

NAMESPACE = "gazelle"


@dataclass(frozen=True, slots=True)
class Task:
    """One registered task."""

    name: str
    """What the user types, such as ``TurtleBot3Stage1``."""
    id: str
    """What Gymnasium knows, such as ``gazelle/TurtleBot3Stage1-v0``."""


def list_tasks() -> list[Task]:
    """Gazelle's tasks, by name."""
    _register()
    specs = [spec for spec in gym.registry.values() if spec.namespace == NAMESPACE]
    return sorted(
        (Task(name=spec.name, id=spec.id) for spec in specs), key=lambda task: (task.name, task.id)
    )


def find_task(name: str) -> str:
    """The Gymnasium id of a task.

    Args:
        name: A full id, or the name without namespace or version (then the newest).

    Raises:
        TaskError: There is no such task; the hint names the closest.
    """
    _register()
    for candidate in (name, f"{NAMESPACE}/{name}"):
        if candidate in gym.registry:
            return candidate
    bare = task_name(name)
    own = [spec for spec in gym.registry.values() if spec.name == bare]
    own.sort(key=lambda spec: (spec.namespace == NAMESPACE, spec.version or 0))
    if own and name == bare:
        return own[-1].id
    known = [task.name for task in list_tasks()] or [spec.name for spec in gym.registry.values()]
    raise TaskError(f"there is no task '{name}'", hint=did_you_mean(bare, known))


def make_task(name: str, num_envs: int, **options: Any) -> VectorEnv[Any, Any, Any]:
    """Many copies of a task as one vector environment.

    Args:
        name: See `find_task`.
        num_envs: How many copies.
        options: Options of the environment; those that are None are left out.

    Raises:
        TaskError: There is no such task, or it has no such option.
    """
    task = find_task(name)
    given = {key: value for key, value in options.items() if value is not None}
    native = gym.registry[task].vector_entry_point is not None
    mode = "vector_entry_point" if native else "sync"
    try:
        env: VectorEnv[Any, Any, Any] = gym.make_vec(
            task, num_envs=num_envs, vectorization_mode=mode, **given
        )
    except TypeError as error:
        if "unexpected keyword argument" not in str(error):
            raise
        raise TaskError(
            f"{task} does not take all of these options: {', '.join(given)}",
            hint="its docstring lists what it takes",
        ) from error
    return env


def control_period(env: VectorEnv[Any, Any, Any]) -> float | None:
    """Simulated seconds of one control step; None if the environment does not tell.

    Read from the attribute ``control_period`` [s], else from ``metadata["render_fps"]``.
    """
    period = getattr(env.unwrapped, "control_period", None)
    if period is not None:
        return float(period)
    rate = env.metadata.get("render_fps")
    return 1.0 / float(rate) if rate else None


def plain_options(options: dict[str, Any]) -> dict[str, Any]:
    """Options as values that JSON can hold: paths become absolute, those that are None go.

    Raises:
        TaskError: A value cannot be written to a run's configuration.
    """
    plain = {
        key: str(value.resolve()) if isinstance(value, Path) else value
        for key, value in options.items()
        if value is not None
    }
    for key, value in plain.items():
        try:
            json.dumps(value)
        except (TypeError, ValueError) as error:
            raise TaskError(
                f"the option {key} is a {type(value).__name__}, which no run can keep",
                hint="give numbers, text, lists or the path of a file",
            ) from error
    return plain


def _register() -> None:
    """Let Gazelle's environments register themselves."""
    if importlib.util.find_spec("gazelle.envs") is not None:
        importlib.import_module("gazelle.envs")
