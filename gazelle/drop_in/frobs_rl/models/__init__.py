"""Algorithms of Stable-Baselines3 with parameters from YAML files."""

from __future__ import annotations

from gazelle.drop_in.frobs_rl.models import a2c, ddpg, dqn, ppo, sac, td3

__all__ = ["a2c", "ddpg", "dqn", "ppo", "sac", "td3"]
