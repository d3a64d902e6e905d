"""Find a task by its name and make many copies of it."""

from __future__ import annotations

import importlib.util
import inspect
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gymnasium as gym
from gymnasium.envs.registration import load_env_creator
from gymnasium.vector import VectorEnv

from gazelle.errors import TaskError, did_you_mean
from gazelle.training.importing import load_all, load_entry_points
from gazelle.training.recipes import task_name

NAMESPACE = "gazelle"
_SENTENCE_END = re.compile(r"(?<=\.)\s")

_others: set[str] = set()
"""Ids that entry points registered."""


@dataclass(frozen=True, slots=True)
class Task:
    """One registered task."""

    name: str
    """Name as typed by the user, such as ``TurtleBot3Stage1``."""
    id: str
    """Gymnasium's id, such as ``gazelle/TurtleBot3Stage1-v0``."""


def list_tasks() -> list[Task]:
    """Return Gazelle's tasks and those of installed packages' entry points, by name."""
    _register()
    _register_others()
    specs = [
        spec for spec in gym.registry.values() if spec.namespace == NAMESPACE or spec.id in _others
    ]
    return sorted(
        (Task(name=spec.name, id=spec.id) for spec in specs), key=lambda task: (task.name, task.id)
    )


def find_task(name: str) -> str:
    """Return the Gymnasium id of a task.

    Args:
        name: A full id, or the name without namespace or version (then the newest). Of a task
            that is registered when a module is imported: ``module:id``.

    Raises:
        TaskError: There is no such task; the hint names the closest.
    """
    module, bare_id = split_module(name)
    if module is not None:
        load_all([module])
    for register in (_register, _register_others):
        register()
        found = _registered(bare_id)
        if found is not None:
            return found
    raise TaskError(f"there is no task '{bare_id}'", hint=_hint(bare_id))


def describe_task(task: str) -> str:
    """Return a sentence about a task: of one from elsewhere, its environment's first sentence.

    Args:
        task: See `find_task`.

    Raises:
        TaskError: There is no such task.
    """
    from gazelle.envs.descriptions import DESCRIPTIONS

    spec = gym.registry[find_task(task)]
    if spec.namespace == NAMESPACE and spec.name in DESCRIPTIONS:
        return DESCRIPTIONS[spec.name]
    text = inspect.getdoc(entry_class(task, vector=False)) or ""
    lines = [line for line in text.splitlines() if not line.startswith("#")]  # no headings
    paragraph = "\n".join(lines).strip().partition("\n\n")[0]
    return _SENTENCE_END.split(" ".join(paragraph.split()), maxsplit=1)[0]


def with_continuous_actions(task: str) -> str:
    """Return a task's twin with continuous actions (``NAMEContinuous``); the task if it has none.

    Args:
        task: A registered id.
    """
    spec = gym.registry[task]
    twins = [
        other.id
        for other in gym.registry.values()
        if (other.namespace, other.name, other.version)
        == (spec.namespace, f"{spec.name}Continuous", spec.version)
    ]
    return twins[0] if twins else task


def split_module(name: str) -> tuple[str | None, str]:
    """Split ``module:id``; the module is None if missing."""
    module, colon, rest = name.rpartition(":")
    return (module, rest) if colon else (None, name)


def _registered(name: str) -> str | None:
    """Return the id of a task that is registered by now."""
    for candidate in (name, f"{NAMESPACE}/{name}"):
        if candidate in gym.registry:
            return candidate
    bare = task_name(name)
    own = [spec for spec in gym.registry.values() if spec.name == bare]
    own.sort(key=lambda spec: (spec.namespace == NAMESPACE, spec.version or 0))
    return own[-1].id if own and name == bare else None


def _hint(name: str) -> str:
    """Return the closest id, or name, of those of the same form; else where one's own is found."""
    specs = gym.registry.values()
    if "/" in name:
        known = [spec.id for spec in specs if spec.namespace]
    else:
        bare = task_name(name) == name
        known = [spec.name if bare else spec.id for spec in specs]
    hint = did_you_mean(name, known)
    if hint.startswith("did you mean"):
        return hint
    return (
        "'gazelle tasks' lists those there are; one of your own is found with "
        "--import MODULE, or as MODULE:ID"
    )


