"""DDPG (T. P. Lillicrap et al., 2015, arXiv 1509.02971), with the update of `FastTD3`."""

from __future__ import annotations

from stable_baselines3 import DDPG

from gazelle.training.learners.arguments import Learner, noisy_arguments
from gazelle.training.learners.td3 import DeterministicLearner, configured
from gazelle.training.recipes import Recipe
from gazelle.training.vecenv import VectorEnvAdapter


class FastDDPG(DeterministicLearner, DDPG):  # type: ignore[misc]  # untyped base
    """DDPG; see `gazelle.training.learners.td3` for what differs."""


def build_ddpg(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a learner for an environment."""
    return configured(FastDDPG("MlpPolicy", env, **noisy_arguments(recipe, env, seed)), recipe)
