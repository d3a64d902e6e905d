"""Read and write the joints of planar models, and their motors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines.planar.running import RunningPlane, rows_of
from gazelle.errors import EngineError


class PlanarJoints:
    """The part of ``gazelle.engines.engine.Engine`` that reads and moves joints."""

    def __init__(self, run: RunningPlane) -> None:
        self._run = run

    def joint_position(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Position [m or rad], shape (n, axes)."""
        return self._run.angles[rows_of(worlds), self._run.axes(joint)].copy()

    def joint_velocity(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Velocity [m/s or rad/s], shape (n, axes)."""
        return self._run.rates[rows_of(worlds), self._run.axes(joint)].copy()

    def set_joint_position(
        self, joint: str, position: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a joint somewhere [m or rad], shape (axes,) or (n, axes)."""
        self._run.angles[rows_of(worlds), self._run.axes(joint)] = position

    def set_joint_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a joint a velocity, which it keeps [m/s or rad/s], shape (axes,) or (n, axes)."""
        self._run.rates[rows_of(worlds), self._run.axes(joint)] = velocity

    def joint_effort(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Nothing: efforts do not act here; zeros, shape (n, axes)."""
        return np.zeros_like(self.joint_position(joint, worlds))

    def set_motor_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity that a joint's motor holds [m/s or rad/s], shape () or (n,)."""
        targets, column = self.motor_targets(joint)
        targets[rows_of(worlds), column] = velocity

    def motor_targets(self, joint: str) -> tuple[Floats, int]:
        """Velocities that motors hold, shape (nworld, axes), to be written, and a joint's column.

        Raises:
            EngineError: There is no motor on the joint.
        """
        column = self._run.axes(joint).start
        if joint not in self._run.recipe.motors:
            raise EngineError(f"there is no motor on joint '{joint}'", hint="give it one first")
        return self._run.targets, column

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Give a joint of one axis a motor that holds a velocity, whatever that takes."""
        axes = self._run.axes(joint)
        if axes.stop - axes.start != 1:
            raise EngineError(f"a motor needs a joint of one axis; '{joint}' has more")
        most = float(np.asarray(max_effort, np.float64).reshape(-1)[0])
        if not most > 0.0:
            raise EngineError(f"the largest effort of a motor must be positive, not {most:g}")
        self._run.recipe = replace(
            self._run.recipe, motors={**self._run.recipe.motors, joint: most}
        )
        held = self._run.targets[:, axes.start]
        held[np.isnan(held)] = 0.0
        self._run.steps.forget()
