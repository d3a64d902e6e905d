"""Rewards and ends of openai_ros' ParrotDroneGoto, on arrays of what is observed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.envs.goal_rules import goal_reward, is_at, is_inside

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightRules:
    """Parameters of the task; the defaults are the published ones.

    Attributes:
        goal: Goal of the flight [m]; ends do not depend on its height.
        low: Lower edges of the work space along x, y and z [m].
        high: Upper edges, which belong to it [m].
        steepest: Largest roll and pitch [rad].
        nearest: Smallest range of the sonar without an end [m].
        end_tolerance: Distance from the goal along x and y that ends an episode [m].
        success_tolerance: Distance from it at an end that is a success [m].
        closer_reward: Reward of a step that comes nearer to the goal.
        end_reward: Reward of a success; other ends get minus that.
    """

    goal: Point = (9.0, 4.0, 2.0)
    low: Point = (-1.0, -1.0, -1.0)
    high: Point = (10.0, 5.0, 3.0)
    steepest: tuple[float, float] = (1.57, 1.57)
    nearest: float = 0.5
    end_tolerance: float = 1.0
    success_tolerance: float = 0.5
    closer_reward: float = 10.0
    end_reward: float = 200.0


@dataclass(frozen=True, slots=True)
class FlightEnds:
    """Reasons for which episodes end, each of shape (n,).

    Attributes:
        outside: The drone left its work space.
        crashed: The sonar sees something too near, or the drone has flipped.
        arrived: True if it is so near to the goal that the episode ends.
        succeeded: True if it is so near that this is a success.
    """

    outside: Bools
    crashed: Bools
    arrived: Bools
    succeeded: Bools

    @property
    def over(self) -> Bools:
        """True where the episode ends."""
        return self.outside | self.crashed | self.arrived


def ends_of(rules: FlightRules, seen: Floats) -> FlightEnds:
    """Return why episodes end, of observations, shape (n, 7): x, y, z, roll, pitch, yaw, sonar."""
    place = seen[:, :3]
    return FlightEnds(
        ~is_inside(place, rules.low, rules.high),
        has_flipped(rules, seen[:, 3:5]) | (seen[:, 6] < rules.nearest),
        is_at(place, rules.goal, rules.end_tolerance),
        is_at(place, rules.goal, rules.success_tolerance),
    )


def has_flipped(rules: FlightRules, tilt: Floats) -> Bools:
    """Return whether roll and pitch [rad], shape (n, 2), are too large."""
    return ~is_inside(tilt, -np.array(rules.steepest), rules.steepest)


def reward_of(rules: FlightRules, *, over: Bools, succeeded: Bools, closer: Bools) -> Floats:
    """Return the reward of a step, shape (n,), by whether it came closer to the goal as observed."""
    step = np.where(closer, rules.closer_reward, 0.0)
    return goal_reward(over, succeeded, rules.end_reward, step)
