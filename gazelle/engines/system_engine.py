"""What engines have that update systems between their steps, without Python."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

from gazelle.native.system import System


@runtime_checkable
class SystemEngine(Protocol):
    """What an engine has that updates systems between its steps, in native code."""

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to the state anew."""

    def update(self, system: System) -> None:
        """Update a system now, whatever its rate, on all threads."""

    def command_models(self, models: tuple[str, ...], law: Any) -> None:
        """Let a law with a row for each of some models give them their velocities."""
