"""Recipes for training frobs_rl's tasks."""

from __future__ import annotations

import dataclasses

from gazelle.training.goal_reward import GoalReward
from gazelle.training.recipe import PPOSettings, Recipe

# frobs_rl's goals are far away: what counts is coming nearer.
_KOBUKI = Recipe(
    steps=300_000,
    num_envs=128,
    learning_rate=2e-3,
    gamma=0.97,
    goal_reward=GoalReward(goal=5.0, collision=1.0),
    features=True,
    training_options={"engine": "planar"},
    settings=PPOSettings(n_steps=32, batch_size=1024, n_epochs=4),
)

# Goals up to 71 m away among boxes: copies that circle show nothing for the rest of long episodes. With
# whole ones 83 to 100 % arrive as the seed has it, with a fifth of the steps 98 to 99 %.
_KOBUKI_FAR = dataclasses.replace(
    _KOBUKI,
    gamma=0.98,
    training_options={**_KOBUKI.training_options, "max_episode_steps": 200},
    evaluation_options={"max_episode_steps": 1000},
)

# Arms turn further in a step than to the goal and back: steps are taken small at first, and what
# counts is the reward of the very next ones. Coarse steps of physics hold joints' speeds as well.
_REACH_SETTINGS = PPOSettings(
    n_steps=16, batch_size=1024, n_epochs=6, ent_coef=0.0, initial_std=0.3, bfloat16=True
)
_REACH = Recipe(
    steps=500_000,
    num_envs=128,
    net_arch=(128, 128),
    activation="relu",
    learning_rate=2e-3,
    gamma=0.9,
    goal_reward=GoalReward(goal=1.0, collision=0.0, progress=4.0),
    angles=tuple(range(6, 12)),
    training_options={"engine": "mujoco", "time_step": 0.05},
    evaluation_options={"time_step": 0.01},
    settings=_REACH_SETTINGS,
)

# Joints that begin anywhere within two turns end up at their limits on the shortest way, and stay there:
# 80 % arrive, however long they learn. What the task itself takes for a joint at a limit teaches them.
_FROM_ANYWHERE = dataclasses.replace(
    _REACH,
    steps=400_000,
    gamma=0.95,
    goal_reward=GoalReward(goal=3.0, collision=0.0, progress=2.0, own=0.2),
)

FROBS_RL: dict[str, Recipe] = {
    "ABBIRB120Reach": _REACH,
    "ABBIRB140Reach": dataclasses.replace(_REACH, steps=400_000),
    "UR5Reach": _FROM_ANYWHERE,
    # Joints turn by 0.02 rad a step: speeds that are held for ten show ten times as many goals, and
    # what they lead to: 70 % are there in the end, with single steps 46 %. Goals near the base need folded
    # postures, which larger networks tell apart, and a longer horizon.
    "ABBIRB140VelocityReach": dataclasses.replace(
        _REACH,
        steps=800_000,
        net_arch=(256, 256),
        learning_rate=1.5e-3,
        gamma=0.97,
        goal_reward=GoalReward(goal=0.0, collision=0.0, progress=4.0, own=0.004),
        angles=tuple(range(6)),
        training_options={
            "engine": "mujoco",
            "time_step": 0.1,
            "control_period": 1.0,
            "max_episode_steps": 30,
        },
        evaluation_options={"time_step": 0.01, "control_period": 0.1, "max_episode_steps": 300},
        settings=dataclasses.replace(_REACH_SETTINGS, initial_std=0.2),
    ),
    **dict.fromkeys(("KobukiEmpty", "KobukiDynamic3"), _KOBUKI),
    **dict.fromkeys(("KobukiDynamic1", "KobukiDynamic2"), _KOBUKI_FAR),
    # Points of the way stand behind walls: each is paid for, and the way to the next one from there.
    "KobukiMaze": dataclasses.replace(
        _KOBUKI,
        steps=600_000,
        gamma=0.98,
        goal_reward=GoalReward(goal=5.0, collision=1.0, waypoint=2.0),
    ),
}
"""By the task's name."""
