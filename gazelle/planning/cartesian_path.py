"""Straight paths of a link through poses, as far as the arm can follow.

The rules are MoveIt's: steps of ``max_step`` metres and 3.5 times as many radians; between two steps
the link is at most a millimetre and a hundredth of a radian off the straight path, or the path ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.errors import PlanningError
from gazelle.kinematics.inverse import InverseKinematics
from gazelle.planning.constraints import rotation_vector
from gazelle.planning.limits import checked_poses, checked_steps

DEVIATION = 0.001
"""Greatest distance from the straight path [m]."""
TURN = 0.01
"""Greatest deviation in rotation [rad]."""
_TURN_PER_METRE = 3.5
_HALVINGS = 5
_FLOOR = 1e-5


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class CartesianPath:
    """The part of a straight path that an arm can follow.

    Attributes:
        points: Positions of the group's joints, shape (m, n).
        fraction: Of the path, 0 to 1.
        reason: Reason of an early end; empty otherwise.
    """

    points: Floats
    fraction: float
    reason: str


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class JumpLimits:
    """Limits of joint motion between two steps; infinite for no limit.

    Attributes:
        factor: Times the mean of all steps, as MoveIt's ``jump_threshold``.
        revolute: [rad].
        prismatic: [m].
    """

    factor: float = math.inf
    revolute: float = math.inf
    prismatic: float = math.inf


class CartesianPlanner:
    """Follows straight paths with one link.

    Args:
        kinematics: Of the link; begins where the last step ended.
        state: Of all variables, at the start, shape (variables,).
        max_step: Longest step [m].
        valid: Predicate of positions of the group, shape (n,).
        reasons: Reasons why positions are not valid.

    Raises:
        PlanningError: The step is not above zero.
    """

    def __init__(
        self,
        kinematics: InverseKinematics,
        state: Floats,
        max_step: float,
        valid: Callable[[Floats], bool],
        reasons: Callable[[Floats], list[str]],
    ) -> None:
        if not max_step > 0.0:
            raise PlanningError(
                f"the step of a Cartesian path must be above zero, not {max_step!r}"
            )
        self._ik, self._step = kinematics, max_step
        self._valid, self._reasons = valid, reasons
        self._state = np.array(state, np.float64)
        self._columns = kinematics.group.columns
        self._why = ""

    def follow(self, poses: Sequence[Pose], jumps: JumpLimits | None = None) -> CartesianPath:
        """Return a path of the link through poses in the robot's frame, from its present one.

        Args:
            poses: One after another.
            jumps: Largest jumps of joints, at which it is cut off.

        Raises:
            PlanningError: There are no poses, one is not finite, or the path is too long.
        """
        poses = checked_poses(poses)
        points = [self._state[self._columns].copy()]
        here = self._pose(points[0])
        segments = [_steps(first, second, self._step) for first, second in _pairs(here, poses)]
        total = sum(len(segment) for segment in segments)
        done = 0
        before = here
        for segment in segments:
            for pose in segment:
                added = self._reach(points[-1], before, pose, 0)
                if added is None:
                    return self._cut(points, done / total, jumps)
                points += added
                before, done = pose, done + 1
        return self._cut(points, 1.0, jumps)

    def _pose(self, positions: Floats) -> Pose:
        self._state[self._columns] = positions
        return self._ik.robot.pose(self._state, self._ik.link)

    def _reach(self, here: Floats, before: Pose, pose: Pose, depth: int) -> list[Floats] | None:
        """Return positions from one pose to the next.

        Others are between them where joints bend the path.
        """
        self._state[self._columns] = here
        found = self._ik.solve(pose, self._state)
        if found is None:
            self._why = f"no positions bring '{self._ik.link}' to {pose!r}"
            return None
        if not self._valid(found):
            self._why = "; ".join(self._reasons(found)) or "the state there is not valid"
            return None
        middle = between(before, pose, 0.5)
        moved, turned = _apart(self._pose((here + found) / 2.0), middle)
        if moved <= DEVIATION and turned <= TURN:
            return [found]
        if depth >= _HALVINGS or _apart(before, pose)[0] + _apart(before, pose)[1] < _FLOOR:
            self._why = (
                f"between two steps '{self._ik.link}' would be {moved * 1e3:.1f} mm and "
                f"{turned:.3f} rad off the straight way: joints jump"
            )
            return None
        first = self._reach(here, before, middle, depth + 1)
        if first is None:
            return None
        second = self._reach(first[-1], middle, pose, depth + 1)
        return None if second is None else first + second

    def _cut(
        self, points: list[Floats], fraction: float, jumps: JumpLimits | None
    ) -> CartesianPath:
        made = np.array(points)
        reason = "" if fraction == 1.0 else self._why
        moved = np.abs(np.diff(made, axis=0))
        if jumps is None or not len(moved):
            return CartesianPath(made, fraction, reason)
        slides = np.array([each.kind == "prismatic" for each in self._ik.group.variables])
        length = moved.sum(axis=1)
        bad = length > jumps.factor * length.mean()
        bad |= (moved > np.where(slides, jumps.prismatic, jumps.revolute)).any(axis=1)
        if not bad.any():
            return CartesianPath(made, fraction, reason)
        last = int(np.argmax(bad))
        reason = f"joints jump by {length[last]:.3f} in step {last + 1}"
        return CartesianPath(made[: last + 1], fraction * last / len(moved), reason)


def between(first: Pose, second: Pose, fraction: float) -> Pose:
    """Return a pose on the straight line between two, turned uniformly."""
    turn = np.array(rotation_vector(first.matrix()[:3, :3].T @ second.matrix()[:3, :3]))
    angle = float(np.linalg.norm(turn)) * fraction
    q = (0.0, 0.0, 0.0, 1.0)
    if angle > 0.0:
        x, y, z = (turn / np.linalg.norm(turn) * math.sin(angle / 2.0)).tolist()
        q = (x, y, z, math.cos(angle / 2.0))
    position = [
        a + (b - a) * fraction for a, b in zip(first.position, second.position, strict=True)
    ]
    turned = Pose.from_quaternion((0, 0, 0), first.quaternion) * Pose.from_quaternion((0, 0, 0), q)
    return Pose.from_quaternion(position, turned.quaternion)


def _steps(first: Pose, second: Pose, step: float) -> list[Pose]:
    moved, turned = _apart(first, second)
    count = checked_steps(max(moved, turned / _TURN_PER_METRE) / step, step)
    return [between(first, second, number / count) for number in range(1, count)] + [second]


def _pairs(here: Pose, poses: Sequence[Pose]) -> list[tuple[Pose, Pose]]:
    return list(zip([here, *poses[:-1]], poses, strict=True))


def _apart(first: Pose, second: Pose) -> tuple[float, float]:
    """Return distance [m] and angle [rad]."""
    turn = rotation_vector(first.matrix()[:3, :3].T @ second.matrix()[:3, :3])
    return math.dist(first.position, second.position), math.hypot(*turn)
