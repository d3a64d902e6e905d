"""Validity of positions of a group in a scene, and of straight paths between them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from gazelle.array_types import Floats
from gazelle.kinematics.joint_group import SAMPLED_SPAN, JointModelGroup
from gazelle.planning.constraints import ConstraintSet
from gazelle.planning.scene import PlanningScene

LONGEST_SEGMENT = 0.005
"""Distance of checked states, as a fraction of the extent of all positions (MoveIt's default)."""


class StateValidity:
    """Judges positions of a group; all other joints stay as they are in a state.

    A change of the scene that is made later does not count.

    Args:
        scene: Planning scene.
        group: Group of the positions.
        state: Of all variables, shape (variables,).
        constraints: Constraints of every state.
        segment: Distance of the states that are checked along a motion, as a fraction of the extent.
        collisions: Whether what touches counts.

    Attributes:
        resolution: Resolution, as ``JointModelGroup.distance`` measures it.
        checks: Number of checked states.
    """

    def __init__(
        self,
        scene: PlanningScene,
        group: JointModelGroup,
        state: Floats,
        constraints: ConstraintSet | None = None,
        segment: float = LONGEST_SEGMENT,
        *,
        collisions: bool = True,
    ) -> None:
        self.scene, self.group = scene, group
        self.constraints = constraints or ConstraintSet()
        self.resolution = segment * extent_of(group)
        self.checks = 0
        self._state = np.array(state, np.float64)
        self._columns = group.columns
        self._touches = scene.collision_check(group) if collisions else _nothing
        self._low, self._high = group.lower - 1e-9, group.upper + 1e-9

    def full(self, positions: Floats) -> Floats:
        """Return the state of all variables with these positions of the group, (variables,)."""
        state = self._state.copy()
        state[self._columns] = positions
        return state

    def __call__(self, positions: Floats) -> bool:
        """Return whether positions, shape (n,), are within limits and constraints, and collision-free."""
        self.checks += 1
        if (positions < self._low).any() or (positions > self._high).any():
            return False
        self._state[self._columns] = positions
        if self.constraints and self.constraints.violations(self.scene.robot, self._state):
            return False
        return not self._touches(self._state)

    def reasons(self, positions: Floats) -> list[str]:
        """Return the reasons why positions, shape (n,), are invalid."""
        state = self.full(positions)
        return [
            *self.scene.why_invalid(state, self.group),
            *self.constraints.violations(self.scene.robot, state),
        ]

    def motion(self, first: Floats, second: Floats, resolution: float | None = None) -> bool:
        """Return whether all states between two positions are valid; the first one counts as checked.

        The middle comes first, which finds obstacles soonest.
        """
        step = self.resolution if resolution is None else resolution
        count = math.ceil(float(np.linalg.norm(second - first)) / step)
        if not self(second):
            return False
        delta = (second - first) / max(count, 1)
        return all(self(first + number * delta) for number in _bisecting(count))

    def path(self, points: Floats, resolution: float | None = None) -> bool:
        """Return whether a path through points, shape (m, n), is valid, ends included."""
        return self(points[0]) and all(
            self.motion(first, second, resolution) for first, second in pairwise(points)
        )


def _nothing(_state: Floats) -> bool:
    return False


def extent_of(group: JointModelGroup) -> float:
    """Return the greatest distance between positions of a group.

    Half a turn for continuous joints.
    """
    span = np.where(np.isfinite(group.upper - group.lower), group.upper - group.lower, SAMPLED_SPAN)
    return float(np.linalg.norm(span))


def _bisecting(count: int) -> Iterator[int]:
    """Yield the numbers between 0 and ``count``, halves before quarters."""
    stride = 1 << max(count - 1, 0).bit_length()
    while stride > 1:
        yield from range(stride // 2, count, stride)
        stride //= 2
