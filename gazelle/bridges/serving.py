"""Put a simulation on a ROS 1 graph, with a master of its own where there is none."""

from __future__ import annotations

import contextlib
import socket
import threading
from typing import Self

from gazelle.bridges.gazebo import GazeboInterface
from gazelle.bridges.pacing import Pacer
from gazelle.errors import RosError
from gazelle.simulation import Simulation
from gazelle_ros import Master, Node, WallClock, net
from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import ApiError, MasterUnreachableError, UnreachableError
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.nodes import process_of


class RosServer(Closeable):
    """A simulation on a ROS 1 graph; also a context manager.

    Attributes:
        node: Called ``gazebo``.
        master_uri: Of the master that it is on.
        gazebo: The services, topics and ports.
    """

    def __init__(
        self,
        simulation: Simulation,
        node: Node,
        master: Master | None,
        *,
        world: int,
        monotonic_clock: bool,
    ) -> None:
        self.node = node
        self.master_uri = node.master_uri
        self._master = master
        self._pacer = Pacer(simulation)
        self._thread: threading.Thread | None = None
        self.gazebo = GazeboInterface(
            simulation, node, world=world, monotonic_clock=monotonic_clock
        )
        node.on_shutdown.append(lambda _reason: self._pacer.stop())

    def run(self, seconds: float | None = None) -> None:
        """Run the simulation until ``stop``, at the pace of its physics properties.

        Args:
            seconds: Simulated time at which to end; None for never.
        """
        self._pacer.run(seconds)

    def start(self) -> Self:
        """Start ``run`` in a thread of its own, until ``close`` or ``stop``; returns this."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._pacer.run, name="simulator", daemon=True)
            self._thread.start()
        return self

    def stop(self) -> None:
        """Stop ``run``; from any thread."""
        self._pacer.stop()

    def close(self) -> None:
        """Leave the graph, and stop the master if it was started here."""
        self.stop()
        if self._thread is not None:
            self._thread.join()
        self.gazebo.close()
        self.node.close()
        if self._master is not None:
            self._master.close()


def serve_ros(
    simulation: Simulation,
    master_uri: str | None = None,
    *,
    name: str = "gazebo",
    host: str | None = None,
    world: int = 0,
    monotonic_clock: bool = False,
) -> RosServer:
    """Serve a simulation on a ROS 1 graph as Gazebo's ROS packages do.

    The caller continues stepping it, or calls ``RosServer.run``.

    Args:
        simulation: Runs.
        master_uri: Of the master; by default ``ROS_MASTER_URI``, else this machine's port
            11311. Where none answers on this machine, one is started.
        name: Of the node.
        host: The name other nodes reach it by; loopback by default.
        world: World of the batch that the graph uses.
        monotonic_clock: Let ``/clock`` continue at a reset instead of back to zero.

    Raises:
        MasterUnreachableError: There is no master, and none can be started at that address.
    """
    node, master = join_graph(name, master_uri, host)
    try:
        return RosServer(simulation, node, master, world=world, monotonic_clock=monotonic_clock)
    except BaseException:
        node.close()
        if master is not None:
            master.close()
        raise


def refuse_twin(name: str, master_uri: str | None = None) -> None:
    """Check that no simulator of a name is on the graph, for a second would end the first.

    One that does not answer any more is no obstacle.

    Args:
        name: Of the node.
        master_uri: Of the master; by default ``ROS_MASTER_URI``, else this machine's port 11311.

    Raises:
        RosError: There is one.
    """
    with (
        GraphInspector("gazelle", master_uri) as graph,
        contextlib.suppress(UnreachableError, ApiError),
    ):
        node = graph.resolve(name)
        process = process_of(graph, node)
        if process is None:
            return
        raise RosError(
            f"a simulator is already running on this graph: {node}, process {process}",
            hint="stop it, or set another port in ROS_MASTER_URI, such as http://localhost:11312",
        )


def join_graph(
    name: str, master_uri: str | None = None, host: str | None = None
) -> tuple[Node, Master | None]:
    """Return a node, and the master that was started for it if none answered on this machine.

    Args:
        name: Of the node.
        master_uri: Of the master; by default ``ROS_MASTER_URI``, else this machine's port 11311.
        host: The name other nodes reach it by; loopback by default.

    Raises:
        MasterUnreachableError: There is no master, and none can be started at that address.
    """
    uri = master_uri or net.default_master_uri()
    clock = WallClock()  # the source of time does not wait for /clock
    try:
        return Node(name, master_uri=uri, host=host, clock=clock), None
    except MasterUnreachableError:
        master = _start_master(uri)
    try:
        return Node(name, master_uri=master.uri, host=host, clock=clock), master
    except BaseException:
        master.close()
        raise


def _start_master(uri: str) -> Master:
    """Start a master at a URI of this machine."""
    host, port, _ = net.split_uri(uri)
    if host not in {"localhost", net.LOOPBACK, net.default_host(), socket.gethostname()}:
        raise MasterUnreachableError(
            f"there is no master at {uri}", hint="start it there, or unset ROS_MASTER_URI"
        )
    return Master(host, port)
