"""The command line of ``nodelet``: manager, load, unload and standalone."""

from __future__ import annotations

import contextlib
import logging
import threading
import uuid
from collections.abc import Callable, Sequence

from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.builtin.arguments import (
    CallbackWork,
    NodeArguments,
    parse_arguments,
    run_node,
)
from gazelle_ros.builtin.nodelets.bonds import BondHolder
from gazelle_ros.builtin.nodelets.manager import NodeletManager
from gazelle_ros.builtin.registry import nodelet
from gazelle_ros.errors import (
    NodeClosedError,
    RosTimeoutError,
    ServiceError,
    UnreachableError,
)
from gazelle_ros.msgs import nodelet as messages
from gazelle_ros.node import Node

USAGE = """nodelet load pkg/Class MANAGER    run a nodelet in a manager, until this program ends
nodelet unload NAME MANAGER       end a nodelet of a manager
nodelet standalone pkg/Class      run a nodelet alone
nodelet manager                   run a manager"""
_WORDS = {"manager": 1, "standalone": 2, "unload": 3, "load": 3}
_FIRST_WAIT_S = 10.0
_PROBE_S = 0.5
_ANSWER_S = 5.0
_NO_BOND = "--no-bond"
_MANAGER_IS_GONE = (ServiceError, UnreachableError, RosTimeoutError)
_LOG = logging.getLogger("gazelle.ros.nodelet")


def main(arguments: Sequence[str]) -> int:
    """Run a manager or a nodelet until shutdown; returns the exit code."""
    words = parse_arguments(arguments, "nodelet").plain
    command = words[0] if words else ""
    if command not in _WORDS:
        raise RosError(f"nodelet has no command '{command}'", hint=did_you_mean(command, _WORDS))
    if len(words) < _WORDS[command]:
        raise RosError("there are too few arguments", hint=USAGE)
    if command == "manager":
        return run_node(arguments, "manager", NodeletManager)
    if command == "standalone":
        return run_node(arguments, default_name(words[1]), nodelet(words[1]))
    if command == "unload":
        return _unload(parse_arguments(arguments, "nodelet_unloader"))
    nodelet(words[1])  # a wrong class is reported at once, whether the manager is there or not
    return _load(parse_arguments(arguments, default_name(words[1])))


def default_name(kind: str) -> str:
    """Return the name of a node that has none on its command line."""
    return kind.replace("/", "_")


def _load(found: NodeArguments) -> int:
    _, kind, manager, *rest = found.plain
    with found.start() as node, stopping() as stop:
        loader = _NodeletLoader(node, manager, bonded=_NO_BOND not in rest)

        def end(_reason: str) -> None:
            loader.unload()  # now, as the node is closed after this
            stop.set()

        node.on_shutdown.append(end)
        if not _wait_for_manager(node, manager, stop):
            return 0

        def follow() -> None:
            _LOG.info("%s ends: %s has ended or unloaded it", node.name, manager)
            stop.set()

        loader.load(kind, [each for each in rest if each != _NO_BOND], follow)
        CallbackWork(node).run(stop)
        loader.unload()
    return 0


class _NodeletLoader:
    """Client of a manager for one nodelet, which is called as the node."""

    def __init__(self, node: Node, manager: str, *, bonded: bool) -> None:
        self._node, self._manager = node, manager
        self._bonds = BondHolder(node, f"{manager}/bond") if bonded else None
        self._bond = f"{node.name}_{uuid.uuid4().hex}" if bonded else ""
        self._lock = threading.Lock()
        self._loaded = False

    def load(self, kind: str, arguments: list[str], on_end: Callable[[], object]) -> None:
        """Load the nodelet.

        Args:
            kind: Its class.
            arguments: Of the nodelet.
            on_end: Called when the manager ends, or unloads the nodelet.
        """
        request = messages.srv.NodeletLoadRequest(
            name=self._node.name,
            type=kind,
            remap_source_args=list(self._node.remappings),
            remap_target_args=list(self._node.remappings.values()),
            my_argv=arguments,
            bond_id=self._bond,
        )

        def broken() -> None:
            with self._lock:  # the answer of the service has come then
                was_loaded, self._loaded = self._loaded, False
            if was_loaded:
                on_end()

        if self._bonds is not None:
            self._bonds.add(self._bond, broken)
        with self._lock:
            client = self._node.client(f"{self._manager}/load_nodelet", messages.srv.NodeletLoad)
            self._loaded = bool(client.call(request).success)
        if not self._loaded:
            raise RosError(f"{self._manager} did not load {kind}; its output says why")

    def unload(self) -> None:
        """Unload the nodelet, unless that was done."""
        with self._lock:
            was_loaded, self._loaded = self._loaded and not self._node.closed, False
        if was_loaded:
            # A manager that ends at the same time has unloaded it.
            with contextlib.suppress(*_MANAGER_IS_GONE):
                _request_unload(self._node, self._manager, self._node.name)


def _wait_for_manager(node: Node, manager: str, stop: threading.Event) -> bool:
    """Wait until a manager is there; False if the process is to end first."""
    waited = 0.0
    while not stop.is_set() and not node.closed:
        try:
            node.wait_for_service(f"{manager}/load_nodelet", _PROBE_S)
        except RosTimeoutError:
            waited += _PROBE_S
            if waited % _FIRST_WAIT_S == 0.0:
                _LOG.warning("waiting for the nodelet manager %s for %d s", manager, waited)
        except NodeClosedError:
            return False
        else:
            return True
    return False


def _unload(found: NodeArguments) -> int:
    _, name, manager, *_ = found.plain
    with found.start() as node:
        try:
            return 0 if _request_unload(node, manager, name) else 1
        except _MANAGER_IS_GONE as error:
            _LOG.warning("%s is not unloaded from %s: %s", name, manager, error)
            return 1


def _request_unload(node: Node, manager: str, name: str) -> bool:
    client = node.client(f"{manager}/unload_nodelet", messages.srv.NodeletUnload)
    return bool(client.call(messages.srv.NodeletUnloadRequest(name=name), _ANSWER_S).success)
