"""Options of tasks: their types, their defaults, and errors that name the closest one."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, ClassVar, TypedDict, TypeVar

from gazelle.description import Model, World
from gazelle.engines import engine_names
from gazelle.engines.limits import SHORTEST_STEP
from gazelle.envs.limits import MAX_LIDAR_SAMPLES, MAX_STEPS
from gazelle.errors import TaskError, did_you_mean
from gazelle_ros.base.real_numbers import real

RENDER_MODES = ("rgb_array",)
SPLITS = ("published", "training", "held-out")
"""Sources of starts and goals: as published, or free space for one of two purposes."""

_WIDEST_MARGIN = 0.15  # [m]; some 0.3 m are free where episodes begin

Settings = TypeVar("Settings", bound="TaskSettings")


class TaskOptions(TypedDict, total=False):
    """Options of every task; see `TaskSettings`."""

    engine: str
    seed: int | None
    max_episode_steps: int | None
    render_mode: str | None
    threads: int | None
    time_step: float | None


class NavigationOptions(TaskOptions, total=False):
    """Further options of navigation tasks; see `NavigationSettings`."""

    lidar_samples: int
    world: str | Path | World | None
    robot: str | Path | Model | None
    goals: Sequence[tuple[float, float]] | str | None
    seen_goals: Sequence[tuple[float, float]] | None
    starts: str
    respawn: bool
    margin: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskSettings:
    """Options of every task, checked.

    Attributes:
        engine: Name of the physics engine.
        seed: Of the first episode when ``reset`` gets none; None draws one.
        max_episode_steps: Control steps until an episode is truncated; None for no limit.
        render_mode: ``rgb_array``, or None.
        threads: Native threads of the engine; None for all processors.
        time_step: Physics step [s]; None for the task's own.
        needs_forces: Whether what moves is pushed, so that the plane's engine cannot move it.

    Raises:
        TaskError: A value is invalid.
    """

    needs_forces: ClassVar[bool] = False
    engine: str = "mujoco"
    seed: int | None = None
    max_episode_steps: int | None = None
    render_mode: str | None = None
    threads: int | None = None
    time_step: float | None = None

    def __post_init__(self) -> None:
        if self.engine not in engine_names():
            raise TaskError(
                f"there is no engine '{self.engine}'",
                hint=did_you_mean(str(self.engine), engine_names()),
            )
        if self.needs_forces and self.engine == "planar":
            hint = "leave the engine out, or choose mujoco"
            raise TaskError(
                "the planar engine computes no forces, which this task needs", hint=hint
            )
        if self.render_mode is not None:
            check_name("render mode", self.render_mode, RENDER_MODES)
        limits = (("seed", 0, None), ("max_episode_steps", 1, MAX_STEPS), ("threads", 1, None))
        for name, least, most in limits:
            value = getattr(self, name)
            if value is not None:
                check_integer(name, value, least, most)
        if self.time_step is not None:
            check_seconds("time_step", self.time_step, below=1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsSettings(TaskSettings):
    """Checked options of a task with a robot moved by forces: the plane's engine is refused."""

    needs_forces: ClassVar[bool] = True


@dataclass(frozen=True, slots=True, kw_only=True)
class StartSettings(DynamicsSettings):
    """Options of a task moved by forces that can begin at many places, checked.

    Attributes:
        starts: ``published``, or ``training`` or ``held-out``: anywhere; places of the two are not the same.
    """

    starts: str = "published"

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        TaskSettings.__post_init__(self)
        check_name("kind of starts", str(self.starts), SPLITS)


