"""Common context of all parts of a page."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.simulation import Simulation
from gazelle.viewer.page.shapes import extent_of_world
from gazelle.viewer.page.user_actions import UserActions

if TYPE_CHECKING:
    from viser import GuiApi, SceneApi, ViserServer

ROOT = "/world"
"""Node that moves when a model is followed; everything hangs on it."""

_GAP = 1.0  # between worlds that stand side by side [m]


class ScenePart(NamedTuple):
    """A part of a world that can be selected.

    Attributes:
        kind: ``world``, ``model``, ``link``, ``collision``, ``joint``, ``sensor`` or ``light``; "" for none.
        name: Scoped name.
    """

    kind: str = ""
    name: str = ""


class PageLayer(Protocol):
    """A part of the page that follows the simulation."""

    def read(self) -> Any:
        """Read the state; called between two steps."""

    def show(self, state: Any) -> None:
        """Show the state on the page."""

    def renew(self) -> None:
        """Update the layer after models changed."""


class OptionalLayer(PageLayer, Protocol):
    """One that can be left out.

    Attributes:
        shown: Whether it is on the page.
    """

    shown: bool


@dataclass
class PageContext(UserActions):
    """Context of a page: what it shows, and access of its parts to the simulation.

    Attributes:
        simulation: Simulation.
        page: viser's server.
        worlds: Shown worlds, shape (n,).
        spots: Their positions [m], shape (n, 3).
        selected: Name of the model that tools work on, "" for none.
        world: Number of the world that tools work on, among those shown.
        part: Selected part of that model or world.
        heading: Position of the followed model [m], shape (3,).
        read_only: Whether nothing can be changed on the page.
        placing_until: Wall time until which clicks in the scene put something down [s].
        listeners: Called between two steps after another model or part was selected.
    """

    simulation: Simulation
    page: ViserServer
    worlds: Worlds
    spots: Floats
    selected: str = ""
    world: int = 0
    part: ScenePart = field(default_factory=ScenePart)
    read_only: bool = False
    heading: Floats = field(default_factory=lambda: np.zeros(3))
    placing_until: float = 0.0
    listeners: list[Callable[[], None]] = field(default_factory=list)
    _announced: tuple[str, int, ScenePart] = ("", 0, ScenePart())

    @property
    def scene(self) -> SceneApi:
        """Scene of the page."""
        return self.page.scene

    @property
    def gui(self) -> GuiApi:
        """Panel of the page."""
        return self.page.gui

    @property
    def chosen(self) -> Worlds:
        """The world that tools work on, shape (1,)."""
        return self.worlds[self.world : self.world + 1]

    @property
    def spot(self) -> Floats:
        """Position of that world [m], shape (3,)."""
        found: Floats = self.spots[self.world]
        return found

    def select(self, model: str, world: int = 0, part: ScenePart | None = None) -> None:
        """Select the model that tools work on, and a part of it.

        Listeners are called with the next picture.

        Args:
            model: Its name; "" for none.
            world: Number of the world, among those shown.
            part: The model itself if None.
        """
        self.selected, self.world = model, world
        self.part = part or (ScenePart("model", model) if model else ScenePart())

    def announce_selection(self) -> None:
        """Call the listeners if another model or part is selected since the last call.

        Clicks arrive on the page's threads, pictures on others. Listeners that rebuild parts of the
        panel run here only, between two steps, so that no two of them rebuild a part at once.
        """
        if (now := (self.selected, self.world, self.part)) != self._announced:
            self._announced = now
            for listener in tuple(self.listeners):
                listener()


def spots_of(simulation: Simulation, count: int) -> Floats:
    """Return the positions of copies of a world beside each other, in rows [m], shape (count, 3)."""
    spots = np.zeros((count, 3))
    if count > 1:
        low, high = extent_of_world(simulation.world)
        pitch = high - low + _GAP
        columns = math.ceil(math.sqrt(count))
        number = np.arange(count)
        spots[:, 0] = (number % columns) * pitch[0]
        spots[:, 1] = -(number // columns) * pitch[1]
    return spots
