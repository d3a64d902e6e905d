"""Keeps a node registered: when its master goes and another comes, all is registered again."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, Protocol

from gazelle_ros.errors import RosError, report
from gazelle_ros.loop import EventLoop, TimerHandle
from gazelle_ros.parameters import NodeParameters
from gazelle_ros.publishing import Publication
from gazelle_ros.services import ServiceServer
from gazelle_ros.subscribing import Subscription
from gazelle_ros.xmlrpc.async_client import AsyncClient

_CALM_S = 5.0
"""Seconds between questions while all is well; a broken connection is noticed at once."""
_ALERT_S = 0.25


def _call_hook(hook: Callable[[], None]) -> None:
    """Call a hook; the master may be gone again already."""
    try:
        hook()
    except Exception as error:  # noqa: BLE001  # a hook must not end its thread
        report("a hook for a new master", error)


class RegisteredNode(Protocol):
    """Interface of a node that a registrar needs."""

    name: str
    uri: str
    master_uri: str
    loop: EventLoop
    calls: AsyncClient
    parameters: NodeParameters
    on_new_master: list[Callable[[], None]]

    def publications(self) -> list[Publication]:
        """Return all topics published."""

    def subscriptions(self) -> list[Subscription]:
        """Return all topics subscribed to."""

    def services(self) -> list[ServiceServer]:
        """Return all services offered."""


class Registrar:
    """Asks the master from time to time whether it still knows the node. On the loop's thread."""

    def __init__(self, node: RegisteredNode) -> None:
        self._node = node
        self._timer: TimerHandle | None = None
        self._stopped = False
        self._asking = False
        self._unknown = False
        self.lost = False
        """True while the master does not answer."""

    def start(self) -> None:
        """Start to watch the master."""
        self._schedule(_ALERT_S)

    def stop(self) -> None:
        """Stop watching the master."""
        self._stopped = True
        if self._timer is not None:
            self._timer.cancel()

    def alert(self) -> None:
        """Check the master soon: its connection broke, or a registration failed."""
        self._schedule(_ALERT_S)

    def _schedule(self, seconds: float) -> None:
        if self._timer is not None:
            self._timer.cancel()
        if not self._stopped:
            self._timer = self._node.loop.call_later(seconds, self._check)

    def _check(self) -> None:
        if self._asking or self._stopped:
            return
        self._asking = True
        node = self._node
        params = (node.name, node.name)
        node.calls.call(node.master_uri, "lookupNode", params, self._judge)

    def _judge(self, triple: Any, error: RosError | None) -> None:
        self._asking = False
        if self._stopped:
            return
        if error is not None or not isinstance(triple, list) or len(triple) != 3:
            self.lost = True
            self._schedule(_ALERT_S * 2)
            return
        self.lost = False
        # Another node under our name is no reason to fight: the master requested the end.
        unknown = triple[0] == -1 and self._has_registrations()
        if unknown and not self._unknown:
            self._schedule(_ALERT_S)  # a first registration may be under way
        else:
            self._schedule(_CALM_S)
            if unknown:
                self._register_all()
        self._unknown = unknown

    def _has_registrations(self) -> bool:
        node = self._node
        return bool(
            node.publications()
            or node.subscriptions()
            or node.services()
            or node.parameters.followed()
        )

    def _register_all(self) -> None:
        node = self._node
        for publication in node.publications():
            kind = publication.message_class._type
            self._call("registerPublisher", publication.topic, kind, node.uri)
        for subscription in node.subscriptions():
            kind = subscription.message_class._type
            self._subscribe(subscription, kind)
        for service in node.services():
            self._call("registerService", service.name, service.uri, node.uri)
        for key in node.parameters.followed():
            self._follow(key)
        for hook in list(node.on_new_master):
            node.loop.submit(functools.partial(_call_hook, hook))

    def _call(self, method: str, *params: Any) -> None:
        node = self._node
        node.calls.call(node.master_uri, method, (node.name, *params))

    def _subscribe(self, subscription: Any, kind: str) -> None:
        node = self._node

        def done(triple: Any, error: RosError | None) -> None:
            if error is None and isinstance(triple, list) and triple[0] == 1:
                subscription.update([uri for uri in triple[2] if isinstance(uri, str)])

        params = (node.name, subscription.topic, kind, node.uri)
        node.calls.call(node.master_uri, "registerSubscriber", params, done)

    def _follow(self, key: str) -> None:
        node = self._node

        def done(triple: Any, error: RosError | None) -> None:
            if error is None and isinstance(triple, list) and triple[0] == 1:
                node.parameters.refresh(key, triple[2])

        params = (node.name, node.uri, key)
        node.calls.call(node.master_uri, "subscribeParam", params, done)
