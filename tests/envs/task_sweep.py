"""Every task made, reset and stepped with wrong values.

``PYTHONPATH=tests:tests/envs python tests/envs/task_sweep.py [TASK ...]`` prints what ends in
another error than Gazelle's.
"""

from __future__ import annotations

import importlib
import inspect
import re
import sys
from collections.abc import Iterator
from dataclasses import fields
from typing import Any

import gymnasium as gym
import numpy as np
import wrong_calls
from gymnasium.vector import AutoresetMode
from wrong_calls import Findings
from wrong_values import ARRAYS, shown, wrong

import gazelle.envs

ACTIONS: list[Any] = [
    *ARRAYS,
    *(None, "a", "", -1, 99, 2**70, {}, [None], np.int64(-1), np.zeros((2, 0)), np.full(2, np.nan)),
]
OF_GYMNASIUM = {"max_episode_steps"}
"""Arguments that ``gym.make`` keeps for itself."""


def options_of(entry_point: str) -> dict[str, str]:
    """Return the arguments of an environment's class with their annotations."""
    home, _, name = entry_point.partition(":")
    kind = getattr(importlib.import_module(home), name)
    found = {}
    for each in inspect.signature(kind).parameters.values():
        if each.kind is not each.VAR_KEYWORD:
            found[each.name] = wrong_calls.annotation_of(each)
            continue
        unpacked = re.match(r"Unpack\[(\w+)\]", wrong_calls.annotation_of(each))
        if unpacked:
            options = getattr(inspect.getmodule(kind), unpacked[1]).__annotations__
            found.update(
                {
                    key: getattr(value, "__forward_arg__", str(value))
                    for key, value in options.items()
                }
            )
        else:
            found.update({each.name: str(each.type) for each in fields(kind.settings_class)})
    return found


def distinct_tasks() -> list[str]:
    """Return a task of each class and options."""
    found = {}
    for task in gazelle.envs.task_ids():
        spec = gym.spec(task)
        found.setdefault(
            (spec.entry_point, str(sorted(options_of(spec.entry_point).items()))), task
        )
    return list(found.values())


def _makes(task: str) -> Iterator[tuple[str, Any, dict[str, Any]]]:
    spec = gym.spec(task)
    for entry_point, way in ((spec.entry_point, "make"), (spec.vector_entry_point, "make_vec")):
        for name, annotation in {**options_of(entry_point), "no_such": "str"}.items():
            for value in wrong(annotation.replace("AutoresetMode", "str")):
                if way == "make" and name in OF_GYMNASIUM:
                    continue
                yield f"{way}({task}, {name}={shown(value)})", value, {"way": way, name: value}


def _make(task: str, way: str = "make", **options: Any) -> Any:
    if way == "make":
        return gym.make(task, **options)
    options = {"num_envs": 2, "vectorization_mode": "vector_entry_point", **options}
    return gym.make_vec(task, **options)


def _use(task: str, options: dict[str, Any]) -> None:
    env = _make(task, **options)
    try:
        env.reset()
        env.step(env.action_space.sample())
    finally:
        env.close()


def sweep_options(task: str, findings: Findings) -> None:
    """Make a task with wrong options."""
    for what, value, options in _makes(task):
        findings.attempt(what, lambda o=options: _use(task, o), value=value)


def sweep_calls(task: str, findings: Findings) -> None:
    """Reset and step a task with wrong values."""
    for way in ("make", "make_vec"):
        for mode in (None,) if way == "make" else tuple(AutoresetMode):
            env = _make(task, way, **({} if mode is None else {"autoreset_mode": mode}))
            env.reset(seed=1)
            for value in wrong("int"):
                findings.attempt(
                    f"{way}.reset(seed={shown(value)})", lambda e=env, v=value: e.reset(seed=v)
                )
            for value in (
                {"reset_mask": ACTIONS[3]},
                {"no_such": 1},
                {"reset_mask": [True] * 9},
                {"": 0},
            ):
                findings.attempt(
                    f"{way}.reset(options={shown(value)})",
                    lambda e=env, v=value: e.reset(options=v),
                )
            for value in ACTIONS:
                findings.attempt(f"{way}.step({shown(value)})", lambda e=env, v=value: e.step(v))
            for value in (
                {},
                {"no_such": 1},
                {"elapsed": [np.nan] * 3},
                {"elapsed": [0, 0], "over": [1] * 9},
            ):
                call = env.unwrapped.set_state
                findings.attempt(f"{way}.set_state({shown(value)})", lambda c=call, v=value: c(v))
            env.reset(seed=1)
            findings.attempt(f"a step after {way}", lambda e=env: e.step(e.action_space.sample()))
            env.close()


if __name__ == "__main__":
    found = Findings()
    with wrong_calls.limits():
        for each in sys.argv[1:] or gazelle.envs.task_ids():
            print(f"== {each}", flush=True)
            sweep_options(each, found)
            sweep_calls(each, found)
    found.show(6)
