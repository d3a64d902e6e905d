"""What engines have that update systems between their steps, without Python."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, runtime_checkable

from gazelle.array_types import Floats
from gazelle.native.system import System


@runtime_checkable
class SystemEngine(Protocol):
    """What an engine has that updates systems between its steps, in native code."""

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to the state anew."""

    def run(self, systems: Sequence[System], count: int, now_ns: int) -> None:
        """Advance every world, and update systems whenever they are due, in this order.

        Args:
            systems: They may write commands, motors' velocities and poses in their own worlds.
            count: Of physics steps.
            now_ns: Simulated time [ns].
        """

    def motor_targets(self, joint: str) -> tuple[Floats, int]:
        """Velocities that motors hold, shape (nworld, n), to be written, and a joint's column.

        Raises:
            EngineError: There is no motor on the joint.
        """

    def follow(self, model: str, path: Any) -> None:
        """Let a path carry a model."""
