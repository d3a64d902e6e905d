"""Constraints of a goal or of all states of a plan: joints, positions and orientations of links."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Box, Cylinder, Pose, Sphere, Vector3
from gazelle.errors import PlanningError
from gazelle.kinematics.robot_model import RobotModel

Region = Box | Sphere | Cylinder


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class JointConstraint:
    """A joint near a position.

    Attributes:
        joint: Its variable.
        position: [m or rad].
        above: Tolerance above that.
        below: Tolerance below that.
    """

    joint: str
    position: float
    above: float = 1e-4
    below: float = 1e-4

    def violation(self, robot: RobotModel, state: Floats) -> str | None:
        """Return the violation by a state, shape (variables,), as text; None if there is none."""
        position, offset = self._offset(robot, state)
        if -self.below - _ROUNDING <= offset <= self.above + _ROUNDING:
            return None
        return (
            f"joint '{self.joint}' at {position:.4f} is not within "
            f"[{self.position - self.below:.4f}, {self.position + self.above:.4f}]"
        )

    def distance(self, robot: RobotModel, state: Floats) -> float:
        """Return the distance of the joint from its position [m or rad], in a state, shape (variables,)."""
        return abs(self._offset(robot, state)[1])

    def _offset(self, robot: RobotModel, state: Floats) -> tuple[float, float]:
        """Return the joint's position, and its offset above the constraint's position."""
        column = robot.column(self.joint)
        # What is written in the column of a joint that follows another does not count.
        follows = robot.variables[column].mimics
        position = float((robot.complete(state) if follows else state)[column])
        offset = position - self.position
        if robot.variables[column].endless:
            offset = math.remainder(offset, 2.0 * math.pi)
        return position, offset


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class PositionConstraint:
    """A point of a link inside of a region.

    Attributes:
        link: Its name.
        region: A box, sphere or cylinder.
        pose: Of the region, in the robot's frame.
        point: In the link's frame [m].
        others: More parts of the region, with their poses; the point may be in any of them.
    """

    link: str
    region: Region
    pose: Pose
    point: Vector3 = (0.0, 0.0, 0.0)
    others: tuple[tuple[Region, Pose], ...] = ()

    @property
    def parts(self) -> tuple[PositionConstraint, ...]:
        """A constraint for each part of the region, any of which will do."""
        alone = replace(self, others=())
        return (alone, *(replace(alone, region=part, pose=pose) for part, pose in self.others))

    def distance(self, robot: RobotModel, state: Floats) -> float:
        """Return the point's distance from the centre of the region [m], in a state, shape (variables,).

        Of several parts it is the first that the point is in, else the last, as in MoveIt.
        """
        point = robot.pose(state, self.link).apply(self.point)
        places = ((self.region, self.pose), *self.others)
        inside = [pose for part, pose in places if _away(part, pose, point) <= _ROUNDING]
        middle = (inside[0] if inside else places[-1][1]).position
        return math.dist(middle, point)

    def violation(self, robot: RobotModel, state: Floats) -> str | None:
        """Return the violation by a state, shape (variables,), as text; None if there is none."""
        point = robot.pose(state, self.link).apply(self.point)
        places = ((self.region, self.pose), *self.others)
        away = min(_away(part, pose, point) for part, pose in places)
        if away <= _ROUNDING:
            return None
        return f"link '{self.link}' is {away:.4f} m outside of its region"


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class OrientationConstraint:
    """A target orientation of a link, within angles about three axes.

    Attributes:
        link: Its name.
        orientation: In the robot's frame; the position of the pose does not count.
        tolerances: About x, y and z [rad].
        measure: Kind of the angles: ``euler`` angles about the turned x, y and z axes, or a
            ``rotation vector``; both of the turn that is missing, in the target frame.
    """

    link: str
    orientation: Pose
    tolerances: Vector3
    measure: Literal["euler", "rotation vector"] = "euler"

    def violation(self, robot: RobotModel, state: Floats) -> str | None:
        """Return the violation by a state, shape (variables,), as text; None if there is none."""
        angles = self._angles(robot, state)
        for axis, angle, limit in zip("xyz", angles, self.tolerances, strict=True):
            if abs(angle) > limit + _ROUNDING:
                return (
                    f"link '{self.link}' is turned about {axis} by {abs(angle):.4f} rad, "
                    f"more than {limit:.4f}"
                )
        return None

    def distance(self, robot: RobotModel, state: Floats) -> float:
        """Return the sum of a link's angles off the constraint [rad].

        The state has shape (variables,).
        """
        return float(sum(map(abs, self._angles(robot, state))))

    def _angles(self, robot: RobotModel, state: Floats) -> tuple[float, float, float]:
        target = self.orientation.matrix()[:3, :3]
        turn = target.T @ robot.forward(state, self.link)[:3, :3]
        return _euler(turn) if self.measure == "euler" else rotation_vector(turn)


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class ConstraintSet:
    """Constraints that all hold together.

    Attributes:
        joints: Of joints.
        positions: Of points.
        orientations: Of links.
        name: For people.
    """

    joints: tuple[JointConstraint, ...] = ()
    positions: tuple[PositionConstraint, ...] = ()
    orientations: tuple[OrientationConstraint, ...] = ()
    name: str = field(default="", compare=False)

    def check(self, robot: RobotModel) -> None:
        """Check that links and joints exist.

        Raises:
            PlanningError: One is not, or a tolerance is below zero.
        """
        for joint in self.joints:
            robot.column(joint.joint)
            if joint.above < 0.0 or joint.below < 0.0:
                raise PlanningError(f"a tolerance of joint '{joint.joint}' is below zero")
        for position in self.positions:
            robot.link(position.link)
        for orientation in self.orientations:
            robot.link(orientation.link)
            if min(orientation.tolerances) < 0.0:
                raise PlanningError(f"a tolerance of link '{orientation.link}' is below zero")

    @property
    def all(self) -> tuple[JointConstraint | PositionConstraint | OrientationConstraint, ...]:
        """Constraints of joints, then of points, then of links."""
        return (*self.joints, *self.positions, *self.orientations)

    def violations(self, robot: RobotModel, state: Floats) -> list[str]:
        """Return the violations by a state, shape (variables,), a text each."""
        return [text for part in self.all if (text := part.violation(robot, state)) is not None]

    def alternatives(self) -> Iterator[ConstraintSet]:
        """Yield constraints with regions of one part each; any of them fulfils this set."""
        for positions in itertools.product(*(each.parts for each in self.positions)):
            yield replace(self, positions=positions)

    def __bool__(self) -> bool:
        return bool(self.joints or self.positions or self.orientations)


_ROUNDING = 1e-9


def _away(region: Region, pose: Pose, point: Vector3) -> float:
    """Return the distance of a point outside of a region at a pose [m]."""
    return _outside(region, pose.inverse().apply(point))


def _outside(region: Region, point: Sequence[float]) -> float:
    """Return the distance of a point of a region's frame outside of it [m]."""
    if isinstance(region, Sphere):
        return math.hypot(*point) - region.radius
    if isinstance(region, Cylinder):
        radial = math.hypot(point[0], point[1]) - region.radius
        return max(radial, abs(point[2]) - region.length / 2.0)
    return max(abs(p) - size / 2.0 for p, size in zip(point, region.size, strict=True))


