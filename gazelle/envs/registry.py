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


def _agv_fleet() -> RegisteredTask:
    home = "gazelle.envs.agv_fleet.envs"
    return RegisteredTask(
        id="gazelle/AGVFleet-v0",
        env=f"{home}:AGVFleetEnv",
        vector_env=f"{home}:AGVFleetVectorEnv",
        max_episode_steps=500,
    )


def _cartpole() -> RegisteredTask:
    home = "gazelle.envs.cartpole.envs"
    return RegisteredTask(
        id="gazelle/CartPoleStayUp-v0",
        env=f"{home}:CartPoleStayUpEnv",
        vector_env=f"{home}:CartPoleStayUpVectorEnv",
        max_episode_steps=1000,
    )


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


def _moving_cube() -> RegisteredTask:
    home = "gazelle.envs.moving_cube.envs"
    return RegisteredTask(
        id="gazelle/MovingCubeOneDiskWalk-v0",
        env=f"{home}:MovingCubeEnv",
        vector_env=f"{home}:MovingCubeVectorEnv",
        max_episode_steps=1000,
    )


def _driving() -> list[RegisteredTask]:
    home = "gazelle.envs.discrete_drive.envs"
    return [
        RegisteredTask(
            id=f"gazelle/{name}-v0",
            env=f"{home}:{name}Env",
            vector_env=f"{home}:{name}VectorEnv",
            max_episode_steps=500,
        )
        for name in (
            *("TurtleBot2Maze", "TurtleBot2Wall", "TurtleBot3World"),
            *("Husarion", "SummitXLRoom"),
        )
    ]


def _kobuki() -> list[RegisteredTask]:
    home = "gazelle.envs.kobuki_maze.envs"
    return [
        RegisteredTask(
            id=f"gazelle/Kobuki{name}-v0",
            env=f"{home}:Kobuki{name}Env",
            vector_env=f"{home}:Kobuki{name}VectorEnv",
            max_episode_steps=1000,
        )
        for name in ("Empty", "Maze", "Dynamic1", "Dynamic2", "Dynamic3")
    ]


def _camera_world() -> RegisteredTask:
    home = "gazelle.envs.camera_world.envs"
    return RegisteredTask(
        id="gazelle/TurtleBot3CameraWorld-v0",
        env=f"{home}:TurtleBot3CameraWorldEnv",
        vector_env=f"{home}:TurtleBot3CameraWorldVectorEnv",
        max_episode_steps=120,
    )


def _hopper() -> RegisteredTask:
    home = "gazelle.envs.hopper.envs"
    return RegisteredTask(
        id="gazelle/HopperStayUp-v0",
        env=f"{home}:HopperStayUpEnv",
        vector_env=f"{home}:HopperStayUpVectorEnv",
        max_episode_steps=1000,
    )


def _reachers() -> list[RegisteredTask]:
    home = "gazelle.envs.reacher.envs"
    steps = {
        "ABBIRB120Reach": 50,
        "ABBIRB140Reach": 50,
        "ABBIRB140VelocityReach": 300,
        "UR5Reach": 50,
    }
    return [
        RegisteredTask(
            id=f"gazelle/{name}-v0",
            env=f"{home}:{name}Env",
            vector_env=f"{home}:{name}VectorEnv",
            max_episode_steps=limit,
        )
        for name, limit in steps.items()
    ]


ENTRIES = (
    *_turtlebot3(),
    _camera_world(),
    _agv_fleet(),
    _cartpole(),
    _moving_cube(),
    *_driving(),
    *_kobuki(),
    _hopper(),
    *_reachers(),
    *_fetch(),
)


def register_all() -> None:
    """Tell Gymnasium of every task that it does not know yet."""
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
    """The ids of all tasks, in the order of the table."""
    return tuple(entry.id for entry in ENTRIES)
