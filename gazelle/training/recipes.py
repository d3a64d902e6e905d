"""Recipes of the tasks: one frozen recipe a task.

A recipe holds everything that shapes the result, so a run is described by its
recipe, its seed and the options of its environment.
"""

from __future__ import annotations

import dataclasses
import warnings

from gazelle.errors import TaskWarning
from gazelle.training.flight_recipes import FLIGHT, VESSEL
from gazelle.training.frobs_rl_recipes import FROBS_RL
from gazelle.training.goal_reward import GoalReward
from gazelle.training.openai_ros_recipes import OPENAI_ROS
from gazelle.training.plain_recipes import OFF_POLICY, library_recipe, plain_recipe
from gazelle.training.recipe import (
    ALGORITHM_NAMES,
    LIBRARY_ALGORITHMS,
    LibrarySettings,
    OffPolicySettings,
    PPOSettings,
    Recipe,
    recipe_from_dict,
    recipe_to_dict,
)
from gazelle.training.supported_values import PARTIAL_SUPPORT, supported_only

__all__ = [
    "ALGORITHM_NAMES",
    "GOALS",
    "LIBRARY_ALGORITHMS",
    "RECIPES",
    "LibrarySettings",
    "OffPolicySettings",
    "PPOSettings",
    "Recipe",
    "recipe_for",
    "recipe_from_dict",
    "recipe_to_dict",
    "task_name",
]

# Starts, headings, goals and phases of obstacles from all over the free space: what is learnt
# from the published ones alone does not hold elsewhere. What a policy is paid for, logarithms of
# ranges and the dear collision are each worth points, see docs/explanation/benchmarks.md.
_NAVIGATION = Recipe(
    steps=1_000_000,
    num_envs=512,
    activation="relu",
    learning_rate=3e-3,
    gamma=0.95,
    goal_reward=GoalReward(collision=5.0),
    features=True,
    training_options={"engine": "planar", "starts": "training", "goals": "training"},
    settings=PPOSettings(n_steps=32, batch_size=4096, n_epochs=3, bfloat16=True),
)

# Defaults for users' tasks: five of examples/ learn with them, see docs/tutorials/own-task.md. With
# rewards in their own units, a third of the step size and minibatches of 1024, the box is pushed to its
# goal in 48 % of the episodes. Distances and angles get logarithms, sines and cosines.
_DEFAULT = Recipe(
    steps=1_000_000,
    success_to_finish=0.95,
    learning_rate=3e-3,
    features=True,
    settings=PPOSettings(n_steps=32, batch_size=256, n_epochs=6, scale_rewards=True),
)

PICTURES = _DEFAULT.with_steps(100_000)
"""For tasks that observe a picture: to render one takes longer than a step of most tasks."""

# Small networks, a step size that stays, a target that follows quickly: goals are few steps away.
_FETCH_REACH = Recipe(
    algo="ddpg",
    steps=5_000,
    num_envs=8,
    activation="relu",
    learning_rate=1e-3,
    learning_rate_decay=False,
    gamma=0.95,
    training_options={"engine": "mujoco"},
    settings=OffPolicySettings(
        buffer_size=100_000,
        batch_size=128,
        learning_starts=400,
        gradient_steps=4,
        tau=0.05,
        action_noise=0.2,
    ),
)

_GOAL_SETTINGS = OffPolicySettings(
    buffer_size=1_000_000,
    batch_size=256,
    learning_starts=1_600,
    gradient_steps=4,
    tau=0.05,
    action_noise=0.2,
    random_actions=0.3,
    action_penalty=1.0,
    bound_values=True,
    bfloat16=True,
)

# Defaults for users' goal tasks: what is reached grows slowly at first, so all that makes it grow is used.
GOALS = Recipe(
    algo="ddpg",
    steps=100_000,
    num_envs=16,
    net_arch=(128, 128),
    activation="relu",
    learning_rate=1e-3,
    gamma=0.95,
    cut_observations=5.0,
    hindsight_redraw=0.9,
    goal_differences=True,
    settings=_GOAL_SETTINGS,
)
"""For tasks with goals that have no recipe of their own, see `gazelle.training.recipe_choice`."""


