"""Environments by name: ``register`` and ``make``."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import gymnasium

from gazelle.drop_in.gym.adapted import OldInterface
from gazelle.drop_in.gym.core import Env
from gazelle.drop_in.gym.error import Error, UnregisteredEnv
from gazelle.drop_in.gym.wrappers.time_limit import TimeLimit
from gazelle.errors import did_you_mean

env_id_re = re.compile(r"^(?:[\w:-]+/)?([\w:.-]+)-v(\d+)$")
EntryPoint = str | Callable[..., Any]


@dataclass
class EnvSpec:
    """Registration of an environment.

    Attributes:
        id: Its name, which ends in ``-v`` and a number.
        entry_point: The class, or ``module:class``, where dots may lead into the module.
        reward_threshold: The reward at which the task counts as solved.
        nondeterministic: Whether equal seeds may give different episodes.
        max_episode_steps: After which an episode is cut; None for never.
        kwargs: Given to the class.
        tags: Notes of the user.
    """

    id: str
    entry_point: EntryPoint | None = None
    reward_threshold: float | None = None
    nondeterministic: bool = False
    max_episode_steps: int | None = None
    kwargs: Mapping[str, Any] = field(default_factory=dict)
    tags: Mapping[str, Any] = field(default_factory=dict)

    @property
    def timestep_limit(self) -> int | None:
        """Step limit, under its name before gym 0.10."""
        return self.max_episode_steps

    def make(self, **options: Any) -> Env:
        """Create the environment.

        Args:
            options: For its class, beside the registered ones.

        Raises:
            Error: It has no entry point any more.
        """
        if self.entry_point is None:
            raise Error(f"'{self.id}' has no entry point")
        made = load(self.entry_point)(**{**self.kwargs, **options})
        env: Env = OldInterface(made) if isinstance(made, gymnasium.Env) else made
        env.unwrapped.spec = self
        if self.max_episode_steps is None:
            return env
        return TimeLimit(env, max_episode_steps=self.max_episode_steps)


class EnvRegistry:
    """The environments that can be made, by name."""

    def __init__(self) -> None:
        self.env_specs: dict[str, EnvSpec] = {}

    def register(self, id: str, **options: Any) -> None:  # noqa: A002  # gym's name for it
        """Register an environment; one with the same id is replaced.

        Args:
            id: Its name.
            options: Fields of `EnvSpec`; ``timestep_limit`` is ``max_episode_steps``.

        Raises:
            Error: The name does not end in ``-v`` and a number.
        """
        if env_id_re.fullmatch(id) is None:
            raise Error(f"'{id}' is no name of an environment: they end in -v0, -v1 ...")
        limit = options.pop("timestep_limit", None)
        if options.get("max_episode_steps") is None:
            options["max_episode_steps"] = limit
        self.env_specs[id] = EnvSpec(id, **options)

    def spec(self, path: str) -> EnvSpec:
        """Return what is registered under a name, here or with Gymnasium.

        Args:
            path: The name, or ``module:name`` to import the module first.

        Raises:
            UnregisteredEnv: Nothing is.
        """
        module, colon, name = path.rpartition(":")
        if colon:
            importlib.import_module(module)
        if name not in self.env_specs and name in gymnasium.registry:
            return _as_old(gymnasium.registry[name])
        if name not in self.env_specs:
            hint = did_you_mean(name, [*self.env_specs, *gymnasium.registry])
            raise UnregisteredEnv(f"no environment '{name}' is registered; {hint}")
        return self.env_specs[name]

    def make(self, path: str, **options: Any) -> Env:
        """Create an environment; Gymnasium's are found too.

        Raises:
            UnregisteredEnv: There is none of that name.
        """
        return self.spec(path).make(**options)

    def all(self) -> Iterable[EnvSpec]:
        """Return all that are registered here."""
        return self.env_specs.values()


def _as_old(spec: Any) -> EnvSpec:
    """Return what Gymnasium has registered, with the fields that gym had."""
    limit, goal = spec.max_episode_steps, spec.reward_threshold
    return EnvSpec(spec.id, spec.entry_point, goal, spec.nondeterministic, limit, dict(spec.kwargs))


def load(entry_point: EntryPoint) -> Callable[..., Any]:
    """Return what an entry point names.

    Raises:
        Error: It has no colon.
    """
    if not isinstance(entry_point, str):
        return entry_point
    module, _, attributes = entry_point.partition(":")
    if not attributes:
        raise Error(f"an entry point is 'module:class', not '{entry_point}'")
    # 'package:folder.module.Class' is allowed too: what is no attribute yet may be a module.
    found: Any = importlib.import_module(module)
    path = module
    for name in attributes.split("."):
        path = f"{path}.{name}"
        found = getattr(found, name) if hasattr(found, name) else importlib.import_module(path)
    made: Callable[..., Any] = found
    return made


registry = EnvRegistry()
register = registry.register
make = registry.make
spec = registry.spec
