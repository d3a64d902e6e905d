"""Inverse kinematics: positions of a group's joints that bring a link to a pose."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats, Ints64
from gazelle.description import Pose
from gazelle.errors import PlanningError
from gazelle.kinematics.chain_solver import ChainSolver
from gazelle.kinematics.joint_group import JointModelGroup
from gazelle.kinematics.joint_nodes import flat
from gazelle.kinematics.robot_model import RobotModel
from gazelle.streams import seed_of

Aim = Literal["pose", "position", "orientation"]

_WEIGHTS: dict[str, tuple[float, ...]] = {
    "pose": (1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
    "position": (1.0, 1.0, 1.0, 0.0, 0.0, 0.0),
    "orientation": (0.0, 0.0, 0.0, 1.0, 1.0, 1.0),
}


@dataclass(frozen=True, slots=True)
class IkSolutions:
    """Solutions of inverse kinematics for several poses.

    Attributes:
        positions: Of the group's joints [m or rad], NaN where none was found, shape (n, joints).
        found: Mask of solved poses, shape (n,).
        attempts: Number of starts, shape (n,).
    """

    positions: Floats
    found: Bools
    attempts: Ints64


@checked(PlanningError)
class InverseKinematics:
    """Brings one link of a group to poses.

    It begins at the seed, then at positions drawn between the limits: the same ones for every pose,
    so that a pose has the same solution whatever others are asked for with it.

    Args:
        robot: The robot.
        group: Group that moves.
        link: Link to place; the group's tip if None.
        aim: ``pose``, or only its ``position`` or ``orientation``.
        tolerance: Of the distance [m] and the angle [rad].
        attempts: Largest number of starts.
        seed: Of the positions drawn.

    Raises:
        PlanningError: There is no such link, no joint of the group moves it, or an argument is wrong.
    """

    def __init__(
        self,
        robot: RobotModel,
        group: JointModelGroup,
        link: str | None = None,
        *,
        aim: Aim = "pose",
        tolerance: tuple[float, float] = (1e-5, 1e-5),
        attempts: int = 100,
        seed: int = 0,
    ) -> None:
        if aim not in _WEIGHTS:
            raise PlanningError(f"aim must be one of {', '.join(_WEIGHTS)}, not {aim!r}")
        if attempts < 1 or min(tolerance) <= 0.0:
            raise PlanningError("attempts and tolerances must be above zero")
        self.robot, self.group = robot, group
        self.link = group.tip if link is None else link
        self._weights, self._tolerance = np.array(_WEIGHTS[aim]), tolerance
        frame = robot.link(self.link)
        if self.link not in robot.moving(group.columns):
            raise PlanningError(f"no joint of the group '{group.name}' moves '{self.link}'")
        self._solver = ChainSolver(
            robot.tree,
            frame.joint,
            np.array(flat(frame.offset)),
            group.columns,
            group.lower,
            group.upper,
        )
        self._starts = group.sample(np.random.default_rng(seed_of(seed) % 2**64), attempts)

    def solve(
        self,
        pose: Pose,
        state: ArrayLike | None = None,
        *,
        valid: Callable[[Floats], bool] | None = None,
        timeout: float = math.inf,
    ) -> Floats | None:
        """Return positions of the group's joints for one pose.

        Args:
            pose: In the robot's frame.
            state: Of all variables: where it begins, and where other joints are; the zero state if
                None. Shape (variables,).
            valid: Asked of each solution, shape (joints,); what it refuses is looked for further.
            timeout: After so long nothing that was refused is looked for further [s].

        Returns:
            Shape (joints,); None if there is none.
        """
        full = self.robot.zero() if state is None else np.array(state, np.float64)
        return self._solve_one(np.array(flat(pose)), full, valid, timeout)[0]

    def solve_many(self, poses: ArrayLike, states: ArrayLike | None = None) -> IkSolutions:
        """Return positions for many poses, each by itself.

        Args:
            poses: Homogeneous transforms in the robot's frame, shape (n, 4, 4).
            states: Shape (variables,) or (n, variables); see ``solve``.

        Raises:
            PlanningError: A shape is wrong.
        """
        targets, given = self._checked_request(poses, states)
        count = len(targets)
        positions = np.full((count, len(self.group.variables)), np.nan)
        attempts = np.zeros(count, np.int64)
        for number in range(count):
            made, attempts[number] = self._solve_one(targets[number], given[number].copy(), None)
            if made is not None:
                positions[number] = made
        return IkSolutions(positions, np.isfinite(positions).all(axis=1), attempts)

    def follow(self, poses: ArrayLike, states: ArrayLike) -> Floats:
        """Return positions near poses by one descent from each state, compiled for all.

        For poses a little way off, time after time. Where a pose is out of reach, or the arm is
        caught, the nearest of that descent is taken, never farther than the state that it began
        from; nothing is started again.

        Args:
            poses: Homogeneous transforms in the robot's frame, shape (n, 4, 4).
            states: Of all variables, shape (variables,) or (n, variables).

        Returns:
            Of the group's joints, shape (n, joints).

        Raises:
            PlanningError: A shape is wrong.
        """
        targets, given = self._checked_request(poses, states)
        found = np.array(given, order="C")
        self._solver.follow(targets, found, self._weights, self._tolerance)
        columns = self.group.columns
        return given[:, columns] + self.group.difference(given[:, columns], found[:, columns])

    def _checked_request(self, poses: ArrayLike, states: ArrayLike | None) -> tuple[Floats, Floats]:
        """Return poses as rows of shape (n, 12) and states of shape (n, variables)."""
        target_poses = np.asarray(poses, np.float64)
        if target_poses.ndim != 3 or target_poses.shape[1:] != (4, 4):
            raise PlanningError(f"poses have the shape (n, 4, 4), not {target_poses.shape}")
        count = len(target_poses)
        starts = self.robot.zero() if states is None else np.asarray(states, np.float64)
        shape = (count, len(self.robot.variables))
        if starts.shape not in {shape, shape[1:]}:
            raise PlanningError(f"states have the shape {shape}, not {starts.shape}")
        targets = np.concatenate(
            (target_poses[:, :3, :3].reshape(count, 9), target_poses[:, :3, 3]), axis=1
        )
        return targets, np.broadcast_to(starts, shape)

    def _solve_one(
        self,
        target: Floats,
        state: Floats,
        valid: Callable[[Floats], bool] | None,
        timeout: float = math.inf,
    ) -> tuple[Floats | None, int]:
        """Return positions and the number of starts; ``state`` is overwritten."""
        columns = self.group.columns
        seed = np.clip(state[columns], self.group.lower, self.group.upper)
        starts = np.concatenate((seed[None], self._starts[1:]))
        tried, end = 0, time.monotonic() + timeout
        while tried < len(starts):
            index = self._solver.solve(
                target, starts[tried:], state, self._weights, self._tolerance
            )
            if index < 0:
                return None, len(starts)
            tried += index + 1
            found = seed + self.group.difference(seed, state[columns])
            if valid is None or valid(found):
                return found, tried
            if time.monotonic() > end:
                break
        return None, tried
