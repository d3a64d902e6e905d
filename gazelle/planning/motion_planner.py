"""Plans for a group of joints: a goal, a path, fewer corners, and when to be where."""

from __future__ import annotations

import functools
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.errors import PlanningError
from gazelle.kinematics.inverse import InverseKinematics
from gazelle.kinematics.joint_group import JointModelGroup
from gazelle.planning import ompl_planners
from gazelle.planning.cartesian_path import CartesianPath, CartesianPlanner, JumpLimits
from gazelle.planning.constraints import ConstraintSet, nearest_on
from gazelle.planning.goal_states import Goal, GoalStates
from gazelle.planning.outcomes import NoPlanError, PlanOutcome
from gazelle.planning.planner_names import planner_of
from gazelle.planning.rrt_connect import rrt_connect
from gazelle.planning.scene import PlanningScene
from gazelle.planning.shortcuts import shorten
from gazelle.planning.state_validity import LONGEST_SEGMENT, StateValidity
from gazelle.planning.time_parameterization import (
    PathLimits,
    TimeAlgorithm,
    TimedPath,
    parameterize,
)
from gazelle.streams import seed_of

_TOLERANCES = (0.1, 0.03, 0.01, 0.003, 0.001)
"""Tolerances of rounded corners, tried until the result is collision-free."""
_FINER = 10.0
"""By how much closer the states of the result are checked than those of the search."""
START_SLACK = 0.05
"""Largest violation of limits by a start, which is moved onto them (MoveIt's
start_state_max_bounds_error).
"""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class PlanOptions:
    """Options for planning.

    Attributes:
        planner: By a name of MoveIt's configurations; RRTConnect if empty.
        time: To plan, at most [s].
        velocity: Factor of the joints' velocity limits, within (0, 1].
        acceleration: Factor of their acceleration limits, within (0, 1].
        timing: Time parameterization of the path.
        seed: The same one gives the same plan.
        segment: Distance of states that are checked along a motion, as a fraction of the extent.
        edge: Longest edge of the planner's tree; as the planner likes if zero.
        use_ompl: Whether OMPL plans; if None, where it is installed.
    """

    planner: str = ""
    time: float = 5.0
    velocity: float = 1.0
    acceleration: float = 1.0
    timing: TimeAlgorithm = "time optimal"
    seed: int = 0
    segment: float = LONGEST_SEGMENT
    edge: float = 0.0
    use_ompl: bool | None = None


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class MotionPlan:
    """A trajectory of a group.

    Attributes:
        group: Group of the plan.
        start: Of all variables, where it begins, shape (variables,).
        points: Corners of the path, shape (m, n).
        trajectory: Trajectory of the group's joints.
        seconds: Planning time [s of wall time].
    """

    group: JointModelGroup
    start: Floats
    points: Floats
    trajectory: TimedPath
    seconds: float

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the joints, columns of the trajectory."""
        return self.group.names

    @property
    def end(self) -> Floats:
        """End state of all variables, shape (variables,)."""
        state = self.start.copy()
        state[self.group.columns] = self.points[-1]
        return state


@checked(PlanningError)
class MotionPlanner:
    """Plans motions of a group in a scene.

    Args:
        scene: Planning scene.
        group: Group of the joints.
        options: Planning options.

    Raises:
        PlanningError: There is no such planner.
    """

    def __init__(
        self, scene: PlanningScene, group: JointModelGroup, options: PlanOptions | None = None
    ) -> None:
        self.scene, self.group = scene, group
        self.options = options or PlanOptions()
        if not self.options.time > 0.0 or not self.options.segment > 0.0:
            raise PlanningError("planning time and segment length must be above zero")
        self._planner = planner_of(self.options.planner)
        limits = PathLimits(group.max_velocity, group.max_acceleration)
        self._turners: dict[str, InverseKinematics] = {}
        self._limits = limits.scaled(self.options.velocity, self.options.acceleration)

    def plan(
        self,
        goal: Goal,
        *,
        start: ArrayLike | None = None,
        link: str | None = None,
        constraints: ConstraintSet | None = None,
    ) -> MotionPlan:
        """Return a trajectory from a state to a goal.

        Args:
            goal: A pose of the link in the robot's frame, the name of a state of the group, positions
                by joint or of all joints, or constraints.
            start: Of all variables; the scene's state if None. Shape (variables,).
            link: Link of a pose; the group's tip if None.
            constraints: Constraints along the path.

        Raises:
            NoPlanError: There is none, and why.
            PlanningError: The goal or the constraints name what is not there.
        """
        begun = time.monotonic()
        state, validity = self._begin(start, constraints)
        here = state[self.group.columns]
        goals = GoalStates(validity, here, link, self.options.seed).find(goal)
        until = begun + self.options.time
        for attempt in range(1000):
            points = self._search(here, goals, validity, until, attempt)
            timed = self._timed(points, validity)
            if timed is not None:
                return MotionPlan(self.group, state, points, timed, time.monotonic() - begun)
            validity.resolution /= 2.0
            if time.monotonic() > until:
                break
        raise NoPlanError(
            f"no trajectory free of collisions was found in {self.options.time:g} s",
            PlanOutcome.INVALID_MOTION_PLAN,
        )

    def follow(
        self,
        poses: Sequence[Pose],
        *,
        max_step: float = 0.01,
        start: ArrayLike | None = None,
        link: str | None = None,
        jumps: JumpLimits | None = None,
        avoid_collisions: bool = True,
        constraints: ConstraintSet | None = None,
    ) -> tuple[MotionPlan, CartesianPath]:
        """Return a trajectory along straight paths of a link, as far as it can go.

        Args:
            poses: One after another, in the robot's frame.
            max_step: Longest step [m]; turns are in steps of 3.5 times as many radians.
            start: Of all variables; the scene's state if None. Shape (variables,).
            link: Link on a straight path; the group's tip if None.
            jumps: Largest jumps of joints, at which it is cut off.
            avoid_collisions: Whether it ends where it would collide.
            constraints: Constraints along the path.

        Returns:
            The trajectory of what can be done, its fraction of the path, and the reason.

        Raises:
            NoPlanError: It cannot begin.
            PlanningError: The step is not above zero, or a link is not there.
        """
        begun = time.monotonic()
        state = self._given(start)
        validity = StateValidity(self.scene, self.group, state, constraints, self.options.segment)
        solver = InverseKinematics(self.scene.robot, self.group, link, attempts=1)

        def valid(positions: Floats) -> bool:
            if avoid_collisions:
                return validity(positions)
            full = validity.full(positions)
            return not validity.constraints.violations(self.scene.robot, full)

        found = CartesianPlanner(solver, state, max_step, valid, validity.reasons).follow(
            poses, jumps
        )
        timed = parameterize(found.points, self._limits, "iterative parabolic")
        if self.options.timing == "time optimal":
            timed = parameterize(found.points, self._limits, tolerance=1e-3)
        return MotionPlan(self.group, state, found.points, timed, time.monotonic() - begun), found

    def _given(self, start: ArrayLike | None) -> Floats:
        state = np.array(self.scene.state if start is None else start, np.float64)
        if state.shape != self.scene.state.shape or not np.isfinite(state).all():
            raise NoPlanError(
                f"a start has {len(self.scene.state)} finite positions, not the shape {state.shape}",
                PlanOutcome.INVALID_ROBOT_STATE,
            )
        return state

    def _begin(
        self, start: ArrayLike | None, constraints: ConstraintSet | None
    ) -> tuple[Floats, StateValidity]:
        """Return the start within limits, and the check of states.

        Raises:
            NoPlanError: The start is invalid.
        """
        state = self._given(start)
        if constraints is not None:
            constraints.check(self.scene.robot)
        here = state[self.group.columns]
        beyond = self.group.beyond(here, START_SLACK)
        if beyond:
            text = "the start cannot be: " + "; ".join(beyond)
            raise NoPlanError(text, PlanOutcome.START_STATE_INVALID)
        state[self.group.columns] = np.clip(here, self.group.lower, self.group.upper)
        validity = StateValidity(self.scene, self.group, state, constraints, self.options.segment)
        if not validity(state[self.group.columns]):
            contacts = self.scene.contacts(state, self.group)
            outcome = PlanOutcome.START_STATE_VIOLATES_PATH_CONSTRAINTS
            if contacts:
                outcome = PlanOutcome.START_STATE_IN_COLLISION
            texts = validity.reasons(state[self.group.columns])
            raise NoPlanError("the start cannot be: " + "; ".join(texts), outcome)
        return state, validity

    def _search(
        self, here: Floats, goals: Floats, validity: StateValidity, until: float, attempt: int
    ) -> Floats:
        """Return a short path to one of the goals.

        Raises:
            NoPlanError: None was found in time.
        """
        seed = self.options.seed + 7919 * attempt
        random = np.random.default_rng(seed_of(seed) % 2**64)
        found = next((goal for goal in goals if validity.motion(here, goal)), None)
        if found is not None:
            return np.array([here, found])
        path = self._searched(here, goals, validity, until, seed)
        if path is None:
            raise NoPlanError(
                f"{self._planner} found no path to the goal in {self.options.time:g} s "
                f"({validity.checks} states checked); the goal itself is free",
                PlanOutcome.TIMED_OUT,
                "allow more time, or check the obstacles",
            )
        return shorten(path, validity, random, until)

    def _searched(
        self, here: Floats, goals: Floats, validity: StateValidity, until: float, seed: int
    ) -> Floats | None:
        options = self.options
        use = ompl_planners.is_installed() if options.use_ompl is None else options.use_ompl
        constrained = bool(validity.constraints)
        if use and not constrained:
            return ompl_planners.plan_with_ompl(
                here, goals, validity, self._planner, seed=seed, until=until, edge=options.edge
            )
        project = None
        if validity.constraints.orientations:
            project = functools.partial(self._project, validity)
        random = np.random.default_rng(seed_of(seed) % 2**64)
        return rrt_connect(
            here, goals, validity, random, until=until, project=project, edge=options.edge
        )

    def _project(self, validity: StateValidity, positions: Floats) -> Floats | None:
        """Return positions nearby with links turned to fulfil orientation constraints."""
        robot = self.scene.robot
        state = validity.full(positions)
        nearest = nearest_on(validity.constraints, robot, state)
        for each, pose in zip(validity.constraints.orientations, nearest, strict=True):
            if each.violation(robot, state) is None:
                continue
            found = self._turner(each.link).solve(pose, state)
            if found is None:
                return None
            state[self.group.columns] = found
        projected: Floats = state[self.group.columns]
        return projected

    def _turner(self, link: str) -> InverseKinematics:
        if link not in self._turners:
            self._turners[link] = InverseKinematics(
                self.scene.robot, self.group, link, aim="orientation", attempts=1
            )
        return self._turners[link]

    def _timed(self, points: Floats, validity: StateValidity) -> TimedPath | None:
        """Return times for a path with corners rounded off; None if that collides."""
        timing = self.options.timing
        if timing != "time optimal":
            timed = parameterize(points, self._limits, timing)
            fine = validity.resolution / _FINER
            return timed if validity.path(timed.positions, fine) else None
        for tolerance in _TOLERANCES:
            timed = parameterize(points, self._limits, tolerance=tolerance)
            if validity.path(timed.positions, validity.resolution / _FINER):
                return timed
        return None
