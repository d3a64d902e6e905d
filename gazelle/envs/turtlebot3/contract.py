"""The contract of policies of the TurtleBot3 tasks."""

from __future__ import annotations

import math
from typing import Any

import gymnasium as gym
import numpy as np

from gazelle.description import Lidar
from gazelle.envs.contract import (
    ObservationPart,
    PolicyContract,
    ScanRule,
    action_rule,
    in_a_row,
)
from gazelle.envs.turtlebot3.actions import (
    ACTIONS,
    ANGULAR_MAX,
    LINEAR_MAX,
    discrete_command,
)
from gazelle.envs.turtlebot3.rules import Rules


def turtlebot3_contract(
    rules: Rules,
    lidar: Lidar,
    observations: gym.spaces.Box,
    actions: gym.Space[Any],
    max_episode_steps: int | None,
) -> PolicyContract:
    """Return the contract of a policy of these tasks.

    Args:
        rules: Of the stage.
        lidar: With the rays that the task reads.
        observations: The task's space.
        actions: The task's space.
        max_episode_steps: Control steps until an episode is cut off, if it is.
    """
    samples = lidar.horizontal.samples
    parts = [
        ObservationPart(
            name="ranges",
            kind="scan",
            size=samples,
            unit="m",
            low=0.0,
            high=rules.range_max,
            meaning="range of each ray, counter-clockwise",
        ),
        ObservationPart(
            name="heading",
            kind="goal_heading",
            unit="rad",
            low=-math.pi,
            high=math.pi,
            decimals=2,
            meaning="angle from straight ahead to the goal, left positive",
        ),
        ObservationPart(
            name="distance",
            kind="goal_distance",
            unit="m",
            low=0.0,
            high=float(observations.high[samples + 1]),
            decimals=2,
            meaning="straight distance to the goal",
        ),
    ]
    if rules.sees_obstacle:
        parts += _nearest(rules, samples)
    return PolicyContract(
        control_period=rules.control_period,
        observation=in_a_row(*parts),
        action=_action(actions),
        scan=ScanRule(
            first_angle=lidar.horizontal.min_angle,
            last_angle=lidar.horizontal.max_angle,
            no_return=rules.range_max,
            too_near=lidar.range_min,
            farthest=rules.range_max,
        ),
        goal_distance=rules.goal_distance,
        collision_range=rules.collision_range,
        time_limit=None if max_episode_steps is None else max_episode_steps * rules.control_period,
        frames={"pose": "odom", "goal": "odom"},
    )


def _nearest(rules: Rules, samples: int) -> list[ObservationPart]:
    return [
        ObservationPart(
            name="nearest",
            kind="nearest_range",
            unit="m",
            low=0.0,
            high=rules.range_max,
            decimals=2,
            meaning="shortest of the ranges",
        ),
        ObservationPart(
            name="nearest_ray",
            kind="nearest_ray",
            unit="1",
            low=0.0,
            high=samples - 1.0,
            meaning="index of that range",
        ),
    ]


def _action(actions: gym.Space[Any]) -> Any:
    if isinstance(actions, gym.spaces.Discrete):
        linear, angular = discrete_command(np.arange(ACTIONS), ACTIONS)
        choices = tuple(zip(linear.tolist(), angular.tolist(), strict=True))
        meaning = "one of five turns at a steady forward speed"
        return action_rule(actions, kind="velocity", choices=choices, meaning=meaning)
    return action_rule(
        actions,
        kind="velocity",
        at_low=(0.0, -ANGULAR_MAX),
        at_high=(LINEAR_MAX, ANGULAR_MAX),
        meaning="forward speed and yaw rate; numbers outside the bounds are cut to them",
    )
