"""Plans to take an object and to put it down: moves to and fro, with the gripper's part between them.

Stages and their names are those of MoveIt's pick and place: the gripper opens (``pre_grasp``), the arm goes
to where it can approach (``plan``), approaches straight, the gripper closes (``grasp``), and the hand retreats
straight with the object. To put it down, the gripper opens (``release``) after the approach.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.errors import PlanningError, did_you_mean
from gazelle.kinematics.inverse import InverseKinematics
from gazelle.kinematics.joint_group import JointModelGroup
from gazelle.planning.constraints import ConstraintSet
from gazelle.planning.grasps import Grasp, GripperTranslation, PlaceLocation
from gazelle.planning.manipulation_plan import (
    ContactRules,
    ManipulationPlan,
    ManipulationStage,
    reversed_plan,
    turned_plan,
)
from gazelle.planning.motion_planner import MotionPlan, MotionPlanner, PlanOptions
from gazelle.planning.outcomes import NoPlanError, PlanOutcome
from gazelle.planning.scene import PlanningScene
from gazelle.planning.state_validity import StateValidity

_RESTING = 0.003
"""Largest depth of an object in its support [m]."""
_TRIES = 12
"""Postures of the arm that are tried for one grasp."""


@checked(PlanningError)
class PickPlacePlanner:
    """Plans for a group with a gripper at its end.

    Args:
        scene: With the object; it stays as it is.
        group: The arm.
        effector: Name of the end effector; the group's one if empty.
        options: Planning options.

    Raises:
        PlanningError: The group has no such end effector.
    """

    def __init__(
        self,
        scene: PlanningScene,
        group: JointModelGroup,
        effector: str = "",
        options: PlanOptions | None = None,
    ) -> None:
        self._scene, self._group, self._robot = scene, group, scene.robot
        known = {each.name: each for each in group.effectors}
        if effector not in known and (effector or len(known) != 1):
            wrong = f"no end effector '{effector}'" if effector else "not one end effector"
            raise PlanningError(
                f"the group '{group.name}' has {wrong}", hint=did_you_mean(effector, known)
            )
        chosen = known[effector] if effector else next(iter(known.values()))
        self._link = chosen.parent_link
        self._hand = frozenset(scene.robot.group(chosen.group).links)
        self._options = options or PlanOptions()

    def pick(
        self,
        name: str,
        grasps: Sequence[Grasp],
        *,
        start: Floats | None = None,
        rules: ContactRules | None = None,
        constraints: ConstraintSet | None = None,
    ) -> ManipulationPlan:
        """Return a plan to pick up an object of the scene.

        Args:
            name: Of the object.
            grasps: Of which one is taken, better ones first.
            start: Of all variables; the scene's state if None. Shape (variables,).
            rules: Contact rules.
            constraints: Constraints until the approach.

        Raises:
            NoPlanError: No grasp can be done; the message has a reason for each kind.
        """
        if name not in self._scene.objects:
            raise NoPlanError(
                f"there is no object '{name}' in the scene",
                PlanOutcome.INVALID_OBJECT_NAME,
                did_you_mean(name, self._scene.objects),
            )
        begun, rules = time.monotonic(), rules or ContactRules()
        state = self._scene.state.copy() if start is None else np.array(start, np.float64)

        def attempt(number: int) -> ManipulationPlan:
            stages = self._take(name, grasps[number], state, rules, constraints, begun)
            return self._made(name, stages, number, rules, begun)

        return self._first(attempt, [each.quality for each in grasps], "grasp", begun)

    def place(
        self,
        name: str,
        places: Sequence[PlaceLocation],
        *,
        start: Floats | None = None,
        rules: ContactRules | None = None,
        constraints: ConstraintSet | None = None,
    ) -> ManipulationPlan:
        """Return a plan to place an attached object; see ``pick``.

        Raises:
            NoPlanError: It can be put down at none of the places, or is not held.
        """
        if name not in self._scene.attached:
            raise NoPlanError(
                f"no object '{name}' is held",
                PlanOutcome.INVALID_OBJECT_NAME,
                did_you_mean(name, self._scene.attached),
            )
        begun, rules = time.monotonic(), rules or ContactRules()
        state = self._scene.state.copy() if start is None else np.array(start, np.float64)

        def attempt(number: int) -> ManipulationPlan:
            stages = self._put(name, places[number], state, rules, constraints, begun)
            return self._made(name, stages, number, rules, begun)

        return self._first(attempt, [each.quality for each in places], "place", begun)

    # -- one after another ---------------------------------------------------------------

    def _first(
        self,
        attempt: Callable[[int], ManipulationPlan],
        quality: Sequence[float],
        what: str,
        begun: float,
    ) -> ManipulationPlan:
        """Return the first feasible plan, best candidates first."""
        if not quality:
            raise NoPlanError(f"no {what} is given", PlanOutcome.INVALID_GOAL_CONSTRAINTS)
        why: dict[str, PlanOutcome] = {}
        for number in sorted(range(len(quality)), key=lambda each: -quality[each]):
            try:
                return attempt(number)
            except NoPlanError as error:
                why.setdefault(error.message, error.outcome)
            if time.monotonic() - begun > self._options.time:
                why.setdefault("the time was up", PlanOutcome.TIMED_OUT)
                break
        raise NoPlanError(
            f"none of {len(quality)} {what}s is feasible: " + "; ".join([*why][:3]),
            next(iter(why.values())),
        )

    def _made(
        self,
        name: str,
        stages: Iterable[ManipulationStage],
        number: int,
        rules: ContactRules,
        begun: float,
    ) -> ManipulationPlan:
        touch = self._hand | {*rules.touch_links}
        seconds = time.monotonic() - begun
        return ManipulationPlan(name, tuple(stages), number, self._link, touch, seconds)

    # -- taking --------------------------------------------------------------------------

    def _take(
        self,
        name: str,
        grasp: Grasp,
        start: Floats,
        rules: ContactRules,
        constraints: ConstraintSet | None,
        begun: float,
    ) -> list[ManipulationStage]:
        opened = self._with(start, grasp.open)
        near = self._near(name, opened, rules, grasp.touches)

        def after(there: Floats) -> MotionPlan:
            """Return the retreat with the object."""
            held = near.copy()
            held.state = self._with(there, grasp.closed)
            held.attach(name, self._link, self._hand | {*rules.touch_links})
            self._let_rest(held, name, rules)
            return self._straight(held, held.state, grasp.retreat, 1.0, "lift it")

        target = self._tip_pose(grasp.pose, grasp.link, start)
        free = self._scene.copy()
        free.state = opened
        to, approach, retreat = self._plan_moves(
            target, grasp.approach, free, near, after, constraints, begun
        )
        return [
            *_posed("pre_grasp", grasp.open),
            ManipulationStage("plan", to),
            ManipulationStage("approach", approach),
            ManipulationStage("grasp", posture=grasp.closed, effort=grasp.effort, then="attach"),
            ManipulationStage("retreat", retreat),
        ]

    # -- putting down --------------------------------------------------------------------

    def _put(
        self,
        name: str,
        place: PlaceLocation,
        start: Floats,
        rules: ContactRules,
        constraints: ConstraintSet | None,
        begun: float,
    ) -> list[ManipulationStage]:
        held = self._scene.attached[name]
        target = place.pose
        if not place.of_tip:
            in_tip = self._tip_pose(Pose(), held.link, start).inverse() * held.object.pose
            target = place.pose * in_tip.inverse()
        near = self._near(name, start, rules, place.touches)

        def after(there: Floats) -> MotionPlan:
            """Return the retreat without the object."""
            left = near.copy()
            left.state = there
            left.detach(name)
            left.state = self._with(there, place.open)
            return self._straight(left, left.state, place.retreat, 1.0, "leave it")

        free = self._scene.copy()
        free.state = start
        moves = self._plan_moves(
            target, place.approach, free, near, after, constraints, begun, name, rules
        )
        to, approach, retreat = moves
        return [
            ManipulationStage("plan", to),
            ManipulationStage("approach", approach),
            ManipulationStage("release", posture=place.open, then="detach"),
            ManipulationStage("retreat", retreat),
        ]

    # -- parts ---------------------------------------------------------------------------

    def _plan_moves(
        self,
        target: Pose,
        translation: GripperTranslation,
        free: PlanningScene,
        near: PlanningScene,
        after: Callable[[Floats], MotionPlan],
        constraints: ConstraintSet | None,
        begun: float,
        held: str = "",
        rules: ContactRules | None = None,
    ) -> tuple[MotionPlan, MotionPlan, MotionPlan]:
        """Return plans to the approach, along it, and back.

        With the first feasible posture of the arm.
        """
        state, why = near.state.copy(), list[NoPlanError]()
        found: list[tuple[MotionPlan, MotionPlan, MotionPlan]] = []
        validity = [StateValidity(near, self._group, state)]

        def judge(positions: Floats) -> bool:
            there = state.copy()
            there[self._group.columns] = positions
            try:
                scene = near
                if held and rules is not None:
                    scene = near.copy()
                    scene.state = there
                    self._let_rest(scene, held, rules)
                    validity[0] = StateValidity(scene, self._group, state)
                _check_valid(validity[0], positions)
                back = self._straight(scene, there, translation, -1.0, "come near")
                retreat = after(there)
                approach = reversed_plan(back)
                left = self._options.time - (time.monotonic() - begun)
                options = replace(self._options, time=max(left, 0.2))
                planner = MotionPlanner(free, self._group, options)
                to = planner.plan(approach.points[0], constraints=constraints)
            except NoPlanError as error:
                why.append(error)
                late = time.monotonic() - begun > self._options.time
                return late or len(why) >= _TRIES
            turns = to.points[-1] - approach.points[0]  # whole ones, of endless joints
            found.append((to, turned_plan(approach, turns), turned_plan(retreat, turns)))
            return True

        solver = InverseKinematics(self._robot, self._group, self._link, seed=self._options.seed)
        solver.solve(target, state, valid=judge)
        if found:
            return found[0]
        if why:
            raise why[0]
        x, y, z = target.position
        raise NoPlanError(
            f"no positions of the joints bring '{self._link}' to ({x:.3f}, {y:.3f}, {z:.3f}) so turned",
            PlanOutcome.NO_IK_SOLUTION,
        )

    def _straight(
        self,
        scene: PlanningScene,
        state: Floats,
        translation: GripperTranslation,
        sign: float,
        what: str,
    ) -> MotionPlan:
        """Return a straight path of the tip from a state.

        Raises:
            NoPlanError: It ends too soon.
        """
        here = self._robot.pose(state, self._link)
        axes = self._robot.pose(state, translation.frame) if translation.frame else Pose()
        unit = axes.rotate(translation.unit)
        x, y, z = (
            p + sign * translation.desired * u for p, u in zip(here.position, unit, strict=True)
        )
        planner = MotionPlanner(scene, self._group, self._options)
        end = Pose.from_quaternion((x, y, z), here.quaternion)
        plan, path = planner.follow([end], start=state, link=self._link)
        if path.fraction * translation.desired < translation.minimum - 1e-9:
            raise NoPlanError(
                f"it cannot {what} straight for more than {path.fraction * translation.desired:.3f} m: "
                f"{path.reason}",
                PlanOutcome.PLANNING_FAILED,
            )
        return plan

    def _near(
        self, name: str, state: Floats, rules: ContactRules, touches: Sequence[str]
    ) -> PlanningScene:
        """Return the scene in which the hand may touch the object, and its allowed neighbours."""
        scene = self._scene.copy()
        scene.state = state.copy()
        beside = [*rules.touches, *touches]
        if rules.hand_on_support and rules.support:
            beside.append(rules.support)
        allowed = scene.allowed
        for link in self._hand | {self._link}:
            for other in (name, *beside):
                allowed.set_pair(link, other, allowed=True)
        scene.allowed = allowed
        return scene

    def _let_rest(self, scene: PlanningScene, name: str, rules: ContactRules) -> None:
        """Allow an attached object to touch its support, in the scene's state."""
        if rules.support:
            scene.allow(name, rules.support)
            return
        for contact in scene.contacts():
            pair = {contact.first, contact.second}
            other = next(iter(pair - {name}), "")
            if name in pair and other in scene.objects and contact.depth < _RESTING:
                scene.allow(name, other)

    def _tip_pose(self, pose: Pose, link: str, state: Floats) -> Pose:
        """Return the pose of the tip when a link, fixed to it, is at a pose."""
        if not link or link == self._link:
            return pose
        apart = self._robot.pose(state, link).inverse() * self._robot.pose(state, self._link)
        return pose * apart

    def _with(self, state: Floats, posture: Mapping[str, float]) -> Floats:
        made = state.copy()
        for name, position in posture.items():
            made[self._robot.column(name)] = position
        return self._robot.complete(made)


def _check_valid(validity: StateValidity, positions: Floats) -> None:
    """Check that positions are valid.

    Raises:
        NoPlanError: They are not.
    """
    if not validity(positions):
        text = "; ".join(validity.reasons(positions))
        raise NoPlanError(text, PlanOutcome.GOAL_IN_COLLISION)


def _posed(name: str, posture: Mapping[str, float]) -> list[ManipulationStage]:
    return [ManipulationStage(name, posture=posture)] if posture else []
