"""Publication of one node on one topic: links to subscribers, queues, latched message."""

from __future__ import annotations

import functools
import socket
import threading
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from gazelle_ros import net
from gazelle_ros.errors import Md5MismatchError, NodeClosedError, RosError, report
from gazelle_ros.loop import EventLoop
from gazelle_ros.node_base import NodeBase
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.frames import LENGTH, frame
from gazelle_ros.tcpros.outbound import OutboundLink

PeerHook = Callable[[str], None]
"""Called with the name of a subscriber, on a worker thread."""


class LocalReceiver(Protocol):
    """Interface of a subscription that a local link needs."""

    node: NodeBase

    def takes(self, message_class: Any) -> bool:
        """Return True if objects of that class can be delivered as they are."""

    def receive_local(self, link: LocalLink, message: Any, data: bytes | None) -> None:
        """Receive a message, or its serialised form."""

    def lose_local(self, link: LocalLink) -> None:
        """Handle the end of the publisher."""


class LocalLink:
    """A link to a subscription in the same process: messages go over as they are."""

    is_local = True

    def __init__(self, publication: Publication, subscription: LocalReceiver) -> None:
        self.publication = publication
        self.subscription = subscription
        self.peer = subscription.node.name
        self.header = publication.reply_header()
        self.latching = publication.latching
        self.messages = 0
        self.latched: Any = None
        """The last message, if the topic is latched."""
        self.number = 0
        """Identity in bus info."""
        self.waits = publication.queue_size is None
        self.same_class = subscription.takes(publication.message_class)

    def send(self, message: Any, data: bytes | None) -> None:
        """Deliver the object if `data` is None, else its serialised bytes."""
        self.messages += 1
        self.subscription.receive_local(self, message, data)


class Publication:
    """A node's publishers of one topic, which share everything.

    Args:
        node: Its node.
        topic: Its resolved name.
        message_class: Of the messages.
    """

    def __init__(self, node: NodeBase, topic: str, message_class: Any) -> None:
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self.queue_size: int | None = None
        self.tcp_nodelay = False
        self.latching = False
        self.headers: dict[str, str] = {}
        """More fields for the connection header, or others in the place of ours."""
        self.publishers: list[Publisher] = []
        self.messages = 0
        self.bytes = 0
        self.share_messages = node.share_messages
        self._lock = threading.RLock()
        self._sequence = 0
        self._last: Any = None
        self._loop: EventLoop = node.loop
        self.has_header = bool(getattr(message_class, "_has_header", False))
        self.remote: tuple[OutboundLink, ...] = ()
        self.local: tuple[LocalLink, ...] = ()

    # Sending -----------------------------------------------------------------------------

    def publish(self, message: Any) -> None:
        """Send a message to all subscribers."""
        if self.has_header:
            with self._lock:
                self._sequence += 1
                message.header.seq = self._sequence
        remote, local = self.remote, self.local
        self.messages += 1
        if self.latching:
            self._latch(message)
            return
        if remote:
            data = frame(message)
            self.bytes += len(data)
            for link in remote:
                link.send(data)
            if local:
                self._publish_local(local, message, data[4:])
        elif local:
            self._publish_local(local, message, None)

    def publish_bytes(self, messages: Sequence[bytes]) -> None:
        """Send messages that are serialised already; not for types with a header or latched."""
        remote, local = self.remote, self.local
        self.messages += len(messages)
        if remote:
            framed = b"".join(part for data in messages for part in (LENGTH.pack(len(data)), data))
            self.bytes += len(framed)
            for link in remote:
                link.send(framed)
        for neighbour in local:
            for data in messages:
                neighbour.send(None, data)

    def _latch(self, message: Any) -> None:
        """Send and keep a message; a subscriber that connects at the same time gets it once."""
        data = frame(message)
        with self._lock:
            self._last = data
            remote, local = self.remote, self.local
            self.bytes += len(data) if remote else 0
            if local:
                self._publish_local(local, message, data[4:])
        for link in remote:
            link.send(data)

    def _publish_local(
        self, local: tuple[LocalLink, ...], message: Any, data: bytes | None
    ) -> None:
        if data is None:
            if len(local) == 1 and local[0].same_class and self.share_messages:
                local[0].send(message, None)
                return
            data = frame(message)[4:]
        for link in local:
            link.send(message, data)

    # Subscribers come and go; only on the loop's thread -------------------------------------------

    def reply_header(self) -> dict[str, str]:
        """Return the header for a subscriber."""
        kind = self.message_class
        return {
            "callerid": self.node.name,
            "latching": str(int(self.latching)),
            "md5sum": kind._md5sum,
            "message_definition": kind._full_text,
            "topic": self.topic,
            "type": kind._type,
            **self.headers,
        }

    def check(self, caller: str, fields: dict[str, str]) -> None:
        """Check the header of a subscriber.

        Raises:
            Md5MismatchError: It wants another type.
        """
        mine, theirs = self.message_class._md5sum, fields["md5sum"]
        if headers.ANY not in {mine, theirs} and mine != theirs:
            kind = self.message_class._type
            raise Md5MismatchError(
                f"Client [{caller}] wants topic [{self.topic}] to have datatype/md5sum "
                f"[{fields.get('type', '?')}/{theirs}], but our version has [{kind}/{mine}]"
            )

    def adopt(self, sock: socket.socket, address: net.Address, fields: dict[str, str]) -> None:
        """Add the connection of a subscriber."""
        if self.tcp_nodelay or headers.flag(fields, "tcp_nodelay"):
            net.ignore_delay(sock)
        link = OutboundLink(self._loop, sock, fields, address, self.queue_size, self._lost)
        link.number = self.node.next_number()
        first = headers.encode(self.reply_header())
        with self._lock:
            # From here on every message goes to this link too, behind header and latched one.
            if self.latching and self._last is not None:
                first += self._last
            link.start(first)
            self.remote = (*self.remote, link)
        self._notify_peer(link.peer, connected=True)

    def attach(self, link: LocalLink) -> None:
        """Send to a subscription in the same process, from the latched message on."""
        link.number = self.node.next_number()
        with self._lock:
            self.local = (*self.local, link)
            if self.latching and self._last is not None:
                link.send(None, self._last[4:])
        self._notify_peer(link.peer, connected=True)

    def detach(self, link: LocalLink) -> None:
        """Undo `attach`."""
        with self._lock:
            known = link in self.local
            self.local = tuple(other for other in self.local if other is not link)
        if known:
            self._notify_peer(link.peer, connected=False)

    def _lost(self, link: OutboundLink) -> None:
        with self._lock:
            self.remote = tuple(other for other in self.remote if other is not link)
        self._notify_peer(link.peer, connected=False)

    def _notify_peer(self, peer: str, *, connected: bool) -> None:
        for publisher in self.publishers:
            if publisher.introduced:
                self._notify_publisher(publisher, peer, connected=connected)

    def notify_of_subscribers(self, publisher: Publisher) -> None:
        """Report present subscribers to a further publisher, as in roscpp.

        On the loop's thread.
        """
        publisher.introduced = True
        peers = [link.peer for link in self.remote] + [link.peer for link in self.local]
        for peer in peers:
            self._notify_publisher(publisher, peer, connected=True)

    def _notify_publisher(self, publisher: Publisher, peer: str, *, connected: bool) -> None:
        hook = publisher.on_connect if connected else publisher.on_disconnect
        if hook is not None:
            self._loop.submit(functools.partial(self._call, hook, peer))

    def _call(self, hook: PeerHook, peer: str) -> None:
        try:
            hook(peer)
        except Exception as error:  # noqa: BLE001  # a hook must not end its thread
            report(f"connection hook of {self.topic}", error)

    def close(self) -> None:
        """Close all subscribers' connections.

        Only on the loop's thread. Only on the loop's thread.
        """
        for link in self.remote:
            link.finish()
        for local in self.local:
            local.subscription.lose_local(local)
            self.detach(local)

    @property
    def num_connections(self) -> int:
        """Subscribers connected now."""
        return len(self.remote) + len(self.local)


