"""Choice among several plans, and limits on the speed of a link."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from gazelle.array_types import Floats
from gazelle.kinematics import JointModelGroup, RobotModel
from gazelle.planning import (
    ConstraintSet,
    MotionPlan,
    MotionPlanner,
    NoPlanError,
    PlanningScene,
    PlanOptions,
)

_STRAIGHT = 2


def shortest_plan(
    scene: PlanningScene,
    group: JointModelGroup,
    goal: ConstraintSet,
    start: Floats,
    held: ConstraintSet | None,
    options: PlanOptions,
    *,
    attempts: int,
) -> MotionPlan:
    """Plan several times, each time from another seed; the shortest way of the joints counts.

    One that goes straight is not tried again.

    Args:
        scene: Planning scene.
        group: Group of the joints that move.
        goal: Goal.
        start: Of all variables, shape (variables,).
        held: Constraints all along.
        options: Planning options; their time is that of all attempts together.
        attempts: Number of attempts; once if it is not above one.

    Raises:
        NoPlanError: There is none, and why.
    """
    until = time.monotonic() + options.time
    best = MotionPlanner(scene, group, options).plan(goal, start=start, constraints=held)
    for number in range(1, attempts):
        left = until - time.monotonic()
        if len(best.points) <= _STRAIGHT or left <= 0.0:
            break
        tried = replace(options, seed=options.seed + number, time=left)
        try:
            found = MotionPlanner(scene, group, tried).plan(goal, start=start, constraints=held)
        except NoPlanError:
            break  # the time is up
        if _length(found) < _length(best):
            best = found
    return replace(best, seconds=options.time - max(until - time.monotonic(), 0.0))


def _length(plan: MotionPlan) -> float:
    return float(plan.group.distance(plan.points[:-1], plan.points[1:]).sum())


def slowed(plan: MotionPlan, robot: RobotModel, link: str, speed: float) -> MotionPlan:
    """Return a plan slowed down so that a link keeps its speed limit.

    Args:
        plan: The plan.
        robot: Its robot.
        link: Link of the speed.
        speed: Its greatest speed [m/s]; any if it is not above zero.

    Raises:
        PlanningError: There is no such link.
    """
    timed = plan.trajectory
    if not speed > 0.0 or len(timed.times) < _STRAIGHT:
        return plan
    states = np.tile(plan.start, (len(timed.times), 1))
    states[:, plan.group.columns] = timed.positions
    states = robot.complete(states)
    moving = np.zeros_like(states)
    moving[:, plan.group.columns] = timed.velocities
    rates = robot.jacobian(states, link)[:, :3] @ moving[:, :, None]
    points = robot.forward(states, link)[:, :3, 3]
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    fastest = max(
        float(np.linalg.norm(rates[:, :, 0], axis=1).max()),
        float((lengths / np.diff(timed.times)).max()),
    )
    if fastest <= speed:
        return plan
    return replace(plan, trajectory=timed.slower(fastest / speed))
