"""A simulation on a ROS 1 graph, as gazebo_ros_pkgs puts Gazebo on it."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

from gazelle.array_types import Worlds
from gazelle.bridges.binding import Binding
from gazelle.bridges.control import ManagerBinding
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.bridges.gazebo.finite import Handler, ignoring, refusing
from gazelle.bridges.gazebo.joints import JointServices
from gazelle.bridges.gazebo.lights import LightServices
from gazelle.bridges.gazebo.links import LinkServices
from gazelle.bridges.gazebo.models import ModelServices
from gazelle.bridges.gazebo.reconfigure import PhysicsReconfigure
from gazelle.bridges.gazebo.states import ClockPublisher, PerformancePublisher, StatesPublisher
from gazelle.bridges.gazebo.world import WorldServices
from gazelle.control import ControllerManager
from gazelle.errors import ControlWarning, RosError
from gazelle.simulation import Ports, Robot, Simulation
from gazelle.simulation.inputs import one_world
from gazelle.simulation.scheduled_plugin import make_scheduled
from gazelle_ros import Node, load_message, load_service
from gazelle_ros.base.closing import Closeable
from gazelle_ros.loggers import serve_loggers
from gazelle_ros.rosout_log import report_on_rosout

_MOVES = {
    *("spawn_sdf_model", "spawn_urdf_model", "set_model_state", "set_link_state"),
    *("set_model_configuration", "set_link_properties", "apply_body_wrench", "apply_joint_effort"),
}


class GazeboInterface(Closeable):
    """ROS interface of a simulation, as gazebo_ros_pkgs has it.

    Every service runs between two steps, also while the simulation is paused, and
    answers when what it says is true. After a reset, a spawn or steps of a paused world
    everything with subscribers is published once before the answer.

    Args:
        simulation: Runs, on whatever thread steps it.
        node: Called ``gazebo``; it stays open when the server is closed.
        world: World of the batch that the graph uses.
        monotonic_clock: Let ``/clock`` continue at a reset instead of back to zero.

    Attributes:
        context: State shared by the server's parts.
    """

    def __init__(
        self,
        simulation: Simulation,
        node: Node,
        *,
        world: int = 0,
        monotonic_clock: bool = False,
    ) -> None:
        world = one_world(world, simulation.nworld)
        self.context = GazeboContext(simulation, node, world, monotonic=monotonic_clock)
        self._simulation, self._node = simulation, node
        self._closing: list[Callable[[], None]] = []
        self._bindings: dict[str, Binding] = {}
        self._managers: dict[str, dict[ControllerManager, ManagerBinding]] = {}
        self._make_time()
        node.on_new_master.append(self._make_time)
        self._closing.append(lambda: node.on_new_master.remove(self._make_time))
        rate = float(node.get_param("~pub_clock_frequency", 0))
        self._clock = ClockPublisher(self.context, rate)
        self._states: StatesPublisher | None = None
        self._beats: list[ClockPublisher | StatesPublisher | PerformancePublisher] = [self._clock]
        # Plugins of the world speak for themselves, as in Gazebo.
        with simulation.lock:
            self._follow()
        self._closing.append(serve_loggers(node))
        reports = report_on_rosout(node)
        if reports is not None:
            self._closing.append(reports.close)
        if node.get_param("~enable_ros_network", True):
            self._open_network()
        self._closing.append(simulation.events.rested.subscribe(self._flush))
        entries = [make_scheduled(beat, type(beat).__name__, "") for beat in self._beats]
        with simulation.lock:
            simulation.plugins.extend(entries)
        self._entries = entries

    def _make_time(self) -> None:
        """Set nodes to simulated time, unless the parameter is set already."""
        if self._node.get_param("/use_sim_time", None) is None:
            self._node.set_param("/use_sim_time", True)

    def _open_network(self) -> None:
        self._states = StatesPublisher(self.context)
        self._beats += [self._states, PerformancePublisher(self.context)]
        self._serve()

    def _follow(self) -> None:
        """Open all present and future ports on the graph.

        Before there are services: what a client spawns at once is bound once.
        """
        events = self._simulation.events
        self._bind("", self._simulation.ports)
        for name, robot in self._simulation.robots.items():
            self._bind(name, robot)
        self._closing += [
            events.spawned.subscribe(lambda robot: self._bind(robot.name, robot)),
            events.managed.subscribe(self._bind_more),
            events.deleted.subscribe(lambda robot: self._unbind(robot.name)),
            events.reset.subscribe(self._after_reset),
        ]

    def publish(self) -> None:
        """Publish everything with subscribers, as it is now."""
        with self._simulation.lock:
            self._publish()

    def close(self) -> None:
        """Remove everything from the graph; the simulation continues."""
        with self._simulation.lock:
            self._leave()
        while self._closing:
            self._closing.pop()()
        for beat in self._beats:
            beat.close()

    # -- ports -----------------------------------------------------------------------------

    def _bind(self, name: str, ports: Ports | Robot) -> None:
        namespace = ports.namespace if isinstance(ports, Robot) else ""
        bound = self._bindings[name] = Binding(self.context, ports, namespace)
        if isinstance(ports, Robot):
            bound.when_known(lambda: self._bind_controllers(ports))

    def _bind_controllers(self, robot: Robot) -> None:
        """Open controllers on the graph once their robot is known."""
        bound = self._managers.setdefault(robot.name, {})
        for manager in robot.managers.values():
            if manager in bound:
                continue
            try:
                bound[manager] = ManagerBinding(self.context, manager)
            except RosError as error:
                text = (
                    f"the controllers of '{robot.name}' stay off the graph: {error}; give its "
                    "libgazebo_ros_control.so a <robotNamespace> of its own"
                )
                warnings.warn(ControlWarning(text), stacklevel=2)

    def _bind_more(self, robot: Robot) -> None:
        """Open later controllers of a robot that is on the graph already."""
        bound = self._bindings.get(robot.name)
        if bound is not None:
            bound.when_known(lambda: self._bind_controllers(robot))

    def _unbind(self, name: str) -> None:
        for manager in self._managers.pop(name, {}).values():
            manager.close()
        bound = self._bindings.pop(name, None)
        if bound is not None:
            bound.close()

    def _leave(self) -> None:
        plugins = self._simulation.plugins
        self._simulation.plugins[:] = [entry for entry in plugins if entry not in self._entries]
        for name in list(self._bindings):
            self._unbind(name)

    # -- what is published -------------------------------------------------------------------

    def _publish(self) -> None:
        self._clock.publish()
        for binding in self._bindings.values():
            binding.refresh()
        if self._states is not None:
            self._states.publish()
        self._flush()

    def _flush(self) -> None:
        """Send what waits for more to come."""
        self._clock.flush()
        if self._states is not None:
            self._states.flush()

    def _after_reset(self, _worlds: Worlds | None, rewound: bool) -> None:  # noqa: FBT001  an event's arguments
        if rewound:
            self.context.rewound()
        self._publish()

    # -- services ----------------------------------------------------------------------------

    def _serve(self) -> None:
        lights, links = LightServices(self.context), LinkServices(self.context)
        models, joints = ModelServices(self.context, lights), JointServices(self.context)
        world = WorldServices(self.context)
        self._offer("spawn_sdf_model", "SpawnModel", models.spawn, wait=False)
        self._offer("spawn_urdf_model", "SpawnModel", models.spawn_urdf, wait=False)
        handlers: dict[str, Handler] = {
            "delete_model": models.delete,
            "delete_light": lights.delete,
            "get_model_properties": models.get_properties,
            "get_model_state": models.get_state,
            "get_world_properties": world.get_properties,
            "get_joint_properties": joints.get_properties,
            "get_link_properties": links.get_properties,
            "get_link_state": links.get_state,
            "get_light_properties": lights.get,
            "set_light_properties": lights.set,
            "get_physics_properties": world.get_physics,
            "set_physics_properties": world.set_physics,
            "set_link_properties": links.set_properties,
            "set_model_state": models.set_state,
            "set_model_configuration": models.set_configuration,
            "set_joint_properties": joints.set_properties,
            "set_link_state": links.set_state,
            "apply_body_wrench": links.apply_wrench,
            "apply_joint_effort": joints.apply_effort,
        }
        for name, handler in handlers.items():
            self._offer(name, "".join(part.title() for part in name.split("_")), handler)
        self._offer("clear_joint_forces", "JointRequest", joints.clear_efforts)
        self._offer("clear_body_wrenches", "BodyRequest", links.clear_wrenches)
        self._offer_empty(world)
        self._offer_own(world)
        self._listen(models, links)
        reconfigure = PhysicsReconfigure(self.context, world)
        self._closing.append(reconfigure.close)

    def _offer_empty(self, world: WorldServices) -> None:
        for name, handler in {
            "pause_physics": self._then(world.pause, self._flush),
            "unpause_physics": world.unpause,
            "reset_simulation": world.reset_simulation,
            "reset_world": world.reset_world,
        }.items():
            self._offer(name, "Empty", handler, package="std_srvs")

    def _offer_own(self, world: WorldServices) -> None:
        for name, kind, handler in (
            ("step", "Step", self._then(world.step, self._publish)),
            ("seed", "Seed", world.seed),
            ("snapshot", "Snapshot", world.snapshot),
            ("restore", "Restore", self._then(world.restore, self._publish)),
            ("set_real_time_factor", "SetRealTimeFactor", world.set_real_time_factor),
        ):
            self._offer(f"/gazelle/{name}", kind, handler, package="gazelle_msgs")

    def _then(self, handler: Handler, after: Callable[[], None]) -> Handler:
        """Return a handler after which a function is called before the answer is sent."""

        def work(request: Any) -> Any:
            answer = handler(request)
            after()
            return answer

        return work

    def _offer(
        self,
        name: str,
        kind: str,
        handler: Handler,
        *,
        package: str = "gazebo_msgs",
        wait: bool = True,
    ) -> None:
        """Serve; between two steps if ``wait``, else the handler sees to it."""
        service = load_service(f"{package}/{kind}")
        response = service._response_class
        if name in _MOVES:
            handler = refusing(kind, handler)
        waiting = self._simulation.lock.wrap(handler)

        def answer(request: Any) -> Any:
            answer = waiting(request) if wait else handler(request)
            return response(**answer) if isinstance(answer, dict) else answer

        full = name if name.startswith("/") else f"~{name}"
        self._closing.append(self._node.serve(full, service, answer).close)

    def _listen(self, models: ModelServices, links: LinkServices) -> None:
        for name, kind, act in (
            ("set_model_state", "ModelState", models.set_state_of),
            ("set_link_state", "LinkState", links.set_state_of),
        ):
            subscriber = self._node.subscribe(
                f"~{name}",
                load_message(f"gazebo_msgs/{kind}"),
                self._between(ignoring(name, act)),
                10,
            )
            self._closing.append(subscriber.close)

    def _between(self, act: Handler) -> Handler:
        """Return a handler that runs between two steps."""
        return self._simulation.lock.wrap(act)
