"""Steps a second of whole trainings: environment, policy and learner, beside Stable-Baselines3's PPO."""

from __future__ import annotations

import dataclasses
import tempfile
from collections.abc import Callable

from _busy import Spent, StopWatch
from torch import nn

from gazelle.training import PPOSettings, Recipe, recipe_for, train
from gazelle.training.tasks import make_task
from gazelle.training.vecenv import VectorEnvAdapter

_TASK = "TurtleBot3Stage4"


def recipe_of(worlds: int, steps: int) -> Recipe:
    """Return the task's own recipe with so many worlds; rollouts have as many transitions."""
    own = recipe_for(_TASK)
    settings = own.settings
    if not isinstance(settings, PPOSettings):
        raise TypeError(f"{_TASK} is not trained with PPO")
    rows = max(1, own.num_envs * settings.n_steps // worlds)
    settings = dataclasses.replace(settings, n_steps=rows)
    return dataclasses.replace(own, num_envs=worlds, steps=steps, settings=settings)


def warm_up() -> None:
    """Import all that either needs."""
    recipe = recipe_of(64, 16_384)
    ours(recipe)
    bare(recipe)


def ours(recipe: Recipe) -> tuple[int, Spent]:
    """Return the time of `gazelle.training.train`, curves and checkpoints included."""
    with tempfile.TemporaryDirectory() as folder:
        watch = StopWatch()
        result = train(_TASK, recipe=recipe, out=folder)
        return result.new_steps, watch.read()


def bare(recipe: Recipe) -> tuple[int, Spent]:
    """Return the time of Stable-Baselines3's PPO with the same settings, without curves."""
    from stable_baselines3 import PPO

    settings = recipe.settings
    env = VectorEnvAdapter(
        make_task(_TASK, recipe.num_envs, **recipe.training_options), goal_reward=recipe.goal_reward
    )
    watch = StopWatch()
    learner = PPO(
        "MlpPolicy",
        env,
        learning_rate=recipe.learning_rate,
        n_steps=settings.n_steps,
        batch_size=settings.batch_size,
        n_epochs=settings.n_epochs,
        gamma=recipe.gamma,
        gae_lambda=settings.gae_lambda,
        clip_range=settings.clip_range,
        ent_coef=settings.ent_coef,
        vf_coef=settings.vf_coef,
        max_grad_norm=settings.max_grad_norm,
        seed=0,
        device="cpu",
        policy_kwargs={"net_arch": list(recipe.net_arch), "activation_fn": nn.ReLU},
    )
    learner.learn(recipe.steps)
    spent = watch.read()
    env.close()
    return learner.num_timesteps, spent


def compare(worlds: int, steps: int, repeat: int) -> str:
    """Return a line: both in turns, the fastest of each."""
    recipe = recipe_of(worlds, steps)
    pairs = [(_figures(ours, recipe), _figures(bare, recipe)) for _ in range(repeat)]
    (mine, cost, busy), (other, price, _) = (max(column) for column in zip(*pairs, strict=True))
    return f"{worlds:>6}{mine:>14,.0f}{cost:>8.1f}{other:>14,.0f}{price:>8.1f}{mine / other:>8.1f}{busy:>8.1f}"


HEADER = (
    f"{'worlds':>6}{'steps/s':>14}{'CPU us':>8}{'SB3 steps/s':>14}{'CPU us':>8}{'times':>8}"
    f"{'others':>8}"
)
"""Above the lines of `compare`; others: how many processors other programs kept busy meanwhile."""


def _figures(
    run: Callable[[Recipe], tuple[int, Spent]], recipe: Recipe
) -> tuple[float, float, float]:
    """Return steps a second, processor time of a step [us], and processors busy with others."""
    steps, spent = run(recipe)
    return steps / spent.wall, 1e6 * spent.processor / steps, spent.others or 0.0
