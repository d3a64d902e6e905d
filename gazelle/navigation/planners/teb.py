"""``teb_local_planner/TebLocalPlannerROS``: timed elastic bands, for robots that steer as cars do."""

from __future__ import annotations

import math
from collections.abc import Sequence
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
from gazelle.navigation.planners.teb_cost import Band, BandCost
from gazelle.navigation.planners.teb_obstacles import BandObstacle, ObstacleDistances
from gazelle.navigation.planners.teb_search import BandSearch, BandTask
from gazelle.navigation.planners.teb_settings import TebFootprint, TebSettings

_NO_GRIDS: Final = np.zeros((4, 1, 1), np.int32)
_SLOW: Final = 0.02
_PATIENCE: Final = 5
"""A band is created again after this number of cycles below this speed [m/s]."""
_STILL: Final = 1e-3  # Speed below which a car's wheels cannot be turned to turn it [m/s]


@checked(Error, after=True)
class TebPlanner(PlanFollower):
    """Optimises poses and times to the goal, and commands the first velocity.

    Parameters: see `TebSettings`; those without effect here are `teb_settings.UNUSED`. Obstacles are the
    lethal cells of the local costmap, and `obstacles`.

    Attributes:
        settings: Parameters.
        footprint: Circles that stand for the robot.
        obstacles: Other obstacles, standing and moving, in the costmap's frame.
        vias: Points to pass in the costmap's frame, shape (n, 2), where the plan gives none.
        search: Bands of the last cycle.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values, period: float) -> None:
        super().__init__(name, costmap, parameters, period)
        self.settings = TebSettings.read(name, parameters)
        self.footprint = TebFootprint.read(parameters)
        self.obstacles: Sequence[BandObstacle] = ()
        self.vias: Floats = np.zeros((0, 2))
        self.search = BandSearch(self.settings, period)
        self.prune = True
        self._slow = 0

    def configure(self, settings: TebSettings) -> None:
        """Apply new settings while running."""
        self.settings = settings
        self.search.configure(settings)

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
        nearest = int(np.hypot(*(plan[:, :2] - np.array(pose[:2])).T).argmin())
        plan, whole = self._within_lookahead(plan[nearest:], goal)
        moving = [each for each in self.obstacles if s.include_dynamic_obstacles and each.moving]
        cost = BandCost(
            s,
            self.footprint,
            self._standing(),
            velocity,
            stops=not (s.free_goal_vel and whole),
            vias=self._vias(plan),
            obstacle_weight=s.weight_obstacle,
            moving=moving,
        )
        task = BandTask(pose, plan, cost, self.costmap.inscribed, whole, self._feasible)
        band = self.search.next(task, stalled=self._slow >= _PATIENCE)
        if self._slow >= _PATIENCE:
            self._slow = 0
        self.local_plan = None if band is None else band.poses.copy()
        if band is None:
            return None
        command = self._first_velocity(band)
        slow = math.hypot(command[0], command[1]) < _SLOW
        self._slow = self._slow + 1 if slow else 0
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

    def _vias(self, plan: Floats) -> Floats:
        """Return points of the plan that are ``global_plan_viapoint_sep`` apart."""
        apart = self.settings.global_plan_viapoint_sep
        if apart <= 0.0 or len(plan) < 2:
            return self.vias
        lengths = np.cumsum(np.hypot(*np.diff(plan[:, :2], axis=0).T))
        return plan[1:][np.diff(lengths // apart, prepend=0.0) > 0.0, :2]

    def _standing(self) -> ObstacleDistances:
        costmap, s = self.costmap, self.settings
        lethal = costmap.cells == LETHAL
        away = None
        if s.include_costmap_obstacles and lethal.any():
            away = np.sqrt(squared_distances(lethal.astype(np.uint8))) * costmap.resolution
        shapes = [
            each for each in self.obstacles if not (s.include_dynamic_obstacles and each.moving)
        ]
        return ObstacleDistances(away, costmap.origin, costmap.resolution, shapes)

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
        share = band.times[:count] / band.times[:count].sum()
        v, u, w = (float(each[:count] @ share) for each in band.velocities())
        if s.max_vel_y <= 0.0:
            u = 0.0
        bounded, aside, turning = self._bounded(v, u, w)
        if s.min_turning_radius > 0.0:
            # A car that is slowed down stays on its arc, and cannot turn more than its wheels.
            w *= bounded / v if abs(v) > _STILL else 1.0
            most = min(abs(bounded) / s.min_turning_radius, s.max_vel_theta)
            turning = min(max(w, -most), most)
        if s.cmd_angle_instead_rotvel:
            angle = (
                math.atan2(s.wheelbase * turning, abs(bounded)) if abs(bounded) > _STILL else 0.0
            )
            turning = math.copysign(1.0, bounded) * angle
        return bounded, aside, turning

    def _bounded(self, ahead: float, aside: float, turning: float) -> Velocity:
        """Return a velocity within the limits: each part, or all by the same factor."""
        s = self.settings
        most = s.max_vel_x if ahead > 0.0 else s.max_vel_x_backwards
        parts = (ahead, aside, turning)
        limits = (most, s.max_vel_y, s.max_vel_theta)
        shares = [
            min(1.0, limit / abs(part)) if part else 1.0
            for part, limit in zip(parts, limits, strict=True)
        ]
        if s.use_proportional_saturation:
            shares = [min(shares)] * 3
        v, u, w = (part * share for part, share in zip(parts, shares, strict=True))
        speed = math.hypot(v, u)
        slower = s.fastest / speed if s.max_vel_y > 0.0 and speed > s.fastest else 1.0
        return v * slower, u * slower, w
