"""XML-RPC server of a running launch, for tools."""

from __future__ import annotations

import os
import re
import socket
from collections.abc import Callable
from typing import Any

from gazelle_ros import loop, net
from gazelle_ros.launch.process import NodeProcess
from gazelle_ros.xmlrpc.server import UnknownMethodError, XmlRpcServer

_NO_WORD = re.compile(r"\W", re.ASCII)


class LaunchServer:
    """Answers ``get_pid``, ``get_node_names``, ``list_processes``, ``process_info``, ``shutdown``.

    Args:
        processes: Gives the processes of the launch.
        end: Called with a reason on a request to end.
        host: The name peers use.

    Attributes:
        uri: Address.
        key: The parameter for others.
    """

    def __init__(
        self,
        processes: Callable[[], list[NodeProcess]],
        end: Callable[[str], None],
        host: str,
    ) -> None:
        self._processes = processes
        self._end = end
        self._loop = loop.acquire()
        try:
            self._server = XmlRpcServer(self._loop, host, 0, self._dispatch)
        except OSError:
            loop.release(self._loop)
            raise
        self.uri = self._server.uri
        name = _NO_WORD.sub("_", socket.gethostname() if host == net.LOOPBACK else host)
        self.key = f"/roslaunch/uris/host_{name}__{self._server.port}"

    def close(self) -> None:
        """Stop serving."""
        self._server.close()
        loop.release(self._loop)

    def _dispatch(self, method: str, params: list[Any]) -> list[Any]:
        if method == "get_pid":
            return [1, "", os.getpid()]
        if method == "get_node_names":
            return [1, "node names", [each.name for each in self._processes()]]
        if method == "list_processes":
            known = self._processes()
            alive = [[each.name, each.spawned] for each in known if each.running]
            dead = [[each.name, each.spawned] for each in known if not each.running]
            return [1, "processes on parent machine", [alive, dead]]
        if method == "process_info":
            return self._info(str(params[0]) if params else "")
        if method == "shutdown":
            self._end("asked to shut down")
            return [1, "shutting down", 1]
        raise UnknownMethodError(method)

    def _info(self, name: str) -> list[Any]:
        for each in self._processes():
            if each.name == name:
                code = each.poll()
                info = {
                    "name": each.name,
                    "pid": each.pid,
                    "alive": each.running,
                    "spawn_count": each.spawned,
                    "respawn": each.plan.respawn,
                    "required": each.plan.required,
                    "args": list(each.how.arguments),
                    "exit_code": 0 if code is None else code,
                }
                return [1, "", info]
        return [-1, f"no process by that name: {name}", 0]
