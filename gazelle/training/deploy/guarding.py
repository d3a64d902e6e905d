"""The node's end of the pipe to its guard."""

from __future__ import annotations

import contextlib
import json
import os
import select
import subprocess
import sys
import time
from typing import IO, Any

from gazelle.errors import Error
from gazelle.training.deploy import guard
from gazelle.training.deploy.safety import STAND, VelocityCommand

_START_S = 60.0
_END_S = 10.0


class GuardLostError(Error):
    """The guard ended, so nothing would stop the robot if the node did."""


class Guarded:
    """Starts a guard and sends it the robot's commands.

    Args:
        node: Arguments of the guard's `gazelle_ros.Node`.
        topic: Of the commands, ``geometry_msgs/Twist``.
        timeout: The robot stands when the node is silent for so long [s of wall time].

    Raises:
        GuardLostError: It did not start.
    """

    def __init__(self, node: dict[str, Any], topic: str, *, timeout: float = 0.5) -> None:
        options = json.dumps({"node": node, "topic": topic, "timeout": timeout})
        self._process = subprocess.Popen(  # noqa: S603  # this Python, and a module of our own
            [sys.executable, "-P", "-m", guard.__name__, options],  # -P: not what lies about here
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # so that Ctrl-C and a kill of the group do not reach it
        )
        self._await_ready()

    @property
    def pid(self) -> int:
        """Number of the guard's process."""
        return self._process.pid

    def order(self, command: VelocityCommand, *, active: bool) -> None:
        """Send a command; call it several times a second.

        Args:
            command: Command to send.
            active: Whether the node has a say; if not, others may drive.

        Raises:
            GuardLostError: The guard is gone.
        """
        frame = guard.ORDER.pack(active, command.linear, command.angular)
        try:
            _pipe(self._process.stdin).write(frame)
        except OSError as error:
            raise GuardLostError("the guard of the deployed policy is gone") from error

    def close(self) -> None:
        """Stop the robot and the guard; a second call does nothing."""
        with contextlib.suppress(Error):
            self.order(STAND, active=False)
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()
        try:
            self._process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _await_ready(self) -> None:
        pipe, said = _pipe(self._process.stdout), b""
        deadline = time.monotonic() + _START_S
        while guard.READY not in said:
            left = deadline - time.monotonic()
            readable, _, _ = select.select([pipe], [], [], max(left, 0.0))
            data = os.read(pipe.fileno(), 4096) if readable else b""
            if not data:
                self.close()
                raise GuardLostError("the guard of the deployed policy did not start")
            said += data


def _pipe(pipe: IO[bytes] | None) -> IO[bytes]:
    if pipe is None:
        raise GuardLostError("the guard of the deployed policy has no pipe")
    return pipe
