"""Put a Stage world on a ROS 1 graph, with a master of its own where there is none."""

from __future__ import annotations

from gazelle.bridges.serving import join_graph
from gazelle.simulation import Simulation
from gazelle.stage import stage_of
from gazelle.stage.bridge.interface import StageInterface
from gazelle_ros import Master, Node
from gazelle_ros.base.closing import Closeable


class StageServer(Closeable):
    """A Stage world on a ROS 1 graph, and the node and master made for it.

    Attributes:
        interface: The topics and services.
        node: Called ``stageros``.
        master_uri: Of the master that it is on.
    """

    def __init__(
        self, interface: StageInterface, node: Node, master: Master | None, *, owned: bool = True
    ) -> None:
        self.interface, self.node = interface, node
        self.master_uri = node.master_uri
        self._master, self._owned = master, owned

    def run(self, seconds: float | None = None) -> None:
        """Run the world; see ``StageInterface.run``."""
        self.interface.run(seconds)

    def stop(self) -> None:
        """Stop ``run``; from any thread."""
        self.interface.stop()

    def close(self) -> None:
        """Leave the graph; stop the node and the master if they were started here."""
        self.interface.close()
        if self._owned:
            self.node.close()
        if self._master is not None:
            self._master.close()


def serve_stage(
    simulation: Simulation,
    on: str | Node | None = None,
    *,
    name: str = "stageros",
    host: str | None = None,
    world: int = 0,
    rate: float | str | None = "file",
    model_names: bool = False,
) -> StageServer:
    """Serve a Stage world on a ROS 1 graph as stage_ros does.

    The caller continues stepping it, or calls ``StageServer.run``.

    Args:
        simulation: Runs.
        on: A node, or the URI of a master to start one on; by default ``ROS_MASTER_URI``, else
            this machine's port 11311. Where no master answers on this machine, one is started.
        name: Of the node, if it is started here.
        host: The name other nodes reach that by; loopback by default.
        world: World of a batch that the graph uses.
        rate: Simulated seconds a wall second; ``"file"`` for what the world file's
            ``speedup`` says, None for as fast as possible.
        model_names: Name robots by their models instead of ``robot_N`` (``stageros -u``).

    Raises:
        MasterUnreachableError: There is no master, and none can be started at that address.
    """
    node, master = (on, None) if isinstance(on, Node) else join_graph(name, on, host)
    try:
        interface = StageInterface(
            simulation,
            node,
            world=world,
            rate=_pace(stage_of(simulation).description.speedup) if isinstance(rate, str) else rate,
            model_names=model_names,
        )
    except BaseException:
        if node is not on:
            node.close()
        if master is not None:
            master.close()
        raise
    return StageServer(interface, node, master, owned=node is not on)


def _pace(speedup: float) -> float | None:
    return speedup if speedup > 0.0 else None
