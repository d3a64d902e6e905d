"""``teb_local_planner/TebLocalPlannerROS``: timed elastic bands, for robots that steer as cars do."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.costmap.values import LETHAL
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.following_plan import PlanFollower
from gazelle.navigation.planners.plugins import STOP, Values, Velocity
from gazelle.navigation.planners.rollout import TrajectoryRollout
from gazelle.navigation.planners.teb_band import (
    first_band,
    maneuvers,
    moved_on,
    optimised,
)
from gazelle.navigation.planners.teb_cost import Band, BandCost, ObstacleDistances
from gazelle.navigation.planners.teb_settings import TebFootprint, TebSettings

_NO_GRIDS: Final = np.zeros((4, 1, 1), np.int32)
_SLOW: Final = 0.02
_PATIENCE: Final = 5
"""A band is begun anew after so many cycles below this speed [m/s]."""
_STILL: Final = 1e-3  # Speed below which a car's wheels cannot be turned to turn it [m/s]


@checked(Error, after=True)
class TebPlanner(PlanFollower):
    """Optimises poses and times to the goal, and commands the first velocity.

    Parameters: see `TebSettings`; those without effect here are `teb_settings.UNUSED`. Obstacles are the
    lethal cells of the local costmap. One band is kept, on the side of obstacles where the global plan
    is: no bands of other homotopy classes are tried.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values, period: float) -> None:
        super().__init__(name, costmap, parameters, period)
        self.settings = TebSettings.read(name, parameters)
        self.footprint = TebFootprint.read(parameters)
        self.prune = True
        self._band: Band | None = None
        self._slow = 0

    def command(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> Velocity | None:
        """Return the velocity at the begin of the best band; None if that hits something."""
        s = self.settings
        plan = self.local(pose, to_local)
        if not len(plan):
            return None
        goal = self.goal(to_local)
        if self._at(pose, goal):
            self.local_plan = np.array([pose])
            return STOP
        plan, whole = self._within_lookahead(plan, goal)
        cost = BandCost(
            s,
            self.footprint,
            self._obstacles(),
            (velocity[0], velocity[2]),
            stops=not (s.free_goal_vel and whole),
            vias=self._vias(plan),
            obstacle_weight=s.weight_obstacle,
        )
        band = self._best(pose, plan, cost, whole=whole)
        self._band = band
        self.local_plan = None if band is None else band.poses.copy()
        if band is None:
            return None
        command = self._first_velocity(band)
        self._slow = self._slow + 1 if abs(command[0]) < _SLOW else 0
        return command

    def goal_reached(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> bool:
        """Return whether the robot is at the goal, and stands unless ``free_goal_vel``."""
        s = self.settings
        if not self.has_plan or not self._at(pose, self.goal(to_local)):
            return False
        stands = math.hypot(velocity[0], velocity[1]) <= s.trans_stopped_vel
        return s.free_goal_vel or (stands and abs(velocity[2]) <= s.theta_stopped_vel)

    def _at(self, pose: Pose2, goal: Pose2) -> bool:
        s = self.settings
        away = math.hypot(goal[0] - pose[0], goal[1] - pose[1])
        return away < s.xy_goal_tolerance and abs(wrapped(goal[2] - pose[2])) < s.yaw_goal_tolerance

    def _within_lookahead(self, plan: Floats, goal: Pose2) -> tuple[Floats, bool]:
        """Return the plan as far as it is looked at, and whether it ends at the goal."""
        lookahead = self.settings.max_global_plan_lookahead_dist
        lengths = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(plan[:, :2], axis=0).T))))
        count = len(plan)
        if lookahead > 0.0:
            count = max(int((lengths <= lookahead).sum()), 1)
        cut = plan[:count].copy()
        whole = math.hypot(cut[-1, 0] - goal[0], cut[-1, 1] - goal[1]) < 1e-6
        if not whole and count > 1 and self.settings.global_plan_overwrite_orientation:
            back = max(count - 4, 0)
            cut[-1, 2] = math.atan2(cut[-1, 1] - cut[back, 1], cut[-1, 0] - cut[back, 0])
        return cut, whole

    def _best(self, pose: Pose2, plan: Floats, cost: BandCost, *, whole: bool) -> Band | None:
        """Return the cheapest band that hits nothing at its begin; None if there is none.

        The band of the last cycle is kept, unless it has ended in a stand or the goal is another one.
        """
        goal = (float(plan[-1, 0]), float(plan[-1, 1]), float(plan[-1, 2]))
        stalled = self._slow >= _PATIENCE
        if self._band is not None and len(self._band.poses) > 2 and not stalled:
            x, y, _ = self._band.poses[-1]
            if math.hypot(goal[0] - x, goal[1] - y) < self.settings.force_reinit_new_goal_dist:
                band = self._improved(moved_on(self._band, pose, goal), cost)
                if self._feasible(band):
                    return band
        self._slow = 0
        begun = [first_band(plan, pose, self.settings)]
        if self.settings.min_turning_radius > 0.0 and (whole or stalled):
            begun += maneuvers(pose, goal, self.settings)
        bands = [self._improved(band, cost) for band in begun]
        return min(filter(self._feasible, bands), key=cost.of, default=None)

    def _improved(self, band: Band, cost: BandCost) -> Band:
        return optimised(band, cost) if self.settings.optimization_activate else band

    def _vias(self, plan: Floats) -> Floats:
        """Return points of the plan that are ``global_plan_viapoint_sep`` apart."""
        apart = self.settings.global_plan_viapoint_sep
        if apart <= 0.0 or len(plan) < 2:
            return np.zeros((0, 2))
        lengths = np.cumsum(np.hypot(*np.diff(plan[:, :2], axis=0).T))
        return plan[1:][np.diff(lengths // apart, prepend=0.0) > 0.0, :2]

    def _obstacles(self) -> ObstacleDistances:
        costmap = self.costmap
        lethal = costmap.cells == LETHAL
        if not self.settings.include_costmap_obstacles or not lethal.any():
            return ObstacleDistances(None, costmap.origin, costmap.resolution)
        away = np.sqrt(squared_distances(lethal.astype(np.uint8))) * costmap.resolution
        return ObstacleDistances(away, costmap.origin, costmap.resolution)

    def _feasible(self, band: Band) -> bool:
        """Return whether the robot's outline hits nothing at the first poses."""
        costmap = self.costmap
        grids = np.broadcast_to(_NO_GRIDS, (4, *costmap.cells.shape))
        rollout = TrajectoryRollout(
            costmap.cells,
            costmap.origin,
            costmap.resolution,
            costmap.footprint,
            np.ascontiguousarray(grids),
            np.zeros(6),
            0.0,
        )
        count = self.settings.feasibility_check_no_poses
        looked_at = band.poses[1:] if count < 0 else band.poses[1 : count + 1]
        return all(rollout.footprint_cost(*pose) >= 0.0 for pose in looked_at.tolist())

    def _first_velocity(self, band: Band) -> Velocity:
        """Return the velocity over the first intervals, within the limits."""
        s = self.settings
        count = min(max(s.control_look_ahead_poses, 1), len(band.times))
        speeds, turns = band.velocities()
        time = band.times[:count]
        v = float(speeds[:count] @ time / time.sum())
        w = float(turns[:count] @ time / time.sum())
        bounded = min(max(v, -s.max_vel_x_backwards), s.max_vel_x)
        if s.min_turning_radius > 0.0:
            # A car that is slowed down stays on its arc, and cannot turn more than its wheels.
            w *= bounded / v if abs(v) > _STILL else 1.0
            most = min(abs(bounded) / s.min_turning_radius, s.max_vel_theta)
        else:
            most = s.max_vel_theta
        w = min(max(w, -most), most)
        if s.cmd_angle_instead_rotvel:
            w = math.atan2(s.wheelbase * w, abs(bounded)) if abs(bounded) > _STILL else 0.0
            w = math.copysign(1.0, bounded) * w
        return bounded, 0.0, w
