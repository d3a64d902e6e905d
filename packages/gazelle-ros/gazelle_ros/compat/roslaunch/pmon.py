"""Processes, and listeners of their end."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle_ros.launch.process import NodeProcess


class ProcessListener:
    """Listens to the end of processes that end by themselves."""

    def process_died(self, process_name: str, exit_code: int) -> None:
        """Handle the end of a process."""


class Process:
    """A node that was started.

    Args:
        process: The process.
        forget: Stops it and watches it no more.
    """

    def __init__(self, process: NodeProcess, forget: Callable[[NodeProcess], None]) -> None:
        self._process = process
        self._forget = forget
        self.package = process.plan.package
        self.name = process.name
        self.args = list(process.how.arguments)
        self.env = process.how.environment
        self.respawn = process.plan.respawn
        self.respawn_delay = process.plan.respawn_delay
        self.required = process.plan.required

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    @property
    def spawn_count(self) -> int:
        """Number of times it was started."""
        return self._process.spawned

    @property
    def exit_code(self) -> int | None:
        """Exit code, negative for a signal; None while it runs."""
        return self._process.poll()

    def is_alive(self) -> bool:
        """Return whether it is running."""
        return self._process.running

    def stop(self, errors: list[str] | None = None) -> None:
        """Stop it, without a respawn."""
        del errors
        self._forget(self._process)

    def get_info(self) -> dict[str, Any]:
        """Return all its properties."""
        info: dict[str, Any] = {
            "spawn_count": self.spawn_count,
            "args": self.args,
            "env": self.env,
            "package": self.package,
            "name": self.name,
            "alive": self.is_alive(),
            "respawn": self.respawn,
            "respawn_delay": self.respawn_delay,
            "required": self.required,
            "pid": self.pid,
        }
        code = self.exit_code
        return info if code is None else info | {"exit_code": code}

    def get_exit_description(self) -> str:
        """Return a description of its end."""
        code = self.exit_code
        if code is None:
            return "process has died"
        return f"process has died [exit code {code}]" if code else "process has finished cleanly"

    def __str__(self) -> str:
        return f"Process<{self.name}>"
