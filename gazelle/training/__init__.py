"""Train, resume and evaluate policies.

::

    from gazelle.training import evaluate, resume, train

    result = train("TurtleBot3Stage1", steps=300_000)
    print(evaluate(result.run.folder, episodes=100).success)

Evaluation needs numpy only; torch is imported when something is trained.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from gazelle.errors import MissingExtraError

if TYPE_CHECKING:
    from gazelle.training.actor import Actor, load_actor
    from gazelle.training.claims import Claim, Claims, Trial, published_claims
    from gazelle.training.evaluation import Evaluation, evaluate
    from gazelle.training.goal_reward import GoalReward
    from gazelle.training.learners import ALGORITHMS
    from gazelle.training.overrides import with_values
    from gazelle.training.policy_files import PolicyFiles, export_policy, load_policy
    from gazelle.training.prediction import predicted_range
    from gazelle.training.progress import Progress, choose_progress
    from gazelle.training.recipe_choice import listed_recipe, task_recipe
    from gazelle.training.recipes import (
        RECIPES,
        LibrarySettings,
        OffPolicySettings,
        PPOSettings,
        Recipe,
        recipe_for,
    )
    from gazelle.training.records import EpisodeRecord
    from gazelle.training.run_archive import pack_run, unpack_run
    from gazelle.training.run_list import RunSummary, list_runs
    from gazelle.training.runs import Run, RunConfig
    from gazelle.training.session import TrainResult, resume, train
    from gazelle.training.statistics import SuccessRate, wilson_interval
    from gazelle.training.study import Study, StudyResult, conduct
    from gazelle.training.tasks import Task, describe_task, find_task, list_tasks, make_task

_EXTRA = ("stable_baselines3", "tensorboard", "threadpoolctl", "torch", "tqdm")

_HOMES = {
    "ALGORITHMS": "learners",
    "Actor": "actor",
    "Claim": "claims",
    "Claims": "claims",
    "EpisodeRecord": "records",
    "Evaluation": "evaluation",
    "GoalReward": "goal_reward",
    "LibrarySettings": "recipes",
    "OffPolicySettings": "recipes",
    "PPOSettings": "recipes",
    "PolicyFiles": "policy_files",
    "Progress": "progress",
    "RECIPES": "recipes",
    "Study": "study",
    "StudyResult": "study",
    "SuccessRate": "statistics",
    "Recipe": "recipes",
    "Run": "runs",
    "RunConfig": "runs",
    "RunSummary": "run_list",
    "Task": "tasks",
    "TrainResult": "session",
    "Trial": "claims",
    "choose_progress": "progress",
    "conduct": "study",
    "describe_task": "tasks",
    "evaluate": "evaluation",
    "export_policy": "policy_files",
    "find_task": "tasks",
    "list_runs": "run_list",
    "list_tasks": "tasks",
    "listed_recipe": "recipe_choice",
    "load_actor": "actor",
    "load_policy": "policy_files",
    "make_task": "tasks",
    "pack_run": "run_archive",
    "predicted_range": "prediction",
    "published_claims": "claims",
    "recipe_for": "recipes",
    "resume": "session",
    "task_recipe": "recipe_choice",
    "train": "session",
    "unpack_run": "run_archive",
    "wilson_interval": "statistics",
    "with_values": "overrides",
}

__all__ = [
    "ALGORITHMS",
    "RECIPES",
    "Actor",
    "Claim",
    "Claims",
    "EpisodeRecord",
    "Evaluation",
    "GoalReward",
    "LibrarySettings",
    "OffPolicySettings",
    "PPOSettings",
    "PolicyFiles",
    "Progress",
    "Recipe",
    "Run",
    "RunConfig",
    "RunSummary",
    "Study",
    "StudyResult",
    "SuccessRate",
    "Task",
    "TrainResult",
    "Trial",
    "choose_progress",
    "conduct",
    "describe_task",
    "evaluate",
    "export_policy",
    "find_task",
    "list_runs",
    "list_tasks",
    "listed_recipe",
    "load_actor",
    "load_policy",
    "make_task",
    "pack_run",
    "predicted_range",
    "published_claims",
    "recipe_for",
    "resume",
    "task_recipe",
    "train",
    "unpack_run",
    "wilson_interval",
    "with_values",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its module on first use."""
    if name not in _HOMES:
        raise AttributeError(f"module 'gazelle.training' has no attribute '{name}'")
    try:
        module = importlib.import_module(f"gazelle.training.{_HOMES[name]}")
    except ModuleNotFoundError as error:
        if error.name in _EXTRA:
            raise MissingExtraError(error.name, "train") from error
        raise
    value = getattr(module, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
