"""What engines have that compile their worlds when all that is wanted of them is known."""

from __future__ import annotations

from typing import Protocol, runtime_checkable


@runtime_checkable
class LateEngine(Protocol):
    """Its world is compiled once for the description and what plugins ask for, such as motors."""

    def prepare(self) -> None:
        """Compile the world with all that was asked for, so that the next step is one like others.

        Raises:
            EngineError: The world cannot be simulated.
        """
