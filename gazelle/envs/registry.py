"""The tasks that there are, and how Gymnasium makes them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import gymnasium as gym


@dataclass(frozen=True, slots=True)
class RegisteredTask:
    """One task.

    Attributes:
        id: As Gymnasium knows it, such as ``gazelle/NAME-v0``.
        env: ``module:Class`` of the single environment; imported when it is made.
        vector_env: ``module:Class`` of the vector environment.
        max_episode_steps: Control steps until an episode is truncated.
        kwargs: Fixed arguments of both.
    """

    id: str
    env: str
    vector_env: str
    max_episode_steps: int
    kwargs: dict[str, Any] = field(default_factory=dict)


def _turtlebot3() -> list[RegisteredTask]:
    home = "gazelle.envs.turtlebot3.envs"
    return [
        RegisteredTask(
            id=f"gazelle/TurtleBot3Stage{stage}{twin}-v0",
            env=f"{home}:TurtleBot3{twin}Env",
            vector_env=f"{home}:TurtleBot3{twin}VectorEnv",
            max_episode_steps=501,  # the published loop times out in the step after its 500th
            kwargs={"stage": stage},
        )
        for stage in (1, 2, 3, 4)
        for twin in ("", "Continuous")
    ]


def _named(room: str, name: str, steps: int, env: str = "") -> RegisteredTask:
    """Return a task with environments of the same name.

    Args:
        room: The package below `gazelle.envs` that has them.
        name: Of the task.
        steps: Control steps until an episode is truncated.
        env: Text before ``Env`` and ``VectorEnv``, if not the name.
    """
    home = f"gazelle.envs.{room}.envs:{env or name}"
    return RegisteredTask(f"gazelle/{name}-v0", f"{home}Env", f"{home}VectorEnv", steps)


def _fetch() -> list[RegisteredTask]:
    home = "gazelle.envs.fetch.envs"
    return [
        RegisteredTask(
            id=f"gazelle/Fetch{task}{'Dense' if reward == 'dense' else ''}-v0",
            env=f"{home}:FetchEnv",
            vector_env=f"{home}:FetchVectorEnv",
            max_episode_steps=50,
            kwargs={"task": task, "reward_type": reward},
        )
        for task in ("Reach", "Push", "Slide", "PickAndPlace")
        for reward in ("sparse", "dense")
    ]


_DRIVES = ("TurtleBot2Maze", "TurtleBot2Wall", "TurtleBot3World", "Husarion", "SummitXLRoom")
_KOBUKIS = ("Empty", "Maze", "Dynamic1", "Dynamic2", "Dynamic3")
_REACHERS = {
    "ABBIRB120Reach": 50,
    "ABBIRB140Reach": 50,
    "ABBIRB140VelocityReach": 300,
    "UR5Reach": 50,
}

ENTRIES = (
    *_turtlebot3(),
    _named("camera_world", "TurtleBot3CameraWorld", 120),
    _named("agv_fleet", "AGVFleet", 500),
    _named("cartpole", "CartPoleStayUp", 1000),
    _named("moving_cube", "MovingCubeOneDiskWalk", 1000, env="MovingCube"),
    *(_named("discrete_drive", name, 500) for name in _DRIVES),
    *(_named("kobuki_maze", f"Kobuki{name}", 1000) for name in _KOBUKIS),
    _named("hopper", "HopperStayUp", 1000),
    _named("parrot_drone", "ParrotDroneGoto", 100),
    _named("wamv", "WamvBuoys", 100),
    *(_named("reacher", name, steps) for name, steps in _REACHERS.items()),
    *_fetch(),
)


def register_all() -> None:
    """Register every unregistered task with Gymnasium."""
    for entry in ENTRIES:
        if entry.id not in gym.registry:
            gym.register(
                id=entry.id,
                entry_point=entry.env,
                vector_entry_point=entry.vector_env,
                max_episode_steps=entry.max_episode_steps,
                kwargs=dict(entry.kwargs),
            )


def task_ids() -> tuple[str, ...]:
    """Return the ids of all tasks, in the order of the table."""
    return tuple(entry.id for entry in ENTRIES)
