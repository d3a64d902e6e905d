"""Choice of the replay memory of an algorithm."""

from __future__ import annotations

from typing import Any

from gazelle.errors import TaskError
from gazelle.training.hindsight import HindsightReplayBuffer
from gazelle.training.recipes import Recipe
from gazelle.training.replay import MaskedReplayBuffer
from gazelle.training.vecenv import VectorEnvAdapter


def replay_options(recipe: Recipe, env: VectorEnvAdapter) -> dict[str, Any]:
    """Return the replay-memory arguments of a Stable-Baselines3 algorithm.

    Raises:
        TaskError: The recipe pays in another way than the task, which cannot tell what that had
            been worth with other goals.
    """
    goals = env.goal_replay
    if goals is None or not recipe.hindsight:
        return {"replay_buffer_class": MaskedReplayBuffer}
    if recipe.goal_reward is not None:
        raise TaskError(
            "a goal_reward cannot be worked out for goals that were reached later",
            hint="set hindsight to 0, or leave out goal_reward",
        )
    return {
        "replay_buffer_class": HindsightReplayBuffer,
        "replay_buffer_kwargs": {
            "goals": goals,
            "share": recipe.hindsight,
            "redraw": recipe.hindsight_redraw,
            "reward_scale": recipe.reward_scale,
        },
    }
