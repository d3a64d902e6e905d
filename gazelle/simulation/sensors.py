"""Sensors of a running robot: measured at their own rate, on demand."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Worlds
from gazelle.description import Sensor
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import SimulationError
from gazelle.sensors import GroupedModel, SensorModel
from gazelle.simulation.clock import Schedule
from gazelle.simulation.inputs import chosen, is_ascending, one_world
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.ports import FramePrefix, Output
from gazelle.simulation.running_state import RunningState
from gazelle.simulation.sensor_groups import SensorGroup
from gazelle.simulation.state_lock import between_steps

_NO_WORLDS = np.zeros(0, np.intp)


class SampledSensor:
    """Sensor that measures at its own rate; with its robot it is a ``SensorUnit``.

    It sleeps until it is read or subscribed to; then it measures at its ``update_rate``.

    Attributes:
        description: Settings of the file.
    """

    def __init__(
        self, simulation: RunningState, sensor: Sensor, name: str, model: SensorModel
    ) -> None:
        self.description = sensor
        self._simulation = simulation
        self.name = name
        self._model = model
        self._lock = simulation.lock
        self.schedule = Schedule(sensor.update_rate)
        self.schedule.done(simulation.clock.now_ns)
        self._values: NDArray[Any] | None = None
        self._stale = _NO_WORLDS
        self._stamp = 0
        self._awake = False
        self._listeners: list[Callable[[Self], None]] = []
        self._group: SensorGroup | None = None
        self._part = self._seen = 0

    @property
    def model(self) -> SensorModel:
        """Measures now, in any world; to be used by threads that hold the simulation's lock."""
        return self._model

    @property
    def awake(self) -> bool:
        """True if it measures at its rate."""
        return self._awake or bool(self._listeners)

    @checked(SimulationError)
    @between_steps
    def limit_rate(self, rate: float) -> None:
        """Measure no more often than a rate [Hz]; 0 changes nothing."""
        if rate > 0.0 and not 0.0 < self.schedule.rate <= rate:
            self._stand_alone()
            self.schedule.rate = rate

    @between_steps
    def measure(self, worlds: Worlds | None = None) -> NDArray[Any]:
        """Measure now, out of turn, shape (n, channels); the last reading stays as it is."""
        some = chosen(worlds, self._lock.nworld)
        if some is None or is_ascending(some):
            return self._model.measure(some, self.period)
        order = np.argsort(some)
        return self._model.measure(some[order], self.period)[np.argsort(order)]

    @between_steps
    def read(self, world: int = 0) -> Any:
        """Return the last reading of one world: a LaserScan, an ImuReading, ....

        See ``gazelle.sensors``.

        The first call measures at once and wakes the sensor.
        """
        values = self._woken()
        return self._model.reading(values[one_world(world, len(values))], self._stamp)

    @between_steps
    def latest(self) -> NDArray[Any]:
        """Return the last reading of all worlds, shape (nworld, channels); wakes the sensor."""
        return self._woken()

    def _woken(self) -> NDArray[Any]:
        if not self._awake:
            self._awake = True
            self._lock.changes += 1
        return self._current()

    @between_steps
    def current(self) -> NDArray[Any]:
        """Return the last reading without waking the sensor.

        Measures if it sleeps or never measured.
        """
        return self._current()

    def _current(self) -> NDArray[Any]:
        if not (self._awake or self._listeners):
            return self.measure()
        group = self._group
        if group is not None and self._seen != group.count:
            self._catch_up()
        if self._values is None:
            return self.update(self._simulation.clock.now_ns)
        if len(self._stale):
            self._values = self._values.copy()
            self._values[self._stale] = self.measure(self._stale)
            self._stale = _NO_WORLDS
        return self._values

    @between_steps
    def reading(self, values: NDArray[Any]) -> Any:
        """Return values by name."""
        self._catch_up()
        return self._model.reading(values, self._stamp)

    @between_steps
    def subscribe(self, listener: Callable[[Self], None]) -> Callable[[], None]:
        """Call a function after every measurement; returns what ends it."""
        self._listeners.append(listener)
        self._lock.changes += 1
        return lambda: self._end(listener)

    @between_steps
    def _end(self, listener: Callable[[Self], None]) -> None:
        if listener in self._listeners:
            self._listeners.remove(listener)
            self._lock.changes += 1

    def retire(self) -> None:
        """Retire the sensor from the schedule when its robot is gone."""
        self._awake = False
        self._listeners.clear()

    @between_steps
    def update(self, now_ns: int) -> NDArray[Any]:
        """Measure in turn; returns what ``latest`` will until the next time."""
        if self._values is None:
            self._lock.changes += 1  # from now on it may be measured with others
        values = self._values = self.measure()
        self._stale, self._stamp = _NO_WORLDS, now_ns
        self.schedule.done(now_ns)
        self.notify()
        return values

    def notify(self: Self) -> None:
        """Call all subscribers."""
        for listener in tuple(self._listeners):
            listener(self)

    @between_steps
    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers and start them again."""
        self._model.reseed(seed, worlds)

    @between_steps
    def reset(self, worlds: Worlds | None) -> None:
        """Discard drifts and readings; for all worlds, also earlier reads.

        Readings of the other worlds stay as they are, whichever worlds are reset.
        """
        self._catch_up()
        self._model.reset(worlds)
        if worlds is not None:
            if self._values is not None:
                self._stale = np.union1d(self._stale, worlds)
            return
        self._lock.changes += 1
        self._values, self._stale, self._stamp, self._awake = None, _NO_WORLDS, 0, False
        self.schedule.done(self._simulation.clock.now_ns)

    @between_steps
    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        self._catch_up()
        state = dict(self._model.state())
        state["stamp"] = np.array([self._stamp, int(self._awake), self.schedule.count])
        state["stale"] = self._stale
        if self._values is not None:
            state["values"] = self._values.copy()
        return state

    @between_steps
    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._stand_alone()
        own = dict(state)
        stamp = own.pop("stamp")
        values: Any = own.pop("values", None)
        stale = np.asarray(own.pop("stale"), np.intp)
        if stale.size and not 0 <= stale.min() <= stale.max() < self._simulation.nworld:
            raise IndexError("a reading belongs to an unknown world")
        self._stale = stale
        self._model.restore(own)
        self._stamp, self._awake = int(stamp[0]), bool(stamp[1])
        self._values = values
        self.schedule.count = int(stamp[2])

    # -- measuring together ------------------------------------------------------------

    def system(self) -> Hashable | None:
        """Return a key that is equal for sensors that a ``SensorGroup`` can measure, or None."""
        if self._values is None or not isinstance(self._model, GroupedModel):
            return None
        system = self._model.system()
        return None if system is None else (system, self.schedule.rate, self.schedule.due_ns)

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""
        return bool(self._listeners)

    def join(self, group: SensorGroup, part: int) -> None:
        """Join a group that measures together."""
        self._group, self._part, self._seen = group, part, group.count
        self.schedule = group.schedule

    def leave(self) -> None:
        """Leave the group and measure alone again, with its last readings."""
        self._catch_up()
        if self._group is not None:
            self.schedule = self._group.schedule.copy()
        self._group = None

    def _catch_up(self) -> None:
        """Take over what the group measured in the meantime."""
        group = self._group
        if group is not None and self._seen != group.count:
            self._seen, self._stale = group.count, _NO_WORLDS
            self._values, self._stamp = group.reading(self._part)

    def _stand_alone(self) -> None:
        """Leave all groups until they are made again."""
        if self._group is not None:
            self._group.release()
        self._lock.changes += 1

    @property
    def period(self) -> float:
        """Time between two measurements in turn [s]."""
        if self.schedule.rate > 0.0:
            return 1.0 / self.schedule.rate
        return self._simulation.clock.step_ns / NANOSECONDS


class SensorOutput(Output[Any]):
    """The readings of a sensor: a subscriber wakes it.

    Args:
        sensor: Measures, in all worlds.
        topic: Topic name from the file.
        kind: Type of its readings.
        frame: Frame of the readings.
        read: The reading from the sensor; its own kind of reading if None.
        namespace: Namespace of the frames; that of the topic if None.
        prefix: Prefix of the frame on a graph.
    """

    def __init__(
        self,
        sensor: SampledSensor,
        topic: str,
        kind: type[Any],
        *,
        frame: str = "",
        read: Callable[[], Any] | None = None,
        namespace: str | None = None,
        prefix: FramePrefix = FramePrefix.NEAREST,
    ) -> None:
        super().__init__(
            topic,
            kind,
            read or (lambda: sensor.reading(sensor.current())),
            frame=frame,
            namespace=namespace,
            prefix=prefix,
        )
        self._sensor = sensor
        self._asleep: Callable[[], None] | None = None
        self._failed = False

    @between_steps
    def subscribe(self, listener: Callable[[Any], None]) -> Callable[[], None]:
        """Call a function with every reading; returns what ends it."""
        end = super().subscribe(listener)
        if self._asleep is None:
            self._asleep = self._sensor.subscribe(self._on_reading)

        def finish() -> None:
            end()
            if not self.has_subscribers and self._asleep is not None:
                self._asleep()
                self._asleep = None

        return finish

    def _on_reading(self, _sensor: SampledSensor) -> None:
        """Publish a new reading; stops for good if the plugin cannot read it."""
        if self._failed or not self.has_subscribers:
            return
        try:
            value = self._produce()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self._failed = True
            name = f"the topic '{self.topic}' of '{self._sensor.name}'"
            warn_of_fault(None, name, "and is published no more", error)
            return
        self.publish_computed(value)
