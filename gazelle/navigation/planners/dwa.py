"""``dwa_local_planner/DWAPlannerROS``: the dynamic window approach."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.following_plan import PlanFollower
from gazelle.navigation.planners.oscillation import OscillationGuard
from gazelle.navigation.planners.plugins import Values, Velocity
from gazelle.navigation.planners.rollout import NO_MOTION, TrajectoryRollout, steps_of
from gazelle.navigation.planners.stop_rotate import StopRotate, VelocityLimits
from gazelle.navigation.planners.wavefront import grid_distances
from gazelle_ros.base.parameter_values import fields_of

_ROUNDING = 1e-4
"""By how much a velocity may be below its least, as in the original."""


@dataclass(frozen=True, slots=True)
class DwaSettings:
    """The planner's own parameters; names and defaults are those of ROS."""

    sim_time: float = 1.7
    sim_granularity: float = 0.025
    angular_sim_granularity: float = 0.1
    vx_samples: int = 3
    vy_samples: int = 10
    vth_samples: int = 20
    path_distance_bias: float = 0.6
    goal_distance_bias: float = 0.8
    occdist_scale: float = 0.01
    twirling_scale: float = 0.0
    forward_point_distance: float = 0.325
    oscillation_reset_dist: float = 0.05
    oscillation_reset_angle: float = 0.2
    use_dwa: bool = True
    prune_plan: bool = False

    @classmethod
    def read(cls, values: Values) -> DwaSettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind.
        """
        return cls(**fields_of(cls, values))


@checked(Error, after=True)
class DwaPlanner(PlanFollower):
    """Samples velocities that can be had within a period, and takes the best.

    Its parameters and their defaults are those of ``dwa_local_planner`` (noetic). Of the
    original's, ``stop_time_buffer``, ``scaling_speed`` and ``max_scaling_factor`` have no effect there
    either, since the scaled outline is not looked at.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values, period: float) -> None:
        super().__init__(name, costmap, parameters, period)
        self.settings = DwaSettings.read(parameters)
        self.limits = VelocityLimits.read(parameters)
        self.prune = self.settings.prune_plan
        self._stop = StopRotate(self.limits, period)
        self._guard = OscillationGuard(
            self.settings.oscillation_reset_dist, self.settings.oscillation_reset_angle
        )

    def configure(self, parameters: Values) -> None:
        """Set new parameters while running."""
        self.parameters = parameters
        self.settings = DwaSettings.read(parameters)
        self.limits = VelocityLimits.read(parameters)
        self._stop.limits = self.limits

    def set_plan(self, plan: Floats) -> bool:
        """Set a plan; flags against oscillation and a reached goal are cleared."""
        self._guard.reset()
        self._stop.reset()
        return super().set_plan(plan)

    def command(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> Velocity | None:
        """Return the best velocity; at the goal, stop and turn."""
        plan = self.local(pose, to_local)
        if not len(plan):
            return None
        goal = self.goal(to_local)
        if self._stop.at_position(pose, goal):
            self.local_plan = np.array([pose])
            rollout = self._rollout(pose, plan, goal)
            return self._stop.command(
                pose,
                velocity,
                goal,
                lambda command: self._fits(rollout, pose, velocity, command),
                lambda angle: rollout.can_turn(pose, angle, self.settings.angular_sim_granularity),
            )
        rollout = self._rollout(pose, plan, goal)
        chosen = self._best(rollout, pose, velocity, self._samples(velocity, pose, goal))
        if chosen is None:
            chosen = self._best(rollout, pose, velocity, self._turns_from_rest(velocity))
        if chosen is None:
            self.local_plan = None
            return None
        self._guard.update(pose, chosen, self.limits.min_vel_trans)
        self.local_plan = self._driven(pose, chosen)
        return float(chosen[0]), float(chosen[1]), float(chosen[2])

    def goal_reached(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> bool:
        """Return whether the robot stands at the goal."""
        return self.has_plan and self._stop.reached(pose, velocity, self.goal(to_local))

    def _rollout(self, pose: Pose2, plan: Floats, goal: Pose2) -> TrajectoryRollout:
        """Prepare the scoring of commands: the distances to plan and goal."""
        s, cell = self.settings, self.costmap.resolution
        ahead = s.forward_point_distance
        cells = self.cells_of(plan)
        to_goal = math.atan2(goal[1] - pose[1], goal[0] - pose[0])
        end = plan[-1, :2] + ahead * np.array([math.cos(to_goal), math.sin(to_goal)])
        front = np.vstack((plan[:-1, :2], end))
        costs = self.costmap.cells
        path = grid_distances(costs, cells)
        near = math.hypot(goal[0] - pose[0], goal[1] - pose[1]) <= ahead
        grids = np.stack(
            (
                path,
                grid_distances(costs, cells[-1:]),
                grid_distances(costs, self.cells_of(front)[-1:]),
                path,
            )
        )
        to_path, to_goal_bias = cell * s.path_distance_bias, cell * s.goal_distance_bias
        # Close to the goal there is nothing before it to align with.
        aligned = 0.0 if near else to_path
        weights = np.array(
            [to_path, to_goal_bias, to_goal_bias, aligned, s.occdist_scale, s.twirling_scale]
        )
        rollout = TrajectoryRollout(
            costs, self.costmap.origin, cell, self.costmap.footprint, grids, weights, ahead
        )
        if not s.use_dwa:
            acc = self.limits
            rollout.accelerate(np.array([acc.acc_lim_x, acc.acc_lim_y, acc.acc_lim_theta]))
        return rollout

    def _best(
        self, rollout: TrajectoryRollout, pose: Pose2, velocity: Velocity, commands: Floats
    ) -> Floats | None:
        """Return the command that costs least, shape (3,); None if all are out of the question."""
        costs = self._score(rollout, pose, velocity, commands)
        costs[self._guard.forbidden(commands)] = -5.0
        good = costs >= 0.0
        if not good.any():
            return None
        best: Floats = commands[int(np.where(good, costs, np.inf).argmin())]
        return best

    def _score(
        self, rollout: TrajectoryRollout, pose: Pose2, velocity: Velocity, commands: Floats
    ) -> Floats:
        s = self.settings
        commands = np.ascontiguousarray(commands, np.float64).reshape(-1, 3)
        steps = steps_of(commands, s.sim_time, s.sim_granularity, s.angular_sim_granularity)
        steps[self._too_slow_or_fast(commands)] = 0
        return rollout.judge(
            np.array(pose, np.float64), np.array(velocity, np.float64), commands, steps, s.sim_time
        )

    def _fits(
        self, rollout: TrajectoryRollout, pose: Pose2, velocity: Velocity, command: Floats
    ) -> bool:
        """Return whether a command hits nothing; negligible motion is allowed, as in the original."""
        cost = self._score(rollout, pose, velocity, command)[0]
        return bool(cost >= 0.0 or cost == NO_MOTION)

    def _turns_from_rest(self, velocity: Velocity) -> Floats:
        """Return turns on the spot at the least rate, shape (n, 3).

        They are used where that rate is too much for a cycle.

        A base with ``min_vel_theta`` more than ``acc_lim_theta`` reaches within a cycle has no
        way to turn on the spot from a stand. Where driving is out of the question, too, the original
        waits for recoveries; this planner does what its own turning at goals does, and commands
        the least rate all the same.
        """
        own = self.limits
        within = abs(velocity[2]) + own.acc_lim_theta * self.period
        if not within < own.min_vel_theta <= own.max_vel_theta:
            return np.zeros((0, 3))
        return np.array([[0.0, 0.0, -own.min_vel_theta], [0.0, 0.0, own.min_vel_theta]])

    def _too_slow_or_fast(self, commands: Floats) -> Any:
        """Return commands that are neither fast enough nor turn enough, or too fast."""
        own = self.limits
        speed, turn = np.hypot(commands[:, 0], commands[:, 1]), np.abs(commands[:, 2])
        slow = (own.min_vel_trans >= 0.0) & (speed + _ROUNDING < own.min_vel_trans)
        lazy = (own.min_vel_theta >= 0.0) & (turn + _ROUNDING < own.min_vel_theta)
        fast = (own.max_vel_trans >= 0.0) & (speed - _ROUNDING > own.max_vel_trans)
        return (slow & lazy) | fast

    def _samples(self, velocity: Velocity, pose: Pose2, goal: Pose2) -> Floats:
        """Return reachable velocities, on a lattice, shape (n, 3)."""
        own, s = self.limits, self.settings
        time = self.period if s.use_dwa else s.sim_time
        high_x, high_y = own.max_vel_x, own.max_vel_y
        low_x, low_y = own.min_vel_x, own.min_vel_y
        if not s.use_dwa:
            # It should be able to stop at the goal.
            away = math.hypot(goal[0] - pose[0], goal[1] - pose[1])
            high_x = max(min(high_x, away / s.sim_time), low_x)
            high_y = max(min(high_y, away / s.sim_time), low_y)
        ranges = (
            (low_x, high_x, own.acc_lim_x, s.vx_samples),
            (low_y, high_y, own.acc_lim_y, s.vy_samples),
            (-own.max_vel_theta, own.max_vel_theta, own.acc_lim_theta, s.vth_samples),
        )
        axes = [
            spread(max(low, now - acc * time), min(high, now + acc * time), count)
            for now, (low, high, acc, count) in zip(velocity, ranges, strict=True)
        ]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)

    def _driven(self, pose: Pose2, command: Floats) -> Floats:
        """Return the poses that a command leads through."""
        return driven(pose, command, self.settings.sim_time)


def spread(low: float, high: float, count: int) -> Floats:
    """Return a given number of velocities from the least to the greatest, including 0 if it is between."""
    if low >= high:
        return np.array([min(low, high) if low == high else high])
    values = np.linspace(low, high, max(count, 2))
    if low < 0.0 < high and not (values == 0.0).any():
        values = np.sort(np.append(values, 0.0))
    return values


def driven(pose: Pose2, command: Floats, duration: float, count: int = 20) -> Floats:
    """Return the poses that a constant command leads through, shape (count, 3)."""
    dt = duration / count
    headings = pose[2] + command[2] * dt * np.arange(count)
    cos, sin = np.cos(headings), np.sin(headings)
    x = pose[0] + dt * np.cumsum(command[0] * cos - command[1] * sin)
    y = pose[1] + dt * np.cumsum(command[0] * sin + command[1] * cos)
    return np.stack((x, y, [wrapped(each) for each in headings]), axis=1)
