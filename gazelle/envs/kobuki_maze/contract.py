"""The contract of policies of frobs_rl's tasks for Kobuki."""

from __future__ import annotations

import math

import gymnasium as gym

from gazelle.description import Lidar
from gazelle.envs.contract import (
    ObservationPart,
    PolicyContract,
    ScanRule,
    action_rule,
    in_a_row,
)
from gazelle.envs.kobuki_maze.rules import CONTROL_PERIOD, LASER_MAX, KobukiRules


def kobuki_contract(
    rules: KobukiRules, lidar: Lidar, actions: gym.Space[gym.spaces.Box], steps: int | None
) -> PolicyContract:
    """Return the contract of a policy of these tasks.

    Args:
        rules: Of the task.
        lidar: Of the robot.
        actions: The task's space.
        steps: Control steps until an episode is cut off, if it is.
    """
    fan = lidar.horizontal
    parts = [
        ObservationPart(
            name="distance", kind="goal_distance", unit="m", low=0.0, high=rules.farthest
        ),
        ObservationPart(
            name="heading", kind="goal_heading", unit="rad", low=-math.pi, high=math.pi
        ),
    ]
    if rules.sees_place:
        parts.append(
            ObservationPart(
                name="place",
                size=5,
                low=(-10.5, -13.5, -math.pi, -10.5, -13.5),
                high=(5.5, 13.5, math.pi, 5.5, 13.5),
                meaning="x, y [m] and yaw [rad] of the base, x and y of the goal [m]",
            )
        )
    if rules.sees_ranges:
        scan = ObservationPart(
            name="ranges", kind="scan", size=fan.samples, unit="m", low=0.0, high=LASER_MAX
        )
        parts.append(scan)
    return PolicyContract(
        control_period=CONTROL_PERIOD,
        observation=in_a_row(*parts),
        action=action_rule(
            actions,
            kind="velocity",
            at_low=(-rules.speed, -rules.speed),
            at_high=(rules.speed, rules.speed),
            meaning="forward speed and yaw rate; numbers outside the bounds are cut to them",
        ),
        scan=ScanRule(
            first_angle=fan.min_angle,
            last_angle=fan.max_angle,
            no_return=LASER_MAX,
            too_near=0.0,
            farthest=LASER_MAX,
        ),
        goal_distance=rules.tolerance,
        collision_range=rules.collision_range,
        time_limit=None if steps is None else steps * CONTROL_PERIOD,
        frames={"pose": "odom", "goal": "odom"},
    )
