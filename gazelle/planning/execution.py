"""Trajectories in execution: sent to a robot's trajectory controllers, and how that ends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.control import Goal as ControlGoal
from gazelle.control import GoalState
from gazelle.control.values import (
    JointTrajectory,
    TrajectoryGoal,
    TrajectoryPoint,
)
from gazelle.errors import PlanningError
from gazelle.planning.motion_planner import MotionPlan
from gazelle.planning.outcomes import PlanOutcome
from gazelle.simulation.robot import Robot

DURATION_SCALING = 1.1
"""Of a trajectory's duration, after which it has taken too long (MoveIt's default)."""
DURATION_MARGIN = 0.5
"""Additional time [s]."""
_ACTION = "follow_joint_trajectory"
_STEP = 0.01


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class ExecutionReport:
    """Result of executing a trajectory.

    Attributes:
        outcome: ``SUCCESS``, ``CONTROL_FAILED``, ``TIMED_OUT`` or ``PREEMPTED``.
        message: Error of a controller; empty on success.
        seconds: Simulated time that it took [s].
    """

    outcome: PlanOutcome
    message: str
    seconds: float

    def __bool__(self) -> bool:
        return self.outcome is PlanOutcome.SUCCESS


@checked(PlanningError)
class Execution:
    """A trajectory that controllers follow.

    Args:
        robot: Robot that moves.
        goals: By name of the controller.
        duration: Of the trajectory [s].
    """

    def __init__(
        self, robot: Robot, goals: Mapping[str, ControlGoal[TrajectoryGoal]], duration: float
    ) -> None:
        self._robot, self._goals = robot, dict(goals)
        self._limit = duration * DURATION_SCALING + DURATION_MARGIN
        self._begun = robot.simulation.time
        self._late = False

    @property
    def done(self) -> bool:
        """True if all controllers have ended."""
        return all(goal.done for goal in self._goals.values())

    def cancel(self) -> None:
        """Stop where it is."""
        for goal in self._goals.values():
            goal.cancel()

    def run(self) -> ExecutionReport:
        """Step the simulation until it is done, or takes too long and is stopped."""
        simulation = self._robot.simulation
        while not self.done:
            if simulation.time - self._begun > self._limit:
                self._late = True
                self.cancel()
                break
            if self._failed():
                self.cancel()
                break
            simulation.run(_STEP)
        return self.report()

    def wait(self, timeout: float | None = None) -> ExecutionReport:
        """Wait, on the wall's clock, while another thread steps the simulation.

        Args:
            timeout: At most [s]; then it is stopped.
        """
        for goal in self._goals.values():
            if not goal.wait(timeout):
                self._late = True
                self.cancel()
        return self.report()

    def report(self) -> ExecutionReport:
        """Return its result, or its present state."""
        seconds = self._robot.simulation.time - self._begun
        if self._late:
            text = f"it took longer than {self._limit:.2f} s, and was stopped"
            return ExecutionReport(PlanOutcome.TIMED_OUT, text, seconds)
        failed = self._failed()
        if failed is not None:
            name, goal = failed
            outcome = PlanOutcome.CONTROL_FAILED
            if goal.state in (GoalState.PREEMPTED, GoalState.RECALLED):
                outcome = PlanOutcome.PREEMPTED
            message = (
                goal.text or getattr(goal.result, "error_string", "") or goal.state.name.lower()
            )
            return ExecutionReport(outcome, f"controller '{name}': {message}", seconds)
        return ExecutionReport(PlanOutcome.SUCCESS, "", seconds)

    def _failed(self) -> tuple[str, ControlGoal[TrajectoryGoal]] | None:
        for name, goal in self._goals.items():
            if goal.done and goal.state is not GoalState.SUCCEEDED:
                return name, goal
        return None


def trajectory_controllers(robot: Robot) -> dict[str, tuple[str, ...]]:
    """Return joints of each running controller that follows trajectories, by its name."""
    found = {}
    for each in robot.controllers.loaded:
        if each.state == "running" and _ACTION in each.controller.actions:
            claimed = each.info.claimed.values()
            found[each.controller.name] = tuple(
                dict.fromkeys(joint for joints in claimed for joint in joints)
            )
    return found


def begin_execution(robot: Robot, plan: MotionPlan, world: int) -> Execution:
    """Send a plan to the controllers of its joints.

    Joints of such a controller that the plan does not move are held where they are.

    Raises:
        PlanningError: No running controllers move exactly these joints, or one refuses.
    """
    controllers = choose_controllers(trajectory_controllers(robot), plan.names)
    goals: dict[str, ControlGoal[TrajectoryGoal]] = {}
    for name, joints in controllers.items():
        value = TrajectoryGoal(_trajectory(robot, plan, joints, world))
        goal = robot.controllers[name].actions[_ACTION].send(value, np.array([world]))
        if goal.state is GoalState.REJECTED:
            for other in goals.values():
                other.cancel()
            message = goal.text or getattr(goal.result, "error_string", "")
            raise PlanningError(f"controller '{name}' refused the trajectory: {message}")
        goals[name] = goal
    return Execution(robot, goals, plan.trajectory.duration)


def choose_controllers(
    known: Mapping[str, tuple[str, ...]], required: tuple[str, ...]
) -> dict[str, tuple[str, ...]]:
    """Return controllers that together move some joints: those with the fewest others first."""
    left = set(required)
    order = sorted(known.items(), key=lambda item: (len({*item[1]} - {*required}), -len(item[1])))
    chosen: dict[str, tuple[str, ...]] = {}
    for name, joints in order:
        if left & {*joints} and not any({*joints} & {*other} for other in chosen.values()):
            chosen[name] = joints
            left -= {*joints}
    if left:
        raise PlanningError(
            "no running trajectory controller moves " + ", ".join(sorted(left)),
            hint="load and start one: robot.controllers.load(name, {'type': "
            "'position_controllers/JointTrajectoryController', 'joints': [...]})",
        )
    return chosen


def _trajectory(
    robot: Robot, plan: MotionPlan, joints: tuple[str, ...], world: int
) -> JointTrajectory:
    """Return the part of a plan for some joints; others stay."""
    timed = plan.trajectory
    count = len(timed.times)
    positions = np.zeros((count, len(joints)))
    velocities, accelerations = np.zeros_like(positions), np.zeros_like(positions)
    for column, joint in enumerate(joints):
        if joint in plan.names:
            own = plan.names.index(joint)
            positions[:, column] = timed.positions[:, own]
            velocities[:, column] = timed.velocities[:, own]
            accelerations[:, column] = timed.accelerations[:, own]
        else:
            positions[:, column] = robot.joints[joint].positions(np.array([world]))[0, 0]
    points = tuple(
        TrajectoryPoint(time, tuple(p), tuple(v), tuple(a))
        for time, p, v, a in zip(
            timed.times.tolist(),
            positions.tolist(),
            velocities.tolist(),
            accelerations.tolist(),
            strict=True,
        )
    )
    return JointTrajectory(joints, points)
