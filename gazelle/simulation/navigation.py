"""Interface of ``robot.navigation``, independent of its implementation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from gazelle.array_types import Floats, Worlds
from gazelle.description.occupancy import OccupancyMap


class NavigationTask(Protocol):
    """A goal that a robot is on its way to.

    Attributes:
        done: Whether it is reached or given up, in all of its worlds.
        succeeded: Whether it is reached in all of its worlds.
        text: Message of the first world that is done.
    """

    done: bool
    succeeded: bool
    text: str

    def wait(self, seconds: float = ...) -> bool:
        """Run the simulation until it is done, or for so long [simulated s]; whether it succeeded."""


@dataclass(frozen=True, slots=True)
class NavigationPlan:
    """Present goal and plan of a robot.

    Attributes:
        goal: x, y and heading, in the map's frame [m, rad].
        path: The global plan, shape (n, 3) likewise; empty while there is none.
    """

    goal: tuple[float, float, float]
    path: Floats


class NavigationControl(Protocol):
    """Takes a robot to goals, as ``move_base`` does, in simulated time."""

    def configure(
        self,
        parameters: Mapping[str, Any] | None = ...,
        *,
        grid: OccupancyMap | None = ...,
        localization: str = ...,
    ) -> None:
        """Set parameters of ``move_base``, a map and localisation: truth, ``amcl`` or ``slam``."""

    def go_to(
        self, x: float, y: float, yaw: float | None = ..., *, worlds: Worlds | None = ...
    ) -> NavigationTask:
        """Send the robot to a goal; the simulation has to run."""

    def explore(self, settings: Any = ..., *, worlds: Worlds | None = ...) -> NavigationTask:
        """Explore frontiers until the map is complete; the simulation has to run."""

    def map(self, world: int = ...) -> OccupancyMap | None:
        """Return the map that a world's robot uses."""

    def cancel(self, worlds: Worlds | None = ...) -> None:
        """Cancel the goal and stop."""

    def plans(self) -> dict[int, NavigationPlan]:
        """Return the goal of each world that has one, with the path to it."""
