"""DQN (V. Mnih et al., "Human-level control through deep reinforcement learning", 2015)."""

from __future__ import annotations

from typing import Any

from stable_baselines3 import DQN

from gazelle.training.learners.arguments import Learner, off_policy_settings, replay_arguments
from gazelle.training.recipes import Recipe
from gazelle.training.scaling import ObservationScale
from gazelle.training.vecenv import VectorEnvAdapter


class ScaledDQN(DQN):  # type: ignore[misc]  # untyped base
    """Stable-Baselines3's DQN, which scales observations of its replay memory as it learns.

    The memory holds them as they were, so all that is learnt from is scaled alike.
    """

    scale: ObservationScale

    def train(self, *arguments: Any, **options: Any) -> None:
        """Train on minibatches."""
        self.scale.refresh()
        super().train(*arguments, **options)


def build_dqn(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a learner for an environment."""
    settings = off_policy_settings(recipe)
    return ScaledDQN(
        "MlpPolicy",
        env,
        exploration_fraction=settings.exploration_fraction,
        exploration_final_eps=settings.exploration_final,
        target_update_interval=settings.target_update_interval,
        **replay_arguments(recipe, env, settings, seed),
    )
