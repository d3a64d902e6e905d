"""``base_local_planner/TrajectoryPlannerROS``: trajectory rollout, the planner before DWA."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.dwa import driven, spread
from gazelle.navigation.planners.following_plan import PlanFollower
from gazelle.navigation.planners.plugins import Values, Velocity
from gazelle.navigation.planners.rollout import TrajectoryRollout, steps_of
from gazelle.navigation.planners.stop_rotate import StopRotate, VelocityLimits
from gazelle.navigation.planners.wavefront import grid_distances
from gazelle_ros.base.parameter_values import fields_of


@dataclass(frozen=True, slots=True)
class TrajectorySettings:
    """The planner's parameters; names and defaults are those of ROS."""

    max_vel_x: float = 0.5
    min_vel_x: float = 0.1
    max_vel_theta: float = 1.0
    min_vel_theta: float = -1.0
    min_in_place_vel_theta: float = 0.4
    escape_vel: float = -0.1
    acc_lim_x: float = 2.5
    acc_lim_y: float = 2.5
    acc_lim_theta: float = 3.2
    sim_time: float = 1.0
    sim_granularity: float = 0.025
    angular_sim_granularity: float = 0.025
    vx_samples: int = 3
    vtheta_samples: int = 20
    pdist_scale: float = 0.6
    gdist_scale: float = 0.8
    occdist_scale: float = 0.01
    heading_lookahead: float = 0.325
    xy_goal_tolerance: float = 0.1
    yaw_goal_tolerance: float = 0.05
    meter_scoring: bool = False
    dwa: bool = True
    prune_plan: bool = True
    latch_xy_goal_tolerance: bool = False

    @classmethod
    def read(cls, values: Values) -> TrajectorySettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind.
        """
        return cls(**fields_of(cls, values))


class TrajectoryPlanner(PlanFollower):
    """Samples paths ahead, turns on the spot, and at last a way back, in this order.

    Parameters and scores are those of the original; not done is what it does for strafing
    (``holonomic_robot``, ``y_vels``) and ``heading_scoring``.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values, period: float) -> None:
        super().__init__(name, costmap, parameters, period)
        self.settings = TrajectorySettings.read(parameters)
        own = self.settings
        self.prune = own.prune_plan
        limits = VelocityLimits(
            max_vel_theta=own.max_vel_theta,
            min_vel_theta=own.min_in_place_vel_theta,
            acc_lim_x=own.acc_lim_x,
            acc_lim_y=own.acc_lim_y,
            acc_lim_theta=own.acc_lim_theta,
            xy_goal_tolerance=own.xy_goal_tolerance,
            yaw_goal_tolerance=own.yaw_goal_tolerance,
            latch_xy_goal_tolerance=own.latch_xy_goal_tolerance,
        )
        self._stop = StopRotate(limits, period)
        self._turned = 0

    def set_plan(self, plan: Floats) -> bool:
        """Set a plan."""
        self._stop.reset()
        return super().set_plan(plan)

    def goal_reached(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> bool:
        """Return whether the robot stands at the goal."""
        return self.has_plan and self._stop.reached(pose, velocity, self.goal(to_local))

    def command(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> Velocity | None:
        """Return the best velocity; at the goal, stop and turn."""
        plan = self.local(pose, to_local)
        if not len(plan):
            return None
        goal = self.goal(to_local)
        rollout, to_goal = self._rollout(plan)
        if self._stop.at_position(pose, goal):
            self.local_plan = np.array([pose])
            return self._stop.command(
                pose,
                velocity,
                goal,
                lambda command: bool(self._score(rollout, pose, velocity, command)[0] >= 0.0),
                lambda angle: rollout.can_turn(pose, angle, self.settings.angular_sim_granularity),
            )
        chosen = self._best(rollout, to_goal, pose, velocity)
        self.local_plan = None
        if chosen is None:
            return None
        self.local_plan = driven(pose, chosen, self.settings.sim_time)
        return float(chosen[0]), float(chosen[1]), float(chosen[2])

    def _rollout(self, plan: Floats) -> tuple[TrajectoryRollout, Any]:
        """Prepare the scoring of commands; return it with the distances to the goal."""
        s, costs = self.settings, self.costmap.cells
        cells = self.cells_of(plan)
        path, goal = grid_distances(costs, cells), grid_distances(costs, cells[-1:])
        scale = self.costmap.resolution if s.meter_scoring else 1.0
        weights = np.array(
            [scale * s.pdist_scale, scale * s.gdist_scale, 0.0, 0.0, s.occdist_scale, 0.0]
        )
        grids = np.stack((path, goal, goal, path))
        rollout = TrajectoryRollout(
            costs,
            self.costmap.origin,
            self.costmap.resolution,
            self.costmap.footprint,
            grids,
            weights,
            0.0,
        )
        rollout.accelerate(np.array([s.acc_lim_x, s.acc_lim_y, s.acc_lim_theta]))
        return rollout, goal

    def _score(
        self, rollout: TrajectoryRollout, pose: Pose2, velocity: Velocity, commands: Floats
    ) -> Floats:
        s = self.settings
        steps = steps_of(commands, s.sim_time, s.sim_granularity, s.angular_sim_granularity)
        steps = np.maximum(steps, 1).astype(np.int32)
        rows = np.ascontiguousarray(commands, np.float64)
        return rollout.judge(
            np.array(pose, np.float64), np.array(velocity, np.float64), rows, steps, s.sim_time
        )

    def _best(
        self, rollout: TrajectoryRollout, to_goal: Any, pose: Pose2, velocity: Velocity
    ) -> Floats | None:
        s = self.settings
        time = self.period if s.dwa else s.sim_time
        low = max(s.min_vel_x, velocity[0] - s.acc_lim_x * time)
        high = max(min(s.max_vel_x, velocity[0] + s.acc_lim_x * time), low)
        left = max(s.min_vel_theta, velocity[2] - s.acc_lim_theta * time)
        right = min(s.max_vel_theta, velocity[2] + s.acc_lim_theta * time)
        turns = spread(left, right, s.vtheta_samples)
        speeds = spread(low, high, s.vx_samples)
        ahead = np.stack(np.meshgrid(speeds, [0.0], turns, indexing="ij"), -1).reshape(-1, 3)
        costs = self._score(rollout, pose, velocity, ahead)
        best = _cheapest(ahead, costs)
        # A turn on the spot is as good as a path ahead that costs as much.
        most = math.inf if best is None else float(costs[costs >= 0.0].min())
        turn = self._on_the_spot(rollout, to_goal, pose, velocity, turns, most)
        if turn is not None:
            return turn
        if best is not None:
            self._turned = 0
            return best
        back = np.array([[s.escape_vel, 0.0, 0.0]])
        return back[0] if self._score(rollout, pose, velocity, back)[0] >= 0.0 else None

    def _on_the_spot(
        self,
        rollout: TrajectoryRollout,
        to_goal: Any,
        pose: Pose2,
        velocity: Velocity,
        turns: Floats,
        most: float,
    ) -> Floats | None:
        """Return the turn that looks best, by where a point before the robot then is."""
        s = self.settings
        least = s.min_in_place_vel_theta
        rates = np.where(turns > 0.0, np.maximum(turns, least), np.minimum(turns, -least))
        if self._turned:
            # It keeps its direction of turning, or it would turn to and fro.
            rates = rates[np.sign(rates) == self._turned]
        if not len(rates):
            return None
        commands = np.stack((0.0 * rates, 0.0 * rates, rates), axis=1)
        costs = self._score(rollout, pose, velocity, commands)
        headings = pose[2] + rates * s.sim_time
        x = pose[0] + s.heading_lookahead * np.cos(headings)
        y = pose[1] + s.heading_lookahead * np.sin(headings)
        side, (x0, y0) = self.costmap.resolution, self.costmap.origin
        rows, columns = self.costmap.cells.shape
        column = np.clip(np.floor((x - x0) / side).astype(int), 0, columns - 1)
        row = np.clip(np.floor((y - y0) / side).astype(int), 0, rows - 1)
        good = (costs >= 0.0) & (costs <= most)
        best = _cheapest(commands, np.where(good, to_goal[row, column], -1.0))
        if best is not None:
            self._turned = int(math.copysign(1.0, best[2]))
        return best


def _cheapest(commands: Floats, costs: Floats) -> Floats | None:
    """Return the command with the least cost that is not negative."""
    good = costs >= 0.0
    if not good.any():
        return None
    found: Floats = commands[int(np.where(good, costs, np.inf).argmin())]
    return found
