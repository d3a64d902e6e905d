"""Start and stop a simulator as a process of its own: no window, no killall, no sleep."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

from gazelle.clients.errors import ClientError
from gazelle.clients.gazebo import Gazebo
from gazelle.ros import net
from gazelle.ros.errors import RosError

_POLL_S = 0.05
_END_S = 10.0


class SimulatorProcess:
    """A Gazelle on a ROS 1 graph; also a context manager.

    It is there when the constructor returns, and gone when ``close`` does.

    Args:
        world: A file or the name of a bundled world.
        robots: To put there at once: files or names of bundled robots.
        rate: Real-time factor; None for as fast as possible.
        paused: Whether time stands still at the beginning.
        seed: Decides all random numbers.
        master_uri: Of the master; by default ``ROS_MASTER_URI``. It starts one if there is none.
        timeout: For the simulator to be there [s of wall time].

    Attributes:
        gazebo: A client of it.

    Raises:
        ClientError: It ends at once, or is not there in time; the message has what it said.
    """

    def __init__(
        self,
        world: str | Path = "empty",
        *,
        robots: Sequence[str | Path] = (),
        rate: float | None = 1.0,
        paused: bool = False,
        seed: int = 0,
        master_uri: str | None = None,
        timeout: float = 60.0,
    ) -> None:
        uri = master_uri or net.default_master_uri()
        command = [sys.executable, "-m", "gazelle", "run", str(world), "--ros"]
        command += ["--rate", "max" if rate is None else str(rate), "--seed", str(seed)]
        command += ["--paused"] if paused else []
        for robot in robots:
            command += ["--spawn", str(robot)]
        self._process = subprocess.Popen(  # noqa: S603  # this very program
            command,
            env={**os.environ, "ROS_MASTER_URI": uri},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            self.gazebo = self._wait(uri, time.monotonic() + timeout, timeout)
        except BaseException:
            self._end()
            raise

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    @property
    def running(self) -> bool:
        """Whether it runs."""
        return self._process.poll() is None

    def close(self) -> None:
        """End it and wait until it is gone."""
        self.gazebo.close()
        self._end()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _wait(self, uri: str, deadline: float, timeout: float) -> Gazebo:
        while True:
            if not self.running:
                said = self._process.stderr.read().strip() if self._process.stderr else ""
                raise ClientError(f"the simulator ended at once: {said}")
            try:
                gazebo = Gazebo(master_uri=uri)
                gazebo.node.wait_for_service("/gazebo/get_world_properties", timeout=1.0)
            except RosError:
                if time.monotonic() > deadline:
                    raise ClientError(f"the simulator is not there after {timeout:g} s") from None
                time.sleep(_POLL_S)
                continue
            return gazebo

    def _end(self) -> None:
        self._process.terminate()
        try:
            self._process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        if self._process.stderr is not None:
            self._process.stderr.close()
