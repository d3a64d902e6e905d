"""Put the ports of a robot or of the world on a ROS graph."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.bridges import (  # noqa: F401  they teach kinds
    picture_conversions,
    plugin_conversions,
    sensor_conversions,
)
from gazelle.bridges.conversions import ConversionContext, decoder_of, service_of
from gazelle.bridges.graph import Graph
from gazelle.bridges.listening import OnDemandTopic
from gazelle.errors import RosError, SimulationError, SimulationWarning
from gazelle.simulation import (
    FramePrefix,
    Input,
    Output,
    Ports,
    Service,
    Setting,
    Tuning,
    TwistInput,
)
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle_ros import load_message, load_service
from gazelle_ros.msgs import geometry_msgs
from gazelle_ros.reconfigure import ReconfigureServer
from gazelle_ros.tf.naming import FramePrefixes

_LOOK_S = 0.1
_MISSING = (None, "")
"""Values that count as unset; launch files set an empty text where they have nothing to say."""


def _nothing() -> None:
    """Do nothing."""


class Binding:
    """The ports of one owner as topics and services, until it is closed.

    A topic without subscribers costs nothing: its port is subscribed only while there are
    subscribers. Settings are looked up on the parameter server before all else; tunings become
    dynamic_reconfigure servers.

    Args:
        graph: Node of the topics.
        ports: Of a robot or of the world.
        namespace: Of the robot.
    """

    def __init__(self, graph: Graph, ports: Ports, namespace: str = "") -> None:
        self._graph = graph
        self._simulation = graph.simulation
        self._node = graph.node
        self._worlds = np.array([graph.world])
        self._closing: list[Callable[[], None]] = []
        self._closed = False
        self._prefixes, self._namespace = FramePrefixes(graph.node), namespace
        self._awaited = [each for each in ports.settings.values() if not self._look_up(each)]
        self._when_known: Callable[[], None] = _nothing
        self._outputs: list[Output[Any]] = []
        for output in ports.outputs.values():
            if self._open(self._publish, output):
                self._outputs.append(output)
        for port in ports.inputs.values():
            self._open(self._subscribe, port)
        for service in ports.services.values():
            self._open(self._serve, service)
        for tuning in ports.tunings.values():
            self._open(self._tune, tuning)

    def refresh(self) -> None:
        """Publish the present values to all subscribers."""
        for output in tuple(self._outputs):
            if output.event:
                continue
            try:
                output.publish()
            except Exception as error:  # noqa: BLE001  a plugin's fault is not the graph's
                self._outputs.remove(output)
                name = f"the topic '{output.topic}'"
                warn_of_fault(output, name, "to tell what is true now", error)

    def close(self) -> None:
        """Remove the topics and services from the graph."""
        self._closed = True
        while self._closing:
            self._closing.pop()()

    def _open(self, put: Callable[[Any], None], port: Any) -> bool:
        """Open a port on the graph; one that fails is skipped, and the rest continues."""
        try:
            put(port)
        except RosError as error:
            text = f"'{port.topic}' stays off the graph: {error}"
            warnings.warn(SimulationWarning(text), stacklevel=3)
            return False
        return True

    def when_known(self, act: Callable[[], None]) -> None:
        """Call a function between two steps, once all required settings are known."""
        if not self._awaited:
            act()
            return
        self._when_known = act
        self._look_later()

    def _look_later(self) -> None:
        """Check awaited settings again soon; on a worker, for the master may be far away."""
        self._node.loop.call_later(_LOOK_S, lambda: self._node.loop.submit(self._look_again))

    def _look_again(self) -> None:
        if self._closed or self._node.closed:
            return
        found = [(each, self._value_of(each)) for each in self._awaited]
        if any(value in _MISSING for _, value in found):
            self._look_later()
            return

        def take() -> None:
            if not self._closed:
                self._awaited.clear()
                for setting, value in found:
                    self._give(setting, value)
                self._when_known()

        self._simulation.lock.post(take)

    def _look_up(self, setting: Setting[Any]) -> bool:
        """Read a setting's parameter; return True when it no longer needs to be awaited."""
        value = self._value_of(setting)
        if value in _MISSING:
            return not setting.awaited
        self._give(setting, value)
        return True

    def _value_of(self, setting: Setting[Any]) -> Any:
        """Return the parameter of a setting, or the nearest one above; None if there is none."""
        space, _, name = setting.name.rpartition("/")
        while True:
            value = self._node.get_param(f"{space}/{name}", None)
            if value is not None or not space or not setting.search:
                return value
            space = space.rpartition("/")[0]

    @staticmethod
    def _give(setting: Setting[Any], value: Any) -> None:
        try:
            setting.send(value)
        except SimulationError as error:
            warnings.warn(SimulationWarning(f"parameter: {error}"), stacklevel=2)

    def _publish(self, output: Output[Any]) -> None:
        view = ConversionContext(
            output.frame, self._graph.world, self._graph.stamp, self._prefix(output)
        )
        topic = OnDemandTopic(
            self._graph,
            output.topic,
            output.kind,
            output.subscribe,
            view,
            queue_size=output.queue_size,
            latch=output.latch,
        )
        if output.latch:
            topic.send(output.last)
        self._closing.append(topic.close)

    def _prefix(self, output: Output[Any]) -> str:
        """Return the prefix of an output's frame names."""
        place = output.namespace
        if place is None:
            place = output.topic.rpartition("/")[0] or self._namespace
        if output.prefix is FramePrefix.NEAREST:
            return self._prefixes.of(place)
        if output.prefix is FramePrefix.NONE:
            return ""
        own = self._prefixes.own(place)
        below = place.removeprefix(self._simulation.ports.namespace)
        return own if output.prefix is FramePrefix.OWN else below.strip("/") or own

    def _subscribe(self, port: TwistInput | Input[Any]) -> None:
        if isinstance(port, TwistInput):
            subscriber = self._node.subscribe(
                port.topic, geometry_msgs.msg.Twist, self._twist_into(port), 1
            )
        else:
            decoder = decoder_of(port.kind)

            def receive(message: Any) -> None:
                value = decoder.read(message)
                with self._simulation.lock:
                    port.send(value, self._worlds)

            subscriber = self._node.subscribe(
                port.topic, load_message(decoder.message), receive, port.queue_size
            )
        self._closing.append(subscriber.close)

    def _twist_into(self, port: TwistInput) -> Callable[[Any], None]:
        def receive(message: geometry_msgs.msg.Twist) -> None:
            linear, angular = message.linear, message.angular
            forward = np.array([[linear.x, linear.y, linear.z]])
            turning = np.array([[angular.x, angular.y, angular.z]])
            with self._simulation.lock:
                port.send(forward, turning, self._worlds)

        return receive

    def _serve(self, service: Service[Any, Any]) -> None:
        codec = service_of(service.request, service.response)
        service_class = load_service(codec.service)

        def answer(request: Any) -> Any:
            call = codec.read(request)
            with self._simulation.lock:
                answer = service.call(call, self._worlds)
            return service_class._response_class(**codec.answer(answer))

        if self._is_free(service.topic):
            server = self._node.serve(service.topic, service_class, answer)
            self._closing.append(server.close)

    def _tune(self, tuning: Tuning) -> None:
        if self._is_free(f"{tuning.topic}/set_parameters"):
            server = ReconfigureServer(self._node, tuning.topic, tuning)
            self._closing.append(server.close)

    def _is_free(self, service: str) -> bool:
        """Return whether a service is not offered here yet; warn if it is."""
        if all(server.name != service for server in self._node.services()):
            return True
        warnings.warn(
            SimulationWarning(
                f"the service {service} is offered by another plugin already; give this one, or its "
                "model, a name or namespace of its own"
            ),
            stacklevel=3,
        )
        return False
