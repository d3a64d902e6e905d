"""A controller manager and its controllers on a ROS graph (http://wiki.ros.org/controller_manager)."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.bridges.control import encoding  # noqa: F401  it teaches kinds
from gazelle.bridges.control.actions import ActionBridge
from gazelle.bridges.control.decoding import command_decoder_of, simulated
from gazelle.bridges.control.services import LOG, ManagerServices
from gazelle.bridges.conversions import ConversionContext, service_of
from gazelle.bridges.graph import TimedGraph
from gazelle.bridges.listening import OnDemandTopic
from gazelle.control import (
    ActionPort,
    CommandPort,
    Controller,
    ControllerManager,
    QueryPort,
    StatePort,
    TuningPort,
)
from gazelle.control.values import TrajectoryAnswer, TrajectoryQuery
from gazelle.errors import ControlError, ControlWarning, RosError
from gazelle_ros import load_message, load_service
from gazelle_ros.errors import ServiceError
from gazelle_ros.reconfigure import ReconfigureServer


class ManagerBinding:
    """A manager's services, and the ports of what it has loaded, until it is closed.

    Args:
        graph: Node of the services.
        manager: Of a robot; its topics and services are in its namespace.

    Raises:
        RosError: The node serves another manager in this namespace already.
    """

    def __init__(self, graph: TimedGraph, manager: ControllerManager) -> None:
        self._graph = graph
        self._space = f"/{manager.namespace.strip('/')}".rstrip("/")
        self._bound: dict[str, ControllerBinding] = {}
        self._services = ManagerServices(graph.node, self._space, manager)
        self._end_watch = manager.watch(self._bind, self._unbind)

    def close(self) -> None:
        """Remove it from the graph."""
        self._services.close()
        with contextlib.suppress(ValueError):
            self._end_watch()
        for name in list(self._bound):
            self._bound.pop(name).close()

    def _bind(self, controller: Controller) -> None:
        self._bound[controller.name] = ControllerBinding(self._graph, self._space, controller)

    def _unbind(self, controller: Controller) -> None:
        bound = self._bound.pop(controller.name, None)
        if bound is not None:
            bound.close()


class ControllerBinding:
    """The ports of one controller as topics, services and actions.

    Args:
        graph: Node of the topics.
        space: Namespace of the manager, without a slash at its end.
        controller: Of the manager.
    """

    def __init__(self, graph: TimedGraph, space: str, controller: Controller) -> None:
        self._graph, self._node, self._space = graph, graph.node, space
        self._worlds = np.array([graph.world])
        self._closing: list[Callable[[], None]] = []
        for ports, put in (
            (controller.outputs, self._publish),
            (controller.inputs, self._subscribe),
            (controller.queries, self._serve),
            (controller.actions, self._act),
            (controller.tunings, self._tune),
        ):
            for port in ports.values():
                self._open(put, port)

    def close(self) -> None:
        """Remove everything from the graph."""
        while self._closing:
            self._closing.pop()()

    def _open(self, put: Callable[[Any], Callable[[], None]], port: Any) -> None:
        """Open a port on the graph; one that fails is skipped, and the rest continues."""
        try:
            self._closing.append(put(port))
        except RosError as error:
            text = f"'{self._full(port.topic)}' stays off the graph: {error}"
            warnings.warn(ControlWarning(text), stacklevel=3)

    def _full(self, topic: str) -> str:
        return topic if topic.startswith("/") else f"{self._space}/{topic}"

    def _publish(self, port: StatePort[Any]) -> Callable[[], None]:
        view = ConversionContext("", self._graph.world, self._graph.stamp)
        topic = self._full(port.topic)
        return OnDemandTopic(
            self._graph, topic, port.kind, port.subscribe, view, queue_size=port.queue_size
        ).close

    def _subscribe(self, port: CommandPort[Any]) -> Callable[[], None]:
        decoder = command_decoder_of(port.kind)
        topic = self._full(port.topic)

        def receive(message: Any) -> None:
            try:
                port.send(decoder.read(message, self._graph), self._worlds)
            except ControlError as error:
                LOG.error("%s: %s", topic, error)

        subscriber = self._node.subscribe(
            topic, load_message(decoder.message), receive, port.queue_size
        )
        port.publishers = lambda: subscriber.num_connections
        return subscriber.close

    def _serve(self, port: QueryPort[Any, Any]) -> Callable[[], None]:
        if port.request is TrajectoryQuery:
            name, answer = "control_msgs/QueryTrajectoryState", self._sampling(port)
        else:
            codec = service_of(port.request, port.response)
            name = codec.service

            def answer(request: Any) -> Any:
                return codec.answer(port.call(codec.read(request)))

        def handle(request: Any) -> Any:
            try:
                return answer(request)
            except ControlError as error:
                LOG.error("%s: %s", self._full(port.topic), error)
                raise ServiceError(str(error)) from None

        return self._node.serve(self._full(port.topic), load_service(name), handle).close

    def _sampling(
        self, port: QueryPort[TrajectoryQuery, TrajectoryAnswer]
    ) -> Callable[[Any], dict[str, Any]]:
        """Return a handler that answers with joint positions at a time."""

        def answer(request: Any) -> dict[str, Any]:
            found = port.call(TrajectoryQuery(simulated(request.time, self._graph)))
            sample, world = found.sample, self._graph.world
            fields = {
                "position": sample.positions,
                "velocity": sample.velocities,
                "acceleration": sample.accelerations,
            }
            rows = {
                key: value[world].tolist() for key, value in fields.items() if value is not None
            }
            return {"name": list(found.names), **rows}

        return answer

    def _act(self, port: ActionPort[Any]) -> Callable[[], None]:
        return ActionBridge(self._graph, self._full(port.topic), port).close

    def _tune(self, port: TuningPort) -> Callable[[], None]:
        return ReconfigureServer(self._node, self._full(port.topic), port).close