def _shown_fetch(task: str, steps: int, batch_size: int) -> Recipe:
    """Return the recipe of a task that needs demonstrations: 256 episodes."""
    settings = dataclasses.replace(
        _GOAL_SETTINGS,
        batch_size=batch_size,
        learning_starts=12_800,
        gradient_steps=2,
        tau=0.1,
        policy_delay=2,
        action_noise=0.1,
        random_actions=0.1,
        demonstrator=f"gazelle.envs.fetch.demonstrators:{task}",
        imitation=5.0,
    )
    return dataclasses.replace(
        GOALS,
        steps=steps,
        num_envs=64,
        net_arch=(256, 256, 256),
        learning_rate_hold=0.6,
        training_options=_FETCH_REACH.training_options,
        settings=settings,
    )


RECIPES: dict[str, Recipe] = {
    # A hall full of AGVs: what bumps is two that meet, so that is dear, and far goals draw gently. An
    # AGV of 0.5 m is never between two of 48 rays within 3.8 m, but was between two of 24 at 1.9 m.
    # With a horizon of 10 s (a discount of 0.98) robots in crowds wait for each other.
    # Collisions are rare, so an update needs many transitions to learn of them. Crowds of 90 teach
    # more of them than the 72 that are evaluated.
    "AGVFleet": Recipe(
        steps=6_400_000,
        num_envs=1170,
        net_arch=(128, 128),
        activation="relu",
        learning_rate=2.5e-3,
        gamma=0.99,
        goal_reward=GoalReward(goal=1.0, collision=4.0, progress=0.2),
        features=True,
        training_options={
            "engine": "planar",
            "agents": 90,
            "lidar_samples": 48,
            "max_episode_steps": 1000,
        },
        evaluation_options={"agents": 72, "max_episode_steps": 500},
        settings=PPOSettings(
            n_steps=16,
            batch_size=3072,
            n_epochs=3,
            ent_coef=0.0,
            initial_std=0.7,
            bfloat16=True,
        ),
    ),
    "CartPole": Recipe(
        steps=250_000,
        num_envs=16,
        learning_rate=1e-3,
        gamma=0.99,
        settings=PPOSettings(
            n_steps=64, batch_size=256, n_epochs=10, ent_coef=0.0, scale_rewards=True
        ),
    ),
    **OPENAI_ROS,
    **FROBS_RL,
    "ParrotDroneGoto": FLIGHT,
    "WamvBuoys": VESSEL,
    "TurtleBot3CameraWorld": Recipe(
        steps=80_000,
        net_arch=(64,),
        activation="relu",
        learning_rate=1e-3,
        gamma=0.97,
        training_options={"engine": "planar"},
        settings=PPOSettings(n_steps=32, batch_size=256, n_epochs=3, ent_coef=0.01),
    ),
    **{f"FetchReach{reward}": _FETCH_REACH for reward in ("", "Dense")},
    **{
        f"Fetch{task}{reward}": recipe
        for task, recipe in (
            ("Push", _shown_fetch("push", 400_000, 256)),
            ("PickAndPlace", _shown_fetch("pick_and_place", 200_000, 512)),
            ("Slide", _shown_fetch("push", 400_000, 256)),
        )
        for reward in ("", "Dense")
    },
    "TurtleBot3Stage1": dataclasses.replace(_NAVIGATION, steps=500_000),
    "TurtleBot3Stage2": _NAVIGATION,
    "TurtleBot3Stage3": _NAVIGATION,
    # Obstacles are as fast as the robot: see farther ahead, and keep away from them.
    "TurtleBot3Stage4": dataclasses.replace(
        _NAVIGATION,
        steps=6_000_000,
        num_envs=1024,
        gamma=0.985,
        goal_reward=GoalReward(collision=10.0),
        training_options={**_NAVIGATION.training_options, "margin": 0.04},
        settings=PPOSettings(
            n_steps=16,
            batch_size=2048,
            n_epochs=3,
            gae_lambda=0.9,
            ent_coef=0.005,
            bfloat16=True,
        ),
    ),
    # And update more often for each step. Other algorithms begin with this one's values, too.
    "TurtleBot3Stage4Continuous": dataclasses.replace(
        _NAVIGATION,
        steps=2_000_000,
        learning_rate=2e-3,
        gamma=0.97,
        settings=PPOSettings(n_steps=16, n_epochs=3, gae_lambda=0.9, ent_coef=0.001, bfloat16=True),
    ),
}
"""The recipe of each task, by the task's name without ``gazelle/`` and version."""


