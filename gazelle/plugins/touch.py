"""Contact with one object alone for a time: ``libTouchPlugin.so``."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.sensors import ContactModel
from gazelle.simulation import Input, ModelPlugin, Output, Robot, absolute
from gazelle.simulation.values import Flags


class Touch(ModelPlugin):
    """Detects when some contact sensors have touched the target, and nothing else, long enough.

    It publishes once, and waits then to be enabled again, in every world by itself.
    """

    update_rate = 50.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the sensors, open the topics."""
        self._engine, self._clock = robot.simulation.engine, robot.simulation.clock
        self._collisions: list[str] = []
        for tag in parameters.find_all("sensor"):
            model = robot.sensors[tag.text].model
            if not isinstance(model, ContactModel):
                raise SimulationError(f"'{tag.text}' is not a contact sensor", source=tag.source)
            self._collisions.extend(model.collisions)
        if not self._collisions:
            raise SimulationError("a <sensor> is required here", source=parameters.source)
        self._target = parameters.require("target", str)
        self._time = parameters.require("time", float)
        namespace = parameters.require("namespace", str)
        self._starts_enabled = parameters.get("enabled", False)
        nworld = robot.simulation.nworld
        self._enabled = np.full(nworld, self._starts_enabled)
        self._touched = np.zeros(nworld, np.bool_)
        self._since: Floats = np.full(nworld, np.nan)
        robot.inputs[f"{namespace} enable"] = Input(
            absolute("", f"{namespace}/enable"), bool, self._enable
        )
        self._output = robot.outputs[f"{namespace} touched"] = Output(
            absolute("", f"{namespace}/touched"),
            Flags,
            lambda: Flags(self._touched.copy()),
            event=True,
        )

    def _enable(self, enabled: bool, worlds: Worlds | None) -> None:  # noqa: FBT001  what the topic says
        rows = slice(None) if worlds is None else worlds
        self._enabled[rows] = enabled
        if enabled:
            self._since[rows], self._touched[rows] = np.nan, False

    @property
    def active(self) -> bool:
        """True if it is enabled anywhere."""
        return bool(self._enabled.any())

    def on_update(self, time: float) -> None:
        """Check contacts."""
        found = self._engine.contacts([self._collisions], np.flatnonzero(self._enabled))
        where, others = found.worlds, found.named().others
        hits = np.array([self._target in name for name in others], np.bool_)
        touches = np.zeros(len(self._enabled), np.bool_)
        touches[where] = True
        touches[where[~hits]] = False
        self._since[self._enabled & ~touches] = np.nan
        begins = touches & np.isnan(self._since)
        self._since[begins] = time
        done = self._enabled & (time - self._since > self._time)
        if done.any():
            self._touched[done], self._enabled[done] = True, False
            self._output.publish()

    def reset(self, worlds: Worlds | None) -> None:
        """Start as the file says."""
        rows = slice(None) if worlds is None else worlds
        self._enabled[rows], self._touched[rows] = self._starts_enabled, False
        self._since[rows] = np.nan

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the start of contacts, and where they were published."""
        return {
            "enabled": self._enabled.copy(),
            "touched": self._touched.copy(),
            "since": self._since.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._enabled[:], self._touched[:] = state["enabled"], state["touched"]
        self._since[:] = state["since"]
