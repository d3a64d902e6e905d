"""A nodelet manager: built-in nodes that a service loads and unloads (http://wiki.ros.org/nodelet)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Sequence

from gazelle_ros import names
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.arguments import CallbackWork, NodeWork
from gazelle_ros.builtin.nodelets.bonds import BondHolder
from gazelle_ros.builtin.nodelets.node import NodeletNode
from gazelle_ros.builtin.parameters import warn_of_others
from gazelle_ros.builtin.registry import nodelet
from gazelle_ros.errors import NodeClosedError, report
from gazelle_ros.msgs import nodelet as messages
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.nodelet")


class NodeletManager(CallbackWork):
    """Services ``~load_nodelet``, ``~unload_nodelet`` and ``~list``, and the nodelets loaded by them.

    A nodelet whose loader wants a bond, on ``~bond``, is unloaded when the loader ends.

    Args:
        node: On the graph.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        warn_of_others(node, ("num_worker_threads",))
        self._loaded: dict[str, _LoadedNodelet] = {}
        self._lock = threading.Lock()
        self._ending = False
        self._bonds = BondHolder(node, "~bond")
        node.serve("~load_nodelet", messages.srv.NodeletLoad, self._load)
        node.serve("~unload_nodelet", messages.srv.NodeletUnload, self._unload)
        node.serve("~list", messages.srv.NodeletList, lambda _request: [self.loaded])

    @property
    def loaded(self) -> list[str]:
        """Names of the nodelets."""
        with self._lock:
            return sorted(self._loaded)

    def run(self, stop: threading.Event) -> None:
        """Run nodelets until shutdown, then unload them."""
        super().run(stop)
        self._ending = True
        for name in self.loaded:
            self.unload(name)

    def load(self, name: str, kind: str, remappings: dict[str, str], bond: str = "") -> None:
        """Load a nodelet.

        Args:
            name: Global name.
            kind: Class, such as ``pkg/Class``.
            remappings: From names to names, resolved for the manager unless they are global.
            bond: Name of the bond to its loader; empty for none.

        Raises:
            Error: There is one of that name already, no such class, or its parameters are wrong.
        """
        make = nodelet(kind)
        name = self.node.resolve(name)
        with self._lock:
            if name in self._loaded:
                raise Error(f"there is a nodelet {name} already")
            node = NodeletNode(name, self.node, names.resolve_remappings(remappings, name))
            try:
                self._loaded[name] = _LoadedNodelet(node, make(node), bond)
            except BaseException:
                node.close()
                raise
        if bond:
            self._bonds.add(bond, lambda: self.unload(name))

    def unload(self, name: str) -> bool:
        """Unload a nodelet; False if there is none of that name."""
        with self._lock:
            found = self._loaded.pop(self.node.resolve(name), None)
        if found is not None:
            self._bonds.end(found.bond)
            found.close()
        return found is not None

    def _load(self, request: messages.srv.NodeletLoadRequest) -> Sequence[bool]:
        pairs = zip(request.remap_source_args, request.remap_target_args, strict=False)
        try:
            self.load(request.name, request.type, dict(pairs), request.bond_id)
        except NodeClosedError:
            return [False]
        except Error as error:
            _LOG.error("nodelet %s cannot be loaded: %s", request.name, error)  # a user's mistake
            return [False]
        return [True]

    def _unload(self, request: messages.srv.NodeletUnloadRequest) -> Sequence[bool]:
        # Who loads nodelets may end at the same time, and ask for what is done already.
        found = self.unload(request.name) or self._ending
        if not found:
            _LOG.error("there is no nodelet %s to unload", request.name)
        return [found]


class _LoadedNodelet:
    """A nodelet, the thread that runs it, and the name of its bond."""

    def __init__(self, node: Node, work: NodeWork, bond: str) -> None:
        self._node, self._work, self.bond = node, work, bond
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=node.name, daemon=True)
        self._thread.start()

    def close(self) -> None:
        self._stop.set()
        self._node.close()
        self._thread.join()

    def _run(self) -> None:
        try:
            self._work.run(self._stop)
        except NodeClosedError:
            pass
        except Exception as error:  # noqa: BLE001  # the other nodelets run on
            report(f"nodelet {self._node.name}", error)
