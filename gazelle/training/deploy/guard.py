"""The guard: a process of its own that holds the topic of commands and outlives the node.

The node writes to it through a pipe what the robot is to do, many times a second. When the pipe ends,
because the node ended in whatever way (`SIGKILL` too), or when nothing comes through it for a while
(the node hangs or was stopped), the guard sends the robot zero. As it is the only publisher, nothing
of the node can come after that. It ignores Ctrl-C and SIGTERM, which end the node.

Run as ``python -m gazelle.training.deploy.guard OPTIONS``, options being JSON: ``node`` (what
`gazelle_ros.Node` takes), ``topic``, ``timeout`` [s].
"""

from __future__ import annotations

import json
import os
import select
import signal
import struct
import sys
import time
from typing import Any

from gazelle_ros import Node, Publisher
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import geometry_msgs

ORDER = struct.Struct("<?dd")
"""Format of orders in the pipe: whether the node is in control, forward speed [m/s], yaw rate
[rad/s].
"""
READY = b"ready\n"
"""Answer of the guard when it is connected."""

_AGAIN = 0.1  # commands that do not change are sent again after this [s]
_FAREWELLS = 5  # zeros at the end, in case a subscriber loses some
_FAREWELL_GAP = 0.05  # [s]


class _Relay:
    """Publishes what the node orders."""

    def __init__(self, publisher: Publisher) -> None:
        self._publisher = publisher
        self._kind = geometry_msgs.msg.Twist
        self._last = (False, 0.0, 0.0)
        self._drove = False
        self._sent_at = 0.0

    @property
    def active(self) -> bool:
        """True if the last order was a command to drive."""
        return self._last[0]

    def relay(self, order: tuple[bool, float, float]) -> None:
        """Publish an order if it is news, or if the last one was some time ago."""
        active, linear, angular = order
        now = time.monotonic()
        self._drove |= active
        if active and (order != self._last or now - self._sent_at >= _AGAIN):
            self._send(linear, angular)
            self._sent_at = now
        elif self._last[0] and not active:
            self._send(0.0, 0.0)
        self._last = order

    def stop(self) -> None:
        """Stop the robot: the node is silent."""
        if self.active:
            self.relay((True, 0.0, 0.0))

    def publish_stop(self) -> None:
        """Stop the robot, if it was driven at all: the node has ended."""
        for _ in range(_FAREWELLS if self._drove else 0):
            self._send(0.0, 0.0)
            time.sleep(_FAREWELL_GAP)

    def _send(self, linear: float, angular: float) -> None:
        message = self._kind()
        message.linear.x, message.angular.z = linear, angular
        self._publisher.publish(message)


def main(text: str) -> int:
    """Guard the robot until the pipe on standard input ends; returns the exit code."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    options: dict[str, Any] = json.loads(text)
    try:
        node = Node(**options["node"])
    except RosError as error:
        sys.stderr.write(f"the guard: {error}\n")
        return 1
    try:
        relay = _Relay(node.advertise(options["topic"], geometry_msgs.msg.Twist, 1))
        os.write(sys.stdout.fileno(), READY)
        _serve(relay, node, float(options["timeout"]))
        relay.publish_stop()
    finally:
        node.close()
    return 0


def _serve(relay: _Relay, node: Node, timeout: float) -> None:
    """Relay commands from the pipe until it ends, or the guard's node is shut down."""
    pipe, rest = sys.stdin.fileno(), b""
    while not node.closed:
        readable, _, _ = select.select([pipe], [], [], timeout)
        if not readable:
            relay.stop()
            continue
        data = os.read(pipe, 65536)
        if not data:
            return
        rest += data
        whole = len(rest) // ORDER.size * ORDER.size
        if whole:
            # Orders that wait behind each other are old: the newest counts.
            relay.relay(ORDER.unpack(rest[whole - ORDER.size : whole]))
            rest = rest[whole:]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
