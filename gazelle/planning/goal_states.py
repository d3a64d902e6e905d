"""Positions that fulfil a goal: given, named, or found by inverse kinematics; and why there are none."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Indices
from gazelle.description import Box, Pose, Sphere
from gazelle.errors import PlanningError
from gazelle.kinematics.inverse import Aim, InverseKinematics
from gazelle.planning.constraints import (
    ConstraintSet,
    OrientationConstraint,
    PositionConstraint,
)
from gazelle.planning.outcomes import NoPlanError, PlanOutcome
from gazelle.planning.state_validity import StateValidity
from gazelle.streams import seed_of

Goal = Pose | str | Mapping[str, float] | ConstraintSet | ArrayLike

_ENOUGH = 4
"""Number of positions to look for; planners go to the one that is found first."""
_DRAWN = 10
"""Places within the tolerances of a goal that are tried."""
_ALTERNATIVES = 100
"""Parts of regions that are tried, one after the other."""


class GoalStates:
    """Finds valid positions of a group for goals.

    Args:
        validity: Of the group; requests start at its state.
        start: Positions of the group, shape (n,).
        link: Link of the poses; the group's tip if None.
        seed: Of what is drawn.
    """

    def __init__(
        self, validity: StateValidity, start: Floats, link: str | None = None, seed: int = 0
    ) -> None:
        self._validity, self._start = validity, start
        self._group, self._robot = validity.group, validity.scene.robot
        self._link, self._seed = link, seed

    def find(self, goal: Goal) -> Floats:
        """Return valid positions, shape (k, n).

        Continuous joints turn in the shorter direction from the start.

        Args:
            goal: A pose of the link in the robot's frame, the name of a state, positions by name or
                of all joints, or constraints.

        Raises:
            NoPlanError: There are none; the message names the obstacle.
            PlanningError: The goal names what is not there.
        """
        if isinstance(goal, Pose):
            link = self._group.tip if self._link is None else self._link
            return self._of_pose(link, "pose", [goal], ConstraintSet())
        if isinstance(goal, ConstraintSet):
            return self._of_constraints(goal)
        named = self._group.named(goal) if isinstance(goal, str) else goal
        return self._of_positions(self._group.positions(named, self._start))

    def _of_positions(self, target: Floats) -> Floats:
        """Return one goal if it is valid, else none."""
        near = self._start + self._group.difference(self._start, target)
        beyond = self._group.beyond(near)
        if beyond:
            raise NoPlanError(
                "the goal cannot be: " + "; ".join(beyond), PlanOutcome.INVALID_GOAL_CONSTRAINTS
            )
        if not self._validity(near):
            self._refuse([near])
        return near[None]

    def _of_constraints(self, goal: ConstraintSet) -> Floats:
        goal.check(self._robot)
        if not goal:
            raise NoPlanError("the goal has no constraints", PlanOutcome.INVALID_GOAL_CONSTRAINTS)
        links = {each.link for each in goal.positions}
        links |= {each.link for each in goal.orientations}
        if not links:
            return self._of_joints(goal)
        failure: NoPlanError | None = None
        for each in itertools.islice(goal.alternatives(), _ALTERNATIVES):
            try:
                if len(links) > 1:
                    return self._of_links(each, sorted(links))
                poses, aim = self._poses(each)
                return self._of_pose(next(iter(links)), aim, poses, each)
            except NoPlanError as error:
                failure = failure or error
        raise failure or NoPlanError(
            "the goal has no constraints", PlanOutcome.INVALID_GOAL_CONSTRAINTS
        )

    def _poses(self, goal: ConstraintSet) -> tuple[list[Pose], Aim]:
        """Return poses that fulfil constraints of one link, and the constrained parts."""
        random = np.random.default_rng(seed_of(self._seed) % 2**64)
        poses = [_drawn(goal, random, first=number == 0) for number in range(_DRAWN)]
        if goal.positions and goal.orientations:
            return poses, "pose"
        return poses, "position" if goal.positions else "orientation"

    def _of_links(self, goal: ConstraintSet, links: Sequence[str]) -> Floats:
        """Return positions with several links, each moved by joints of its own, at their poses."""
        found = [self._alone(goal, link, links) for link in links]
        good: list[Floats] = []
        bad: list[Floats] = []
        for parts in itertools.product(*found):
            state = self._validity.full(self._start)
            for columns, positions in parts:
                state[columns] = positions
            whole = state[self._group.columns]
            fits = not goal.violations(self._robot, self._validity.full(whole))
            (good if fits and self._validity(whole) else bad).append(whole)
            if len(good) >= _ENOUGH:
                break
        if not good:
            self._refuse(bad, goal)
        return np.array(good)

    def _alone(
        self, goal: ConstraintSet, link: str, links: Sequence[str]
    ) -> list[tuple[Indices, Floats]]:
        """Return positions of the joints that move only one of several links, by column."""
        moving = {each: self._moving(each) for each in links}
        shared = sorted(moving[link] & {*itertools.chain(*(moving[o] for o in links if o != link))})
        if shared:
            raise NoPlanError(
                f"the goal constrains {len(links)} links at once, {', '.join(links)}, which the joints "
                f"{', '.join(shared)} move together",
                PlanOutcome.INVALID_GOAL_CONSTRAINTS,
                "one of them has a pose; give the others as joint positions",
            )
        own = ConstraintSet(
            positions=tuple(each for each in goal.positions if each.link == link),
            orientations=tuple(each for each in goal.orientations if each.link == link),
        )
        group = self._robot.group_of(moving[link], f"{self._group.name} to {link}")
        poses, aim = self._poses(own)
        state, found = self._validity.full(self._start), list[tuple[Indices, Floats]]()

        def take(positions: Floats) -> bool:
            reached = state.copy()
            reached[group.columns] = positions
            if not own.violations(self._robot, reached):
                found.append((group.columns, positions.copy()))
            return len(found) >= _ENOUGH

        solver = InverseKinematics(self._robot, group, link, aim=aim, seed=self._seed)
        for pose in poses:
            solver.solve(pose, state, valid=take)
            if found:
                return found
        raise NoPlanError(self._why_not(link, aim, poses[0]), PlanOutcome.NO_IK_SOLUTION)

    def _moving(self, link: str) -> set[str]:
        """Return variables of the group that move a link."""
        return {
            each.name
            for each, column in zip(self._group.variables, self._group.columns, strict=True)
            if link in self._robot.moving([column])
        }

    def _of_joints(self, goal: ConstraintSet) -> Floats:
        """Return a goal of joints alone: the middle of each, within its limits."""
        own: dict[str, float] = {}
        for each in goal.joints:
            source, factor, offset = self._robot.leader(self._robot.column(each.joint))
            name = self._robot.names[source]
            if (
                name in self._group.names and factor != 0.0
            ):  # its target comes from a joint that mimics it
                own[name] = (each.position - offset) / factor
        own |= {
            each.joint: each.position for each in goal.joints if each.joint in self._group.names
        }
        target = np.clip(
            self._start
            + self._group.difference(self._start, self._group.positions(own, self._start)),
            self._group.lower,
            self._group.upper,
        )
        violated = goal.violations(self._robot, self._validity.full(target))
        if violated:
            raise NoPlanError(
                "the goal cannot be: " + "; ".join(violated), PlanOutcome.INVALID_GOAL_CONSTRAINTS
            )
        return self._of_positions(target)

    def _of_pose(self, link: str, aim: Aim, poses: Sequence[Pose], goal: ConstraintSet) -> Floats:
        """Return positions with a link at one of some poses."""
        solver = InverseKinematics(self._robot, self._group, link, aim=aim, seed=self._seed)
        good: list[Floats] = []
        bad: list[Floats] = []

        def take(positions: Floats) -> bool:
            fits = not goal.violations(self._robot, self._validity.full(positions))
            if not fits or not self._validity(positions):
                bad.append(positions)
            elif not any(np.allclose(positions, other, atol=1e-3) for other in good):
                good.append(positions)
            return len(good) >= _ENOUGH

        state = self._validity.full(self._start)
        for pose in poses:
            solver.solve(pose, state, valid=take)
            if good:
                return np.array(good)
        if bad:
            self._refuse(bad, goal)
        raise NoPlanError(self._why_not(link, aim, poses[0]), PlanOutcome.NO_IK_SOLUTION)

    def _refuse(self, positions: Sequence[Floats], goal: ConstraintSet | None = None) -> None:
        """Raise an error with the reasons against positions that would fulfil the goal.

        Raises:
            NoPlanError: Always.
        """
        group, scene, robot = self._group, self._validity.scene, self._robot
        pairs: Counter[str] = Counter()
        broken: Counter[str] = Counter()
        deepest: dict[str, float] = {}
        for each in positions:
            state = self._validity.full(each)
            for contact in scene.contacts(state, group):
                pair = f"'{contact.first}' and '{contact.second}'"
                pairs[pair] += 1
                deepest[pair] = max(deepest.get(pair, 0.0), contact.depth)
            broken.update(self._validity.constraints.violations(robot, state))
            broken.update(goal.violations(robot, state) if goal is not None else [])
        texts = [
            f"{pair} collide, {deepest[pair] * 1e3:.1f} mm deep" for pair, _ in pairs.most_common(3)
        ]
        texts += [text for text, _ in broken.most_common(3)]
        number = len(positions)
        among = "" if number == 1 else f" with any of {number} positions of the joints"
        outcome = (
            PlanOutcome.GOAL_IN_COLLISION if pairs else PlanOutcome.GOAL_VIOLATES_PATH_CONSTRAINTS
        )
        raise NoPlanError(f"the goal cannot be{among}: " + "; ".join(texts), outcome)

    def _why_not(self, link: str, aim: Aim, pose: Pose) -> str:
        """Return an explanation which part of a pose cannot be reached."""
        x, y, z = pose.position
        place = f"({x:.3f}, {y:.3f}, {z:.3f})"
        state = self._validity.full(self._start)
        if aim != "orientation" and not self._reaches(link, "position", pose, state):
            return f"no positions of the joints bring '{link}' to {place}: it is out of reach"
        angles = ", ".join(f"{angle:.3f}" for angle in pose.rpy)
        if aim == "position":
            return f"no positions of the joints bring '{link}' to {place}"
        if not self._reaches(link, "orientation", pose, state):
            return f"no positions of the joints turn '{link}' to roll, pitch, yaw ({angles})"
        return (
            f"'{link}' reaches {place}, but not with its orientation there: "
            f"roll, pitch, yaw ({angles})"
        )

    def _reaches(self, link: str, aim: Aim, pose: Pose, state: Floats) -> bool:
        solver = InverseKinematics(self._robot, self._group, link, aim=aim, attempts=20)
        return solver.solve(pose, state) is not None


def _drawn(goal: ConstraintSet, random: np.random.Generator, *, first: bool) -> Pose:
    """Return a pose that fulfils constraints: first the middle of them, then random ones."""
    position: tuple[float, ...] = (0.0, 0.0, 0.0)
    turned = Pose()
    if goal.orientations:
        turned = _turned(goal.orientations[0], random, first=first)
    if goal.positions:
        position = _placed(goal.positions[0], random, first=first)
        point = turned.rotate(goal.positions[0].point)
        if any(goal.positions[0].point) and not goal.orientations:
            raise PlanningError(
                "a goal for a point beside a link's origin needs an orientation of the link"
            )
        position = tuple(p - q for p, q in zip(position, point, strict=True))
    return Pose.from_quaternion(position, turned.quaternion)


def _turned(goal: OrientationConstraint, random: np.random.Generator, *, first: bool) -> Pose:
    target = Pose.from_quaternion((0, 0, 0), goal.orientation.quaternion)
    if first:
        return target
    a, b, c = (random.uniform(-1.0, 1.0, 3) * np.minimum(goal.tolerances, np.pi)).tolist()
    return target * Pose(roll=a) * Pose(pitch=b) * Pose(yaw=c)


def _placed(
    goal: PositionConstraint, random: np.random.Generator, *, first: bool
) -> tuple[float, ...]:
    if first:
        return goal.pose.position
    draw = random.uniform(-0.5, 0.5, 3)
    region = goal.region
    if isinstance(region, Box):
        local = draw * region.size
    elif isinstance(region, Sphere):
        local = draw * (2.0 * region.radius / np.sqrt(3.0))
    else:
        across = 2.0 * region.radius / np.sqrt(2.0)
        local = draw * (across, across, region.length)
    return goal.pose.apply(local.tolist())
