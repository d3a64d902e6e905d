"""Common base of Hector's sensors on bodies."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

from gazelle.description import Parameters
from gazelle.plugins.hector_errors import Interval, SensorErrors
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.simulation import Output, PublisherSystem, Robot, absolute, namespace_of


class OnBody(Noisy, Publishing):
    """A sensor on a body, with errors."""

    def hold(self, robot: Robot, parameters: Parameters, kind: str) -> str:
        """Find the body; returns its name."""
        self._robot, self._simulation = robot, robot.simulation
        body = parameters.get("bodyName", next(iter(robot.links)))
        self._frame = robot.frame(body)
        self._name = f"{robot.name}::{body}::{kind}"
        self._interval = Interval()
        self._noises = {"interval": self._interval}
        return body

    def errors(self, parameters: Parameters, prefix: str, axes: int) -> SensorErrors:
        """Return the errors from the tags of a prefix."""
        simulation = self._simulation
        name = f"{self._name}::{prefix}"
        made = SensorErrors(parameters, prefix, axes, simulation.seed, name, simulation.nworld)
        self._noises[prefix or "errors"] = made
        return made

    def full(self, parameters: Parameters, name: str) -> str:
        """Return the full name of a topic or service."""
        return absolute(namespace_of(self._robot, parameters), name)

    def tune(self, parameters: Parameters, name: str, errors: SensorErrors) -> None:
        """Open the tuning of the errors."""
        made = errors.tuning(self.full(parameters, name))
        self._robot.tunings[name.strip("/")] = made

    def open_output(self, parameters: Parameters, topic: str, output: Output[Any]) -> None:
        """Publish on a topic."""
        output.topic = self.full(parameters, topic)
        self._robot.outputs[topic.strip("/")] = output
        self.published.append(output)


class SampledOnBody(OnBody):
    """A sensor on a body; its outputs publish one sample.

    Attributes:
        sample: Current sample; None outside of an update.
    """

    sample: Any = None

    @abstractmethod
    def measure(self) -> Any:
        """Return a new sample."""


class SampleSystem(PublisherSystem[SampledOnBody]):
    """Sensors on bodies that measure once for several outputs."""

    def publish(self, plugin: SampledOnBody, measured: Any) -> None:
        """Measure for all outputs of one sensor, and publish them."""
        plugin.sample = plugin.measure()
        super().publish(plugin, measured)
        plugin.sample = None
