"""Bonds: two processes that notice when the other one ends (http://wiki.ros.org/bond)."""

from __future__ import annotations

import threading
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass

from gazelle_ros.errors import report
from gazelle_ros.msgs import bond, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_CONNECT_S = bond.msg.Constants.DEFAULT_CONNECT_TIMEOUT
_TIMEOUT_S = bond.msg.Constants.DEFAULT_HEARTBEAT_TIMEOUT
_PERIOD_S = bond.msg.Constants.DEFAULT_HEARTBEAT_PERIOD
_NO_TIMEOUT = bond.msg.Constants.DISABLE_HEARTBEAT_TIMEOUT_PARAM
_QUEUE = 100


@dataclass(slots=True)
class _HeldBond:
    """One side of a bond.

    Attributes:
        on_broken: Called when the other side has ended or fallen silent.
        deadline: By when its next heartbeat is to come, of ``time.monotonic`` [s].
    """

    on_broken: Callable[[], object]
    deadline: float


class BondHolder:
    """Sides of bonds that a node has on one topic; each has its other side in another node.

    Args:
        node: On the graph.
        topic: Of the heartbeats.
    """

    def __init__(self, node: Node, topic: str) -> None:
        self._node = node
        self._instance = uuid.uuid4().hex
        self._bonds: dict[str, _HeldBond] = {}
        self._lock = threading.Lock()
        self._patient = node.get_param(_NO_TIMEOUT, False) is True
        self._publisher = node.advertise(topic, bond.msg.Status, queue_size=_QUEUE)
        node.subscribe(topic, bond.msg.Status, self._take, _QUEUE)
        self._wait()

    def add(self, name: str, on_broken: Callable[[], object]) -> None:
        """Start the heartbeats of a bond.

        Args:
            name: Of the bond; its other side uses the same.
            on_broken: Called once, unless the bond is ended here.
        """
        with self._lock:
            self._bonds[name] = _HeldBond(on_broken, time.monotonic() + _CONNECT_S)
        self._send(name, active=True)

    def end(self, name: str) -> None:
        """End a bond, and notify the other side; one that is not there is left alone."""
        with self._lock:
            found = self._bonds.pop(name, None)
        if found is not None:
            self._send(name, active=False)

    def _take(self, status: bond.msg.Status) -> None:
        """Process a heartbeat, or the end, of another side."""
        if status.instance_id == self._instance:
            return
        with self._lock:
            found = self._bonds.get(status.id)
            if found is None:
                return
            if status.active:
                found.deadline = time.monotonic() + _TIMEOUT_S
                return
        self._break(status.id)

    def _send_heartbeats(self) -> None:
        """Send heartbeats, and break bonds whose other side is silent."""
        now = time.monotonic()
        with self._lock:
            late = {} if self._patient else self._bonds
            silent = [name for name, each in late.items() if now > each.deadline]
            alive = [name for name in self._bonds if name not in silent]
        for name in alive:
            self._send(name, active=True)
        for name in silent:
            self._break(name)
        self._wait()

    def _wait(self) -> None:
        loop = self._node.loop
        if not self._node.closed:
            loop.call_later(_PERIOD_S, lambda: loop.submit(self._send_heartbeats))

    def _break(self, name: str) -> None:
        with self._lock:
            found = self._bonds.pop(name, None)
        if found is None:
            return
        self._send(name, active=False)
        try:
            found.on_broken()
        except Exception as error:  # noqa: BLE001  # other bonds hold on
            report(f"the end of the bond {name}", error)

    def _send(self, name: str, *, active: bool) -> None:
        if self._node.closed:
            return
        self._publisher.publish(
            bond.msg.Status(
                header=std_msgs.msg.Header(stamp=Time(nsecs=time.time_ns())),
                id=name,
                instance_id=self._instance,
                active=active,
                heartbeat_timeout=_TIMEOUT_S,
                heartbeat_period=_PERIOD_S,
            )
        )