def entry_class(task: str, *, vector: bool) -> object:
    """Return the entry point of a task's environments, usually a class; None if it has none.

    For `gazelle.envs.register_task` it is the class of the task.
    """
    spec = gym.registry[find_task(task)]
    entry = spec.vector_entry_point if vector else spec.entry_point
    entry = load_env_creator(entry) if isinstance(entry, str) else entry
    return getattr(entry, "registered_task", entry)


def evaluation_options(task: str, trained: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options with which a task wants its policies to be evaluated.

    A task says so by a class method or static method ``evaluation_options`` of its environment
    or of its registered class:
    it takes the options that a policy was trained with and returns those that differ, such
    as starts and goals that it was not trained on.
    """
    options = _hook(task, "evaluation_options")
    return {} if options is None else dict(options(trained))


def fitting_copies(task: str, least: int, options: Mapping[str, Any]) -> int:
    """Return the number of copies to make for at least `least` wanted ones.

    A task that cannot be made in any number has a class method or static method
    ``fitting_num_envs`` of its vector environment, which takes a number and options.
    """
    fitting = _hook(task, "fitting_num_envs")
    return least if fitting is None else int(fitting(least, options))


def _hook(task: str, name: str) -> Any:
    for vector in (True, False):
        found = getattr(entry_class(task, vector=vector), name, None)
        if found is not None:
            return found
    return None


def make_task(name: str, num_envs: int, **options: Any) -> VectorEnv[Any, Any, Any]:
    """Create many copies of a task as one vector environment.

    Args:
        name: See `find_task`.
        num_envs: Number of copies.
        options: Options of the environment; those that are None are left out.

    Raises:
        TaskError: There is no such task, or it has no such option.
    """
    task = find_task(name)
    chosen = {key: value for key, value in options.items() if value is not None}
    native = gym.registry[task].vector_entry_point is not None
    mode = "vector_entry_point" if native else "sync"
    try:
        env: VectorEnv[Any, Any, Any] = gym.make_vec(
            task, num_envs=num_envs, vectorization_mode=mode, **chosen
        )
    except TypeError as error:
        if "unexpected keyword argument" not in str(error):
            raise
        raise TaskError(
            f"{task} does not take all of these options: {', '.join(chosen)}",
            hint="its docstring lists what it takes",
        ) from error
    return env


def control_period(env: VectorEnv[Any, Any, Any]) -> float | None:
    """Return simulated seconds of one control step; None if unknown.

    Read from the attribute ``control_period`` [s], else from ``metadata["render_fps"]``.
    """
    period = getattr(env.unwrapped, "control_period", None)
    if period is not None:
        return float(period)
    rate = env.metadata.get("render_fps")
    return 1.0 / float(rate) if rate else None


def env_attribute(env: VectorEnv[Any, Any, Any], name: str) -> Any:
    """Return an attribute of the environment below all wrappers, or of its copies.

    None if missing.
    """
    for each in (env.unwrapped, *getattr(env.unwrapped, "envs", ())[:1]):
        found = getattr(each.unwrapped, name, None)
        if found is not None:
            return found
    return None


def step_limit(env: VectorEnv[Any, Any, Any]) -> int | None:
    """Return the control steps after which an episode is truncated; None if unknown.

    Read from ``task.max_episode_steps`` of Gazelle's environments, else from the specification of the copies.
    """
    task = env_attribute(env, "task")
    limit = getattr(task, "max_episode_steps", None)
    if limit is None:
        spec = next((each.spec for each in getattr(env.unwrapped, "envs", [])), None)
        limit = None if spec is None else spec.max_episode_steps
    return None if limit is None else int(limit)


def plain_options(options: dict[str, Any]) -> dict[str, Any]:
    """Return options as values for JSON: absolute paths, without those that are None.

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
        except (TypeError, ValueError, OverflowError) as error:
            raise TaskError(
                f"the option {key} is a {type(value).__name__}, which no run can keep",
                hint="give numbers, text, lists or the path of a file",
            ) from error
    return plain


def _register() -> None:
    """Register Gazelle's environments."""
    if importlib.util.find_spec("gazelle.envs") is not None:
        importlib.import_module("gazelle.envs")


def _register_others() -> None:
    """Register the environments of installed packages."""
    before = set(gym.registry)
    load_entry_points()
    _others.update(set(gym.registry) - before)