@dataclass(frozen=True, slots=True, kw_only=True)
class NavigationSettings(TaskSettings):
    """Options of a task in which a robot with a lidar drives to goals, checked.

    Attributes:
        lidar_samples: Ranges in the observation, 2 or more.
        world: World file, bundled name or description; None for the task's own.
        robot: Robot file, bundled name or description; None for the task's own.
        goals: Places in the world frame [m] that goals are drawn from, or one of `SPLITS`; None
            for the task's own, as ``published``.
        seen_goals: Places [m] that ``held-out`` goals keep away from, as from the task's own.
        starts: One of `SPLITS`: how the robot and what moves stand when an episode begins.
        respawn: Whether the episode continues to another goal when one is reached.
        margin: By how much sooner than published a range is a collision [m], so that what is
            learnt keeps its distance.
    """

    lidar_samples: int = 24
    world: str | Path | World | None = None
    robot: str | Path | Model | None = None
    goals: Sequence[tuple[float, float]] | str | None = None
    seen_goals: Sequence[tuple[float, float]] | None = None
    starts: str = "published"
    respawn: bool = True
    margin: float = 0.0

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        TaskSettings.__post_init__(self)
        check_integer("lidar_samples", self.lidar_samples, 2, MAX_LIDAR_SAMPLES)
        if not isinstance(self.respawn, bool):
            raise TaskError(f"respawn must be True or False, not {self.respawn!r}")
        check_name("kind of starts", str(self.starts), SPLITS)
        if isinstance(self.goals, str):
            check_name("kind of goals", self.goals, SPLITS)
        check_up_to("margin", self.margin, _WIDEST_MARGIN, "metres")
        _check_kind("world", self.world, World)
        _check_kind("robot", self.robot, Model)


def held_out_options(trained: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options for evaluating a navigation policy: starts and goals that are new to it.

    Args:
        trained: The options that it was trained with.

    Returns:
        Those that differ. One goal an episode, so that each counts alike, and no margin.
    """
    seen = trained.get("goals")
    options: dict[str, Any] = {"starts": "held-out", "goals": "held-out", "respawn": False}
    if trained.get("margin"):
        options["margin"] = 0.0
    return options if seen is None or isinstance(seen, str) else {**options, "seen_goals": seen}


def read_options(settings: type[Settings], options: Mapping[str, Any]) -> Settings:
    """Convert keyword arguments to checked settings.

    Raises:
        TaskError: An option is unknown (the hint names the closest), or a value is invalid.
    """
    known = [field.name for field in fields(settings)]
    for name in options:
        check_name("option", name, known)
    return settings(**options)


def check_name(kind: str, name: str, known: Iterable[str]) -> None:
    """Raise TaskError unless the name is one of those known; the hint names the closest."""
    names = list(known)
    if name not in names:
        raise TaskError(f"there is no {kind} '{name}'", hint=did_you_mean(name, names))


def check_integer(name: str, value: object, least: int, most: int | None = None) -> None:
    """Raise TaskError unless the value is an int that is not too small or too large."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]  # that is what is tested
    except TypeError:
        number = least - 1
    if isinstance(value, bool) or number < least:
        raise TaskError(f"{name} must be an int, {least} or more, not {value!r}")
    if most is not None and number > most:
        raise TaskError(f"{name} must be {most:,} at most, not {number:,}")


def checked_mapping(name: str, value: object) -> Mapping[str, Any]:
    """Return options by name; None are none.

    Raises:
        TaskError: They are not a mapping.
    """
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TaskError(f"{name} must be a mapping of names to values, not {value!r}")
    return value


def checked_seed(seed: object) -> int:
    """Return a seed.

    Raises:
        TaskError: It is not an int, or negative.
    """
    try:
        number = operator.index(seed)  # type: ignore[arg-type]  # that is what is tested
    except TypeError as error:
        raise TaskError(
            f"seed must be one int, not {seed!r}",
            hint="every world derives its own random numbers from it",
        ) from error
    if number < 0:
        raise TaskError(f"seed must not be negative: {number}")
    return number


def check_up_to(name: str, value: object, most: float, unit: str) -> None:
    """Raise TaskError unless the value is a number from 0 on and not too large."""
    number = real(value)
    if number is None or not 0.0 <= number <= most:
        raise TaskError(f"{name} must be from 0 to {most} {unit}, not {value!r:.60}")


def check_seconds(name: str, value: object, *, below: float) -> None:
    """Check that an option is a time of a step that is below a number of seconds.

    Raises:
        TaskError: It is not.
    """
    number = real(value)
    if number is None or not SHORTEST_STEP <= number < below:
        raise TaskError(
            f"{name} must be a number of seconds from {SHORTEST_STEP:g} to {below:g}, not {value!r}"
        )


def _check_kind(name: str, value: object, description: type) -> None:
    if value is not None and not isinstance(value, str | Path | description):
        raise TaskError(
            f"{name} must be a file, a bundled name or a {description.__name__}, not {value!r}"
        )
