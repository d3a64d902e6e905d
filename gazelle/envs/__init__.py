"""Gymnasium environments, registered when this is imported.

::

    import gymnasium as gym
    import gazelle.envs

    env = gym.make("gazelle/TurtleBot3Stage1-v0")
    many = gym.make_vec(
        "gazelle/TurtleBot3Stage1-v0", num_envs=64, vectorization_mode="vector_entry_point"
    )

The batched tasks are the implementation: arrays with a leading axis over worlds. A vector
environment wraps one with many worlds, a single environment one with one world.
"""

import importlib
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.envs.batched_task import BatchedTask, TaskOutcome, Transition
from gazelle.envs.contract import ActionRule, ObservationPart, PolicyContract, ScanRule
from gazelle.envs.dict_rows import DictRows
from gazelle.envs.errors import ClosedEnvError, ResetNeededError
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.goals import GoalTable
from gazelle.envs.registry import register_all, task_ids
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv

if TYPE_CHECKING:
    from gazelle.envs.goal_envs import TaskGoalEnv, TaskGoalVectorEnv
    from gazelle.envs.goal_task import GoalSimulationTask
    from gazelle.envs.simulation_task import SimulationTask, StepOutcome
    from gazelle.envs.task_registration import register_task

__all__ = [
    "ActionRule",
    "BatchedTask",
    "ClosedEnvError",
    "DictRows",
    "FloorPlan",
    "GoalSimulationTask",
    "GoalTable",
    "ObservationPart",
    "PolicyContract",
    "ResetNeededError",
    "ScanRule",
    "SimulationTask",
    "StepOutcome",
    "TaskEnv",
    "TaskGoalEnv",
    "TaskGoalVectorEnv",
    "TaskOutcome",
    "TaskVectorEnv",
    "Transition",
    "register_all",
    "register_task",
    "task_ids",
]


_HOMES = {
    "GoalSimulationTask": "goal_task",
    "SimulationTask": "simulation_task",
    "StepOutcome": "simulation_task",
    "TaskGoalEnv": "goal_envs",
    "TaskGoalVectorEnv": "goal_envs",
    "register_task": "task_registration",
}


def __getattr__(name: str) -> Any:
    """Import on first use what needs a simulation."""
    if name == "Verdict":
        text = "gazelle.envs.Verdict is called TaskOutcome now"
        warnings.warn(DeprecationWarning(text), stacklevel=2)
        return TaskOutcome
    if name not in _HOMES:
        raise AttributeError(f"module 'gazelle.envs' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"gazelle.envs.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


register_all()
