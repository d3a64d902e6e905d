"""What ``robot.navigation`` can do, whoever does it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from gazelle.array_types import Worlds
from gazelle.description.occupancy import OccupancyMap


class NavigationTask(Protocol):
    """A goal that a robot is on its way to.

    Attributes:
        done: Whether it is reached or given up, in all of its worlds.
        succeeded: Whether it is reached in all of its worlds.
        text: What is said of it in its first world that is done.
    """

    done: bool
    succeeded: bool
    text: str

    def wait(self, seconds: float = ...) -> bool:
        """Run the simulation until it is done, or for so long [simulated s]; whether it succeeded."""


class NavigationControl(Protocol):
    """Takes a robot to goals, as ``move_base`` does, in simulated time."""

    def configure(
        self,
        parameters: Mapping[str, Any] | None = ...,
        *,
        grid: OccupancyMap | None = ...,
        localization: str = ...,
    ) -> None:
        """Use parameters of ``move_base``, a map, and truth or ``amcl`` for the robot's place."""

    def go_to(
        self, x: float, y: float, yaw: float | None = ..., *, worlds: Worlds | None = ...
    ) -> NavigationTask:
        """Go there; the simulation has to run."""

    def cancel(self, worlds: Worlds | None = ...) -> None:
        """Have no goal, and stand."""
