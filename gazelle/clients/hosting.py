"""Start and stop a simulator as a process of its own: no window, no killall, no sleep."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from gazelle.argument_checks import checked
from gazelle.clients.errors import ClientError
from gazelle.clients.gazebo import Gazebo
from gazelle_ros import net
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.errors import MasterUnreachableError, RosError
from gazelle_ros.tools import nodes as node_tools
from gazelle_ros.tools.graph import GraphInspector

_POLL_S = 0.05
_END_S = 10.0


@checked(ClientError, after=True)
class SimulatorProcess(Closeable):
    """A Gazelle on a ROS 1 graph; also a context manager.

    It is there when the constructor returns, and gone when ``close`` does.

    Args:
        world: A file or the name of a bundled world.
        robots: To put there at once: files or names of bundled robots.
        rate: Real-time factor; None for as fast as possible.
        paused: Whether time stands still at the beginning.
        seed: Decides all random numbers.
        options: More of ``gazelle run``, such as ``["--plugins", "my_plugins"]``.
        master_uri: Of the master; by default ``ROS_MASTER_URI``. It starts one if there is none.
        timeout: For the simulator to be there [s of wall time].

    Attributes:
        gazebo: A client of it.

    Raises:
        ClientError: There is a simulator on the graph already; or this one ends at once, or is
            not there in time: the message has its errors.
    """

    def __init__(
        self,
        world: str | Path = "empty",
        *,
        robots: Sequence[str | Path] = (),
        rate: float | None = 1.0,
        paused: bool = False,
        seed: int = 0,
        options: Sequence[str] = (),
        master_uri: str | None = None,
        timeout: float = 60.0,
    ) -> None:
        uri = master_uri or net.default_master_uri()
        command = [sys.executable, "-m", "gazelle", "run", str(world), "--ros"]
        command += ["--rate", "max" if rate is None else str(rate), "--seed", str(seed)]
        command += ["--paused"] if paused else []
        for robot in robots:
            command += ["--spawn", str(robot)]
        command += options
        _refuse_another(uri)
        # A file, for a pipe without a reader would stop a simulator that says much.
        self._stderr = tempfile.TemporaryFile()  # noqa: SIM115  # it is closed with the process
        self._process = subprocess.Popen(  # noqa: S603  # this very program
            command,
            env={**os.environ, "ROS_MASTER_URI": uri},
            stdout=subprocess.DEVNULL,
            stderr=self._stderr,
        )
        try:
            self.gazebo = self._wait(uri, timeout)
        except BaseException:
            self._end()
            raise

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    @property
    def running(self) -> bool:
        """True if it is running."""
        return self._process.poll() is None

    def close(self) -> None:
        """Stop it and wait until it has ended."""
        self.gazebo.close()
        self._end()

    def _wait(self, uri: str, timeout: float) -> Gazebo:
        deadline = deadline_after(timeout)
        while True:
            if not self.running:
                self._stderr.seek(0)
                errors = self._stderr.read().decode(errors="replace").strip()
                raise ClientError(f"the simulator ended at once: {errors}")
            try:
                return _client(uri)
            except RosError:
                if time.monotonic() > deadline:
                    raise ClientError(f"the simulator did not start within {timeout:g} s") from None
                time.sleep(_POLL_S)

    def _end(self) -> None:
        self._process.terminate()
        try:
            self._process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._stderr.close()


def _client(uri: str) -> Gazebo:
    """Return a client of the simulator that is there.

    Raises:
        RosError: None is, yet.
    """
    gazebo = Gazebo(master_uri=uri)
    try:
        gazebo.node.wait_for_service("/gazebo/get_world_properties", timeout=1.0)
    except BaseException:
        gazebo.close()
        raise
    return gazebo


def _refuse_another(uri: str) -> None:
    """Check that no other simulator is running, which could be taken for the new one."""
    with contextlib.suppress(MasterUnreachableError), GraphInspector("clients", uri) as graph:
        if node_tools.alive(graph, "/gazebo"):
            raise ClientError(
                "a simulator is already running on this graph: /gazebo",
                hint="stop it, or set another master_uri",
            )