def recipe_for(task: str, algo: str | None = None) -> Recipe:
    """Return the recipe for a task, by default with the algorithm that suits it best.

    A task without a recipe of its own gets the defaults of the algorithm. A
    continuous twin (``...Continuous``) without one uses the recipe of its task. Another algorithm than the
    recipe's own gets those of its values that it takes notice of, or of the twin's where there is
    one; a `TaskWarning` says so where that costs it the demonstrator.

    Args:
        task: Name or id, such as ``TurtleBot3Stage1`` or ``gazelle/TurtleBot3Stage1-v0``.
        algo: ``ppo``, ``dqn``, ``sac``, ``td3`` or ``ddpg``; None for the recipe's own.

    Raises:
        TaskError: There is no such algorithm.
    """
    full = task_name(task)
    name = full.removesuffix("Continuous")
    own = RECIPES.get(full) or RECIPES.get(name)
    if algo is None or (own is not None and own.algo == algo):
        return own or _DEFAULT
    own = RECIPES.get(f"{name}Continuous", own)
    _warn_of_demonstrator(own, algo)
    if algo == "ppo":
        return _DEFAULT
    if own is not None and isinstance(own.settings, OffPolicySettings):
        return _with_memory(own, own.settings, algo)
    base = plain_recipe(name, algo)
    if own is None:
        return base
    return dataclasses.replace(
        base,
        gamma=own.gamma,
        reward_scale=own.reward_scale,
        goal_reward=base.goal_reward or own.goal_reward,
        features=own.features,
        bearing=own.bearing,
        training_options=own.training_options,
        evaluation_options=own.evaluation_options,
    )


def _with_memory(own: Recipe, settings: OffPolicySettings, algo: str) -> Recipe:
    """Return the recipe for another algorithm; off-policy ones keep their numbers."""
    if algo in OFF_POLICY:
        return dataclasses.replace(own, algo=algo, settings=supported_only(algo, settings))
    if algo != "tqc":
        return dataclasses.replace(library_recipe(algo), gamma=own.gamma)
    shared = ("buffer_size", "batch_size", "learning_starts", "gradient_steps", "tau")
    options = {name: getattr(settings, name) for name in shared}
    return dataclasses.replace(own, algo=algo, settings=LibrarySettings(options=options))


def _warn_of_demonstrator(own: Recipe | None, algo: str) -> None:
    """Warn that an algorithm does not use a recipe's demonstrator."""
    shown = own is not None and getattr(own.settings, "demonstrator", None) is not None
    able = PARTIAL_SUPPORT["demonstrator"]
    if shown and algo in (*OFF_POLICY, *LIBRARY_ALGORITHMS, "ppo") and algo not in able:
        text = f"{algo} cannot be shown what to do, so this recipe's demonstrator is left out"
        warnings.warn(TaskWarning(f"{text}; {' and '.join(able)} can"), stacklevel=3)


def task_name(task: str) -> str:
    """Return the short name: ``TurtleBot3Stage1`` of ``gazelle/TurtleBot3Stage1-v0``."""
    name = task.rsplit("/", maxsplit=1)[-1]
    head, dash, version = name.rpartition("-v")
    return head if dash and version.isdigit() else name
