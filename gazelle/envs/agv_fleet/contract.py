"""The contract of policies of the fleet."""

from __future__ import annotations

import math
from typing import Any

import gymnasium as gym

from gazelle.envs.contract import (
    ObservationPart,
    PolicyContract,
    ScanRule,
    action_rule,
    in_a_row,
)


def fleet_contract(
    actions: gym.Space[Any],
    *,
    samples: int,
    reach: float,
    farthest: float,
    speed: float,
    turn: float,
    control_period: float,
    goal_distance: float,
    max_episode_steps: int | None,
) -> PolicyContract:
    """Return the contract of a policy of the fleet.

    Args:
        actions: The task's space.
        samples: Ranges in the observation.
        reach: Of the lidar [m].
        farthest: The longest distance to a goal [m].
        speed: The greatest forward speed [m/s].
        turn: The greatest yaw rate [rad/s].
        control_period: Time between two actions [s].
        goal_distance: Nearer to the goal than this it is reached [m].
        max_episode_steps: Control steps until an episode is cut off, if it is.
    """
    ranges = ObservationPart(
        name="ranges",
        kind="scan",
        size=samples,
        unit="m",
        low=0.0,
        high=reach,
        meaning="range of each ray from the AGV's middle, counter-clockwise",
    )
    distance = ObservationPart(
        name="distance",
        kind="goal_distance",
        unit="m",
        low=0.0,
        high=farthest,
        meaning="straight distance to the goal",
    )
    heading = ObservationPart(
        name="heading",
        kind="goal_heading",
        unit="rad",
        low=-math.pi,
        high=math.pi,
        meaning="angle from straight ahead to the goal, left positive",
    )
    forward = ObservationPart(
        name="speed", kind="forward_speed", unit="m/s", low=0.0, high=speed, meaning="forward"
    )
    yaw_rate = ObservationPart(
        name="yaw_rate",
        kind="yaw_rate",
        unit="rad/s",
        low=-turn,
        high=turn,
        meaning="left positive",
    )
    return PolicyContract(
        control_period=control_period,
        observation=in_a_row(ranges, distance, heading, forward, yaw_rate),
        action=action_rule(
            actions,
            kind="velocity",
            at_low=(0.0, -turn),
            at_high=(speed, turn),
            meaning="forward speed and yaw rate; numbers outside the bounds are cut to them",
        ),
        scan=ScanRule(
            first_angle=0.0,
            last_angle=2.0 * math.pi * (samples - 1) / samples,
            no_return=reach,
            too_near=0.0,
            farthest=reach,
            frame="base_link",
        ),
        goal_distance=goal_distance,
        time_limit=None if max_episode_steps is None else max_episode_steps * control_period,
        frames={"pose": "odom", "goal": "odom"},
    )
