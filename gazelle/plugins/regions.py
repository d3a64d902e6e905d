"""Regions that call something when they are occupied: of ``libSimEventsPlugin.so``."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Parameters
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean
from gazelle.simulation import Input, Simulation, WorldPlugin, absolute


@dataclass(frozen=True, slots=True)
class _Region:
    """A region: a box, and the topic and message for models whose origin is in it.

    Attributes:
        least: One corner [m].
        most: The other.
        topic: Full name.
        text: Message of the event.
    """

    least: Floats
    most: Floats
    topic: str
    text: str


class RegionEvents(WorldPlugin):
    """Regions that notify the plugins of models, such as lifts, when a movable model is inside.

    Events of other kinds, which are only on Gazebo's own topics, are left out with a warning.
    """

    update_rate = 10.0

    def load(self, simulation: Simulation, parameters: Parameters) -> None:
        """Read regions and events."""
        self._simulation = simulation
        boxes = {tag.get("name", ""): tag.find("volume") for tag in parameters.find_all("region")}
        self._regions: list[_Region] = []
        for event in parameters.find_all("event"):
            if event.require("type", str) != "occupied":
                warnings.warn(
                    SimulationWarning(
                        f"'world': events of type '{event.get('type', '')}' are published on Gazebo's "
                        "own topics only; they are left out"
                    ),
                    stacklevel=3,
                )
                continue
            name = event.require("region", str)
            volume = boxes.get(name)
            if volume is None:
                raise SimulationError(
                    f"there is no region '{name}'",
                    source=event.source,
                    hint=did_you_mean(name, boxes),
                )
            self._regions.append(_region(event, volume))

    def on_update(self, time: float) -> None:  # noqa: ARG002  what is occupied is so now
        """Publish events to subscribers."""
        places = [
            robot.placement().position
            for robot in self._simulation.robots.values()
            if robot.links and not robot.description.static
        ]
        if not places:
            return
        stacked = np.array(places)
        for region in self._regions:
            inside = ((stacked >= region.least) & (stacked <= region.most)).all(axis=2)
            worlds = np.flatnonzero(inside.any(axis=0))
            if worlds.size:
                for port in self._listeners(region.topic):
                    port.send(region.text, worlds)

    def _listeners(self, topic: str) -> Iterator[Input[str]]:
        for robot in self._simulation.robots.values():
            for port in robot.inputs.values():
                if isinstance(port, Input) and port.kind is str and port.topic == topic:
                    yield port


def _region(event: Parameters, volume: Parameters) -> _Region:
    corners = np.array([volume.numbers(name, (0.0, 0.0, 0.0)) for name in ("min", "max")])
    # Gazebo's own topics begin with ~, which stands for the world there.
    topic = absolute("", event.require("topic", str).removeprefix("~/"))
    return _Region(corners.min(axis=0), corners.max(axis=0), topic, event.require("msg_data", str))
