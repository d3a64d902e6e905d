"""Effort and velocity limits of joints, as Gazebo classic enforces them.

Both bound what is commanded by ``set_joint_effort``, and nothing else: motors have a largest
effort of their own, and a body that is thrown may move a joint as fast as it likes.

* An effort is clamped to the effort limit.
* While a joint is faster than its velocity limit, an effort that would speed it up further is
  not applied. MuJoCo knows nothing of that, so while such efforts act the physics is stepped
  one step at a time.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.mujoco.state import StateViews
from gazelle.kinematics.tree import TreeLink


@dataclass(frozen=True, slots=True)
class EffortLimits:
    """Limits of the joints that have some.

    Attributes:
        effort: Largest efforts of a joint's axes [N or N m], by scoped name.
        dofs: Degrees of freedom that have a velocity limit, shape (k,).
        speed: Those limits [m/s or rad/s], shape (k,).
    """

    effort: Mapping[str, Floats]
    dofs: NDArray[np.intp]
    speed: Floats

    def clamp(self, joint: str, effort: Floats) -> Floats:
        """Return an effort within the limits of its joint, shape (..., axes)."""
        largest = self.effort.get(joint)
        return effort if largest is None else np.clip(effort, -largest, largest)

    def govern(self, state: StateViews) -> bool:
        """Return whether an effort acts in some world on a joint with a velocity limit."""
        return bool(self.dofs.size) and bool(np.count_nonzero(state.qfrc_applied[:, self.dofs]))

    @contextmanager
    def held_back(self, state: StateViews) -> Iterator[None]:
        """Remove efforts that accelerate joints above their velocity limit, while it lasts."""
        commanded = state.qfrc_applied[:, self.dofs]
        velocity = state.qvel[:, self.dofs]
        onward = (np.abs(velocity) > self.speed) & (commanded * velocity > 0.0)
        if not onward.any():
            yield
            return
        state.qfrc_applied[:, self.dofs] = np.where(onward, 0.0, commanded)
        try:
            yield
        finally:
            state.qfrc_applied[:, self.dofs] = commanded


def effort_limits(
    bodies: Iterable[TreeLink], velocities: Mapping[str, tuple[slice, ...]]
) -> EffortLimits:
    """Return the limits of the joints of a world.

    Args:
        bodies: All of the world.
        velocities: Columns in ``qvel`` of every joint that moves, one slice an axis.
    """
    efforts: dict[str, Floats] = {}
    dofs: list[int] = []
    speeds: list[float] = []
    for body in bodies:
        if body.joint is None or body.joint_name not in velocities:
            continue
        columns = velocities[body.joint_name]
        widths = [column.stop - column.start for column in columns]
        largest = np.full(sum(widths), np.inf)
        if widths == [1] * len(widths):
            for index, axis in enumerate(body.joint.axes[: len(columns)]):
                largest[index] = axis.effort
                if np.isfinite(axis.velocity):
                    dofs.append(columns[index].start)
                    speeds.append(axis.velocity)
        if np.isfinite(largest).any():
            efforts[body.joint_name] = largest
    return EffortLimits(efforts, np.array(dofs, np.intp), np.array(speeds, np.float64))
