"""A master in a process of its own, which MASTER_COMMAND starts; ``{port}`` in it is the port."""

from __future__ import annotations

import os
import shlex
import socket
import subprocess
import time
import xmlrpc.client


class Master:
    """What rostest and roslaunch need of a master."""

    def __init__(self, port: int = 11311, num_workers: int = 3) -> None:
        del num_workers
        self.port = port or _free_port()
        self.uri = ""
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it and wait until it answers."""
        self.uri = f"http://127.0.0.1:{self.port}/"
        command = os.environ["MASTER_COMMAND"].format(port=self.port)
        environment = os.environ | {"PYTHONPATH": "", "ROS_MASTER_URI": self.uri}
        self._process = subprocess.Popen(
            shlex.split(command), stdout=subprocess.DEVNULL, env=environment
        )
        deadline = time.monotonic() + 20.0
        while time.monotonic() < deadline and self.ok():
            try:
                xmlrpc.client.ServerProxy(self.uri).getPid("/waiting")
            except OSError:
                time.sleep(0.02)
            else:
                return
        raise RuntimeError(f"no master came of: {command}")

    def stop(self) -> None:
        """End it."""
        if self._process is not None:
            self._process.terminate()
            self._process.wait()

    def ok(self) -> bool:
        """Return whether it runs."""
        return self._process is not None and self._process.poll() is None


def _free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])