def _euler(r: Floats) -> tuple[float, float, float]:
    """Return angles a, b, c of R = Rx(a) Ry(b) Rz(c)."""
    sine = max(-1.0, min(1.0, float(r[0, 2])))
    if abs(sine) > 1.0 - 1e-12:
        return (math.atan2(r[2, 1], r[1, 1]), math.asin(sine), 0.0)
    return (math.atan2(-r[1, 2], r[2, 2]), math.asin(sine), math.atan2(-r[0, 1], r[0, 0]))


def rotation_vector(r: Floats) -> tuple[float, float, float]:
    """Return axis times angle [rad] of a rotation matrix, shape (3, 3)."""
    x, y, z, w = Pose.from_matrix(r).quaternion
    sine = math.sqrt(x * x + y * y + z * z)
    if sine < 1e-12:
        return (0.0, 0.0, 0.0)
    angle = 2.0 * math.atan2(sine, abs(w)) / sine * (1.0 if w >= 0.0 else -1.0)
    return (angle * x, angle * y, angle * z)


@checked(PlanningError)
def goal_of_pose(
    link: str, pose: Pose, distance: float = 1e-4, angle: float = 1e-3
) -> ConstraintSet:
    """Return a link at a pose in the robot's frame, within a distance [m] and angles [rad]."""
    at = Pose.from_quaternion(pose.position)
    return ConstraintSet(
        positions=(PositionConstraint(link, Sphere(distance), at),),
        orientations=(OrientationConstraint(link, pose, (angle, angle, angle), "rotation vector"),),
    )


def nearest_on(constraints: ConstraintSet, robot: RobotModel, state: Floats) -> list[Pose]:
    """Return the nearest allowed pose of each orientation constraint's link."""
    made = []
    for each in constraints.orientations:
        here = robot.pose(state, each.link)
        turn = each.orientation.matrix()[:3, :3].T @ here.matrix()[:3, :3]
        limits = np.array(each.tolerances)
        if each.measure == "euler":
            a, b, c = np.clip(_euler(turn), -limits, limits).tolist()
            kept = Pose(roll=a) * Pose(pitch=b) * Pose(yaw=c)
        else:
            vector = np.clip(rotation_vector(turn), -limits, limits)
            length = float(np.linalg.norm(vector))
            scale = math.sin(length / 2.0) / length if length > 0.0 else 0.0
            kept = Pose.from_quaternion((0, 0, 0), (*(scale * vector), math.cos(length / 2.0)))
        target = Pose.from_quaternion((0, 0, 0), each.orientation.quaternion) * kept
        made.append(Pose.exactly(here.position, target.quaternion))
    return made
