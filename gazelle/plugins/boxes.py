"""Boxes in the world that report their contents, or put it elsewhere.

``libContainPlugin.so`` and ``libTransporterPlugin.so``. What counts is where the origin of a
model or link is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters, Pose
from gazelle.engines import Placement
from gazelle.errors import SimulationError, did_you_mean
from gazelle.rotations import conjugate, rotate
from gazelle.simulation import Input, Output, Simulation, WorldPlugin, absolute
from gazelle.simulation.values import Flags


class Contain(WorldPlugin):
    """Box that publishes whether a model or link is inside, whenever that changes in a world."""

    update_rate = 0.0

    def load(self, simulation: Simulation, parameters: Parameters) -> None:
        """Read the tags, open the topics."""
        self._simulation = simulation
        self._entity = parameters.require("entity", str)
        namespace = parameters.require("namespace", str)
        numbers = parameters.numbers("pose", (0.0,) * 6)
        pose = parameters.find("pose")
        self._frame = "" if pose is None else pose.attributes.get("frame", "")
        box = parameters.find("geometry/box")
        if box is None:
            raise SimulationError("a <geometry> with a <box> is required", source=parameters.source)
        self._half = np.asarray(box.numbers("size", (1.0, 1.0, 1.0))) / 2.0
        self._place = Pose(*numbers)
        self._enabled = self._starts_enabled = parameters.get("enabled", True)
        self._published: NDArray[np.bool_] | None = None
        simulation.ports.inputs[f"{namespace} enable"] = Input(
            absolute("", f"{namespace}/enable"), bool, self._enable
        )
        self._output = simulation.ports.outputs[f"{namespace} contain"] = Output(
            absolute("", f"{namespace}/contain"), Flags, lambda: Flags(self._check_contents())
        )

    def _enable(self, enabled: bool, _worlds: Worlds | None) -> None:  # noqa: FBT001  what the topic says
        self._enabled, self._published = enabled, None

    @property
    def active(self) -> bool:
        """True if it is enabled and has subscribers."""
        return self._enabled and self._output.has_subscribers

    def on_update(self, time: float) -> None:  # noqa: ARG002  it looks at every step
        """Publish a change of contents."""
        inside = self._check_contents()
        if self._published is None or (inside != self._published).any():
            self._published = inside
            self._output.publish()

    def _check_contents(self) -> NDArray[np.bool_]:
        entity = _placement(self._simulation, self._entity)
        if entity is None:
            return np.zeros(self._simulation.nworld, np.bool_)
        seen = entity.position
        if self._frame:
            frame = _placement(self._simulation, self._frame)
            if frame is None:
                return np.zeros(self._simulation.nworld, np.bool_)
            seen = rotate(conjugate(frame.quaternion), seen - frame.position)
        turn = conjugate(np.asarray(self._place.quaternion)[None])
        within = np.abs(rotate(turn, seen - np.asarray(self._place.position))) <= self._half
        return np.asarray(within.all(axis=1))

    def reset(self, worlds: Worlds | None) -> None:
        """Publish again after a reset."""
        self._published = None
        if worlds is None:
            self._enabled = self._starts_enabled

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return whether it is enabled."""
        return {"enabled": np.array(self._enabled)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned, and publish again."""
        self._enabled, self._published = bool(state["enabled"]), None


@dataclass(frozen=True, slots=True)
class _Pad:
    """A place that models are taken from, and put to.

    Attributes:
        destination: Name of the pad that they are put to.
        automatic: Whether they go by themselves.
        least: Corner of the box that they are taken from [m].
        most: The other corner.
        arrival: Place of those that come from another pad.
    """

    destination: str
    automatic: bool
    least: Floats
    most: Floats
    arrival: Pose


class Transporter(WorldPlugin):
    """Puts models that are on a pad to another one, at once, or when the pad is called."""

    update_rate = 0.0

    def load(self, simulation: Simulation, parameters: Parameters) -> None:
        """Read the pads, open the topic that calls them."""
        self._simulation = simulation
        self._pads = {
            tag.attributes.get("name", ""): _pad(tag) for tag in parameters.find_all("pad")
        }
        if not self._pads:
            raise SimulationError("a <pad> is required here", source=parameters.source)
        for pad in self._pads.values():
            if pad.destination not in self._pads:
                raise SimulationError(
                    f"there is no pad '{pad.destination}'",
                    source=parameters.source,
                    hint=did_you_mean(pad.destination, self._pads),
                )
        self._called = np.zeros((len(self._pads), simulation.nworld), np.bool_)
        topic = parameters.get("activation_topic", "")
        if topic:
            # Gazebo's own topic begins with ~, which stands for the world there.
            name = absolute("", topic.removeprefix("~/"))
            simulation.ports.inputs[topic] = Input(name, str, self._call, forget=self.reset)

    def _call(self, name: str, worlds: Worlds | None) -> None:
        if name not in self._pads:
            hint = did_you_mean(name, self._pads)
            raise SimulationError(f"there is no pad '{name}'", hint=hint)
        index = list(self._pads).index(name)
        self._called[index, slice(None) if worlds is None else worlds] = True

    @property
    def active(self) -> bool:
        """True if anything may be transported."""
        return any(pad.automatic for pad in self._pads.values()) or bool(self._called.any())

    def on_update(self, time: float) -> None:  # noqa: ARG002  it looks at every step
        """Move the models on pads to their targets."""
        engine = self._simulation.engine
        for robot in self._simulation.robots.values():
            if robot.description.static or not robot.links:
                continue
            position = robot.placement().position
            gone = np.zeros(len(position), np.bool_)
            for called, pad in zip(self._called, self._pads.values(), strict=True):
                inside = ((position >= pad.least) & (position <= pad.most)).all(axis=1)
                rows = np.flatnonzero(inside & ~gone & (called | pad.automatic))
                if rows.size:
                    goal = self._pads[pad.destination].arrival
                    engine.models[robot.name].set_placement(goal.position, goal.quaternion, rows)
                    gone[rows], called[rows] = True, False

    def reset(self, worlds: Worlds | None) -> None:
        """Discard calls."""
        self._called[:, slice(None) if worlds is None else worlds] = False

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the pads that are called."""
        return {"called": self._called.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._called[:] = state["called"]


def _pad(tag: Parameters) -> _Pad:
    out, into = tag.find("outgoing"), tag.find("incoming")
    if out is None or into is None:
        raise SimulationError("a <pad> needs <outgoing> and <incoming>", source=tag.source)
    corners = (out.numbers(name, (0.0, 0.0, 0.0)) for name in ("min", "max"))
    least, most = np.asarray(next(corners)), np.asarray(next(corners))
    return _Pad(
        tag.require("destination", str),
        tag.get("activation", "auto") != "manual",
        np.minimum(least, most),
        np.maximum(least, most),
        Pose(*into.numbers("pose", (0.0,) * 6)),
    )


def _placement(simulation: Simulation, name: str) -> Placement | None:
    """Return the placement of a model, or of a link by its scoped name; None if there is none."""
    model, _, link = name.partition("::")
    if model not in simulation.robots:
        return None
    robot = simulation.robots[model]
    if not link:
        return robot.placement() if robot.links else None
    return robot.links[link].placement() if link in robot.links else None
