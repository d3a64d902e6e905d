"""The master as a server: in this process, or as the whole of one."""

from __future__ import annotations

import contextlib
import errno
import os
import threading
import uuid
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros import loop, net
from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import RosError
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.master.api import MasterApi
from gazelle_ros.master.proxy import MasterProxy, taken_hint
from gazelle_ros.xmlrpc.async_client import AsyncClient
from gazelle_ros.xmlrpc.server import XmlRpcServer

_PATIENCE_S = 3.0
"""Seconds to wait for a node that is called; dead nodes stay registered."""

_GREETING_S = 10.0
"""A master on this machine that is asked for its identity answers within this time."""


class Master(Closeable):
    """A ROS master with parameter server and, by default, the rosout aggregator.

    Args:
        host: The name nodes reach it by; loopback by default.
        port: 0 for any free one.
        rosout: As roscore does, run the node ``/rosout`` that copies ``/rosout`` to
            ``/rosout_agg``, and set ``/run_id`` and its like; without, as bare rosmaster.
        run_id: Value for ``/run_id``; with it, ``/run_id`` and its like are set in any case.
        limits: Limits for peers.
        ended: See the attribute.

    Attributes:
        uri: Address.
        port: The port in it.
        ended: Set on a request to end.

    Raises:
        RosError: The port is taken.
    """

    def __init__(
        self,
        host: str = net.LOOPBACK,
        port: int = net.DEFAULT_MASTER_PORT,
        *,
        rosout: bool = True,
        run_id: str = "",
        limits: NetworkLimits = LIMITS,
        ended: threading.Event | None = None,
    ) -> None:
        self.ended = ended or threading.Event()
        self._loop = loop.acquire()
        self._closed = False
        host = self._host = net.usable_host(host)
        self._calls = AsyncClient(self._loop, _PATIENCE_S, limits)
        self.api = MasterApi(self._notify, self._request_end)
        try:
            self._server = XmlRpcServer(
                self._loop, host, port, self.api.dispatch, limits, self.api.prepare
            )
        except OSError as error:
            loop.release(self._loop)
            raise _cannot_listen(error, host, port) from None
        self.uri = self.api.uri = self._server.uri
        self.port = self._server.port
        self._rosout: Any = None
        if rosout or run_id:
            self._set_marks(run_id or str(uuid.uuid1()))
        if rosout:
            self._start_rosout()

    def close(self) -> None:
        """Stop it: its socket and threads are gone when this returns."""
        if self._closed:
            return
        self._closed = True
        self.ended.set()
        if self._rosout is not None:
            self._rosout.close()
        self._server.close()
        self._loop.run(self._calls.close)
        loop.release(self._loop)

    def _notify(self, uri: str, method: str, params: Sequence[Any]) -> None:
        self._calls.call(uri, method, params)

    def _request_end(self, _reason: str) -> None:
        self.ended.set()

    def _set_marks(self, run_id: str) -> None:
        """Set the parameters that tools look for on a running master."""
        marks = {
            "/run_id": run_id,
            "/rosdistro": (os.environ.get("ROS_DISTRO") or "noetic") + "\n",
            "/rosversion": "1.16.0\n",
        }
        for key, value in marks.items():
            self.api.parameters.set(key, value)

    def _start_rosout(self) -> None:
        from gazelle_ros.clock import WallClock
        from gazelle_ros.master.rosout import RosoutAggregator
        from gazelle_ros.node import Node

        try:
            node = Node("rosout", master_uri=self.uri, host=self._host, clock=WallClock())
            self._rosout = RosoutAggregator(node)
        except BaseException:
            self.close()
            raise


def require_free(host: str, port: int) -> None:
    """Check that a master can be started there.

    Raises:
        RosError: The port is taken; it says by whom.
    """
    try:
        net.listen(host, port).close()
    except OSError as error:
        raise _cannot_listen(error, host, port) from None


def _cannot_listen(error: OSError, host: str, port: int) -> RosError:
    """Return the error that names the user of the port, as far as known."""
    text = f"cannot listen on {host}:{port}: "
    if error.errno != errno.EADDRINUSE:
        return RosError(text + (error.strerror or str(error)))
    there = MasterProxy(net.uri_of(host, port), "/master", _GREETING_S)
    try:
        process = there.get_pid()
    except (RosError, ValueError):
        return RosError(
            text + "a program that is not a ROS master has that port", hint=taken_hint()
        )
    finally:
        there.close()
    return RosError(
        text + f"a ROS master runs there already, process {process}",
        hint="use that one, or end it, or give another port (0 for any free one)",
    )


def run_master(
    host: str = net.LOOPBACK,
    port: int = net.DEFAULT_MASTER_PORT,
    *,
    rosout: bool = True,
    run_id: str = "",
    ready: Callable[[str], None] | None = None,
    end: threading.Event | None = None,
) -> None:
    """Run a master until it is asked to end, Ctrl-C, or `end` is set.

    Args:
        host: The name nodes reach it by; anything but loopback opens it to the network.
        port: 0 for any free one.
        rosout: Run the rosout aggregator.
        run_id: See `Master`.
        ready: Called with the master's URI when it answers.
        end: Set it to end the master; the master sets it when it is asked to end.

    Raises:
        RosError: The port is taken.
    """
    with Master(host, port, rosout=rosout, run_id=run_id, ended=end) as master:
        if ready is not None:
            ready(master.uri)
        with contextlib.suppress(KeyboardInterrupt):
            master.ended.wait()
