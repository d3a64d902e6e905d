"""Recipes of openai_ros' quadrotor and vessel, which have no wheels to hold them."""

from __future__ import annotations

import dataclasses

from gazelle.training.goal_reward import GoalReward
from gazelle.training.recipe import PPOSettings, Recipe

# A step of a second is 100 coarse ones of physics; the drone holds its velocity with those, too.
FLIGHT = Recipe(
    steps=100_000,
    num_envs=256,
    activation="relu",
    learning_rate=2e-3,
    gamma=0.97,
    goal_reward=GoalReward(goal=2.0, collision=2.0, progress=0.3, other_end=2.0),
    features=True,
    training_options={"engine": "mujoco", "time_step": 0.01, "starts": "training"},
    evaluation_options={"time_step": 0.004},
    settings=PPOSettings(n_steps=16, batch_size=1024, n_epochs=6),
)

# A vessel is slow to stop: it has to be at its goal just when a step is over, or be slow there.
VESSEL = dataclasses.replace(
    FLIGHT,
    steps=200_000,
    gamma=0.98,
    training_options={"engine": "mujoco", "time_step": 0.02, "starts": "training"},
    evaluation_options={"time_step": 0.01},
)