class Publisher:
    """Publisher of messages on a topic, as `Node.advertise` returns it.

    Args:
        publication: Publication that it uses.
        on_close: Called with itself when it is closed.
        on_connect: See the attribute.
        on_disconnect: See the attribute.

    Attributes:
        name: The topic's resolved name.
        on_connect: Called with the name of each subscriber that connects, on a worker thread.
        on_disconnect: Called with the name of each that goes.
        introduced: Whether earlier subscribers were reported to it.
    """

    def __init__(
        self,
        publication: Publication,
        on_close: Callable[[Publisher], None],
        on_connect: PeerHook | None = None,
        on_disconnect: PeerHook | None = None,
    ) -> None:
        self.publication = publication
        self._on_close = on_close
        self.name = publication.topic
        self.message_class = publication.message_class
        self.on_connect = on_connect
        self.on_disconnect = on_disconnect
        self.introduced = False
        self._closed = False

    def publish(self, message: Any) -> None:
        """Publish a message.

        With a queue size this returns at once; what a subscriber does not take in time is
        dropped, oldest first. Without one it waits for slow subscribers. A subscriber in
        this process may get this very object: do not change it afterwards.

        Raises:
            NodeClosedError: The publisher is closed.
            SerializationError: A field holds what its type cannot carry.
        """
        if self._closed:
            raise NodeClosedError(f"the publisher of {self.name} is closed")
        self.publication.publish(message)

    def publish_bytes(self, *messages: bytes) -> None:
        """Publish messages that are serialised already, of a type without a header.

        They go out in one piece; a subscriber that is too slow misses all of them or none.

        Raises:
            NodeClosedError: The publisher is closed.
            RosError: The topic is latched, or its messages have headers.
        """
        if self._closed:
            raise NodeClosedError(f"the publisher of {self.name} is closed")
        if self.publication.latching or self.publication.has_header:
            raise RosError(f"{self.name} is latched or has headers: publish messages")
        self.publication.publish_bytes(messages)

    @property
    def num_connections(self) -> int:
        """Subscribers connected now."""
        return self.publication.num_connections

    @property
    def has_subscribers(self) -> bool:
        """True if a message published now would go anywhere."""
        return self.publication.num_connections > 0

    def close(self) -> None:
        """Publish no more; the last publisher of a topic in a node unregisters it."""
        if not self._closed:
            self._closed = True
            self._on_close(self)
