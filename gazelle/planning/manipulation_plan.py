"""Stages of a plan to take an object, or to put it down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import PlanningError
from gazelle.planning.motion_planner import MotionPlan
from gazelle.planning.time_parameterization import TimedPath


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class ManipulationStage:
    """A part of a plan: the arm moves, or the gripper.

    Attributes:
        name: As in MoveIt: ``pre_grasp``, ``plan``, ``approach``, ``grasp``, ``release``, ``retreat``.
        motion: Of the arm.
        posture: Posture of the gripper; empty if the arm moves.
        effort: Largest one of the gripper; its controller's if zero.
        then: Change of the scene after the stage.
    """

    name: str
    motion: MotionPlan | None = None
    posture: Mapping[str, float] = field(default_factory=dict)
    effort: float = 0.0
    then: Literal["", "attach", "detach"] = ""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class ManipulationPlan:
    """A plan to take an object, or to put it down.

    Attributes:
        object: The object.
        stages: One after another.
        choice: Index of the chosen grasp or place.
        link: Link that holds the object.
        touch_links: Links that it may touch then.
        seconds: Planning time [s of wall time].
    """

    object: str
    stages: tuple[ManipulationStage, ...]
    choice: int
    link: str
    touch_links: frozenset[str]
    seconds: float


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class ContactRules:
    """Contacts that are allowed while objects are taken and put down.

    Attributes:
        support: Support of the object, which may touch it. If empty, the current contacts.
        hand_on_support: Whether the hand may touch that, too.
        touch_links: Links that the object may touch when it is held, beside the hand's.
        touches: Links and objects that the hand may touch.
    """

    support: str = ""
    hand_on_support: bool = False
    touch_links: Sequence[str] = ()
    touches: Sequence[str] = ()


def reversed_plan(plan: MotionPlan) -> MotionPlan:
    """Return the reversed plan, as fast."""
    timed = plan.trajectory
    back = TimedPath(
        timed.times[-1] - timed.times[::-1],
        timed.positions[::-1].copy(),
        -timed.velocities[::-1],
        timed.accelerations[::-1].copy(),
    )
    start = plan.end
    return MotionPlan(plan.group, start, plan.points[::-1].copy(), back, plan.seconds)


def turned_plan(plan: MotionPlan, turns: Floats) -> MotionPlan:
    """Return a plan with some joints shifted by full turns."""
    whole = np.round(turns / (2.0 * np.pi)) * 2.0 * np.pi * plan.group.endless
    if not whole.any():
        return plan
    timed = replace(plan.trajectory, positions=plan.trajectory.positions + whole)
    start = plan.start.copy()
    start[plan.group.columns] += whole
    return replace(plan, start=start, points=plan.points + whole, trajectory=timed)
