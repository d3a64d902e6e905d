"""Transmissions between actuators and joints: what a reduction, a differential and a four-bar linkage do.

The formulas are those of ros_control's transmission_interface; reductions may be negative, not zero. A
simulated robot has no actuators, and its transmissions only name joints, as in Gazebo; these are for robots
of one's own (``RobotHardware``), and for what wants to know an actuator's share.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import ControlError


class LinearTransmission:
    """A linear transmission: joint velocities are a matrix times those of its actuators.

    Args:
        velocity: From actuators to joints, shape (n, n).
        effort: From actuators to joints, shape (n, n).
        offset: Of the joints' positions [m or rad], shape (n,).
    """

    def __init__(self, velocity: Floats, effort: Floats, offset: Sequence[float]) -> None:
        self._velocity, self._effort = velocity, effort
        self._back, self._effort_back = np.linalg.inv(velocity), np.linalg.inv(effort)
        self._offset = np.asarray(offset, np.float64)

    def joint_position(self, actuators: Floats) -> Floats:
        """Return positions of the joints, from the actuators'; shape (..., n) each."""
        return self.joint_velocity(actuators) + self._offset

    def joint_velocity(self, actuators: Floats) -> Floats:
        """Return velocities of the joints, from the actuators'; shape (..., n) each."""
        found: Floats = actuators @ self._velocity.T
        return found

    def joint_effort(self, actuators: Floats) -> Floats:
        """Return efforts of the joints, from the actuators'; shape (..., n) each."""
        found: Floats = actuators @ self._effort.T
        return found

    def actuator_position(self, joints: Floats) -> Floats:
        """Return positions of the actuators, from the joints'; shape (..., n) each."""
        return self.actuator_velocity(joints - self._offset)

    def actuator_velocity(self, joints: Floats) -> Floats:
        """Return velocities of the actuators, from the joints'; shape (..., n) each."""
        found: Floats = joints @ self._back.T
        return found

    def actuator_effort(self, joints: Floats) -> Floats:
        """Return efforts of the actuators, from the joints'; shape (..., n) each."""
        found: Floats = joints @ self._effort_back.T
        return found


class SimpleTransmission(LinearTransmission):
    """One actuator that turns one joint, ``reduction`` times as slow and as strong.

    Raises:
        ControlError: The reduction is zero.
    """

    def __init__(self, reduction: float = 1.0, offset: float = 0.0) -> None:
        _check([reduction], 1)
        ratio = np.array([[reduction]], np.float64)
        super().__init__(1.0 / ratio, ratio, [offset])


class DifferentialTransmission(LinearTransmission):
    """Two actuators that turn one joint together, and another one against each other.

    Args:
        actuators: Reductions of the two actuators.
        joints: Reductions of the two joints.
        offset: Of the joints' positions [m or rad].

    Raises:
        ControlError: There are not two, or one is zero.
    """

    def __init__(
        self,
        actuators: Sequence[float],
        joints: Sequence[float] = (1.0, 1.0),
        offset: Sequence[float] = (0.0, 0.0),
    ) -> None:
        _check(actuators, 2)
        _check(joints, 2)
        signs = np.array([[1.0, 1.0], [1.0, -1.0]])
        a, j = np.asarray(actuators, np.float64), np.asarray(joints, np.float64)[:, None]
        super().__init__(signs / (2.0 * a * j), signs * a * j, offset)


class FourBarLinkageTransmission(LinearTransmission):
    """Two actuators: the first turns the first joint, and both the second.

    Efforts are the original's, there and back; the power of the actuators is not that of the joints.

    Args:
        actuators: Reductions of the two actuators.
        joints: Reductions of the two joints.
        offset: Of the joints' positions [m or rad].

    Raises:
        ControlError: There are not two, or one is zero.
    """

    def __init__(
        self,
        actuators: Sequence[float],
        joints: Sequence[float] = (1.0, 1.0),
        offset: Sequence[float] = (0.0, 0.0),
    ) -> None:
        _check(actuators, 2)
        _check(joints, 2)
        (a1, a2), (j1, j2) = actuators, joints
        velocity = np.array([[1.0 / (j1 * a1), 0.0], [-1.0 / (j1 * a1 * j2), 1.0 / (a2 * j2)]])
        effort = np.array([[j1 * a1, 0.0], [-j2 * j1 * a1, j2 * a2]])
        super().__init__(velocity, effort, offset)


def _check(reductions: Sequence[float], count: int) -> None:
    if len(reductions) != count:
        raise ControlError(f"this transmission needs {count} reductions, not {len(reductions)}")
    if not all(reductions) or not np.isfinite(reductions).all():
        raise ControlError(f"reductions of a transmission cannot be zero: {list(reductions)}")
