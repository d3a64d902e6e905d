"""Batteries: what ``libLinearBatteryPlugin.so`` and ``libLinearBatteryConsumerPlugin.so`` do."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.simulation import ModelPlugin, Robot, Stopwatch


class BatteryConsumer(ModelPlugin):
    """Takes power from a battery of its model.

    Attributes:
        robot: The model.
        battery: Name of the battery.
        power: Consumed power [W].
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags."""
        self.robot = robot
        self.battery = parameters.require("battery_name", str)
        self.power = parameters.get("power_load", 0.0)


class LinearBattery(ModelPlugin):
    """A battery with a voltage that falls linearly with charge and current.

    The current follows the power that is taken with the time constant of the file.

    Attributes:
        charge: [A h], shape (nworld,).
        current: [A], shape (nworld,).
        voltage: [V], shape (nworld,).
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags."""
        self._robot, self._simulation = robot, robot.simulation
        self._battery = parameters.require("battery_name", str)
        self._full = parameters.get("open_circuit_voltage_constant_coef", 12.0)
        self._slope = parameters.get("open_circuit_voltage_linear_coef", 0.0)
        self._capacity = parameters.get("capacity", 1.0)
        self._first = parameters.get("initial_charge", self._capacity)
        self._resistance = parameters.get("resistance", 0.0)
        self._tau = parameters.get("smooth_current_tau", 1.0)
        if self._capacity <= 0.0 or self._tau <= 0.0:
            raise SimulationError(
                "capacity and smooth_current_tau must be positive", source=parameters.source
            )
        nworld = robot.simulation.nworld
        self.charge: Floats = np.full(nworld, self._first)
        self.current: Floats = np.zeros(nworld)
        self.voltage: Floats = self._open_voltage()
        self._watch = Stopwatch(robot.simulation.clock)

    def _open_voltage(self) -> Floats:
        return np.asarray(self._full + self._slope * (1.0 - self.charge / self._capacity))

    def on_update(self, time: float) -> None:  # noqa: ARG002  the clock of the simulation counts
        """Discharge the battery."""
        interval = self._watch.lap()
        taken = sum(
            entry.plugin.power
            for entry in self._simulation.plugins
            if isinstance(entry.plugin, BatteryConsumer)
            and entry.plugin.robot is self._robot
            and entry.plugin.battery == self._battery
        )
        share = min(1.0, interval / self._tau)
        current = taken / np.maximum(self.voltage, 1e-3)
        self.current += share * (current - self.current)
        self.charge = np.maximum(self.charge - interval * self.current / 3600.0, 0.0)
        self.voltage = self._open_voltage() - self._resistance * self.current

    def reset(self, worlds: Worlds | None) -> None:
        """Charge the battery."""
        rows = slice(None) if worlds is None else worlds
        self.charge[rows], self.current[rows] = self._first, 0.0
        self.voltage[rows] = self._open_voltage()[rows]
        if worlds is None:
            self._watch.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return charge, current and voltage."""
        return {
            "charge": self.charge.copy(),
            "current": self.current.copy(),
            "voltage": self.voltage.copy(),
            "time": np.array(self._watch.start_ns),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.charge[:], self.current[:] = state["charge"], state["current"]
        self.voltage[:] = state["voltage"]
        self._watch.start_ns = int(np.asarray(state["time"]))
