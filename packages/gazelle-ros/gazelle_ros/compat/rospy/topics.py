"""Publishers and subscribers."""

from __future__ import annotations

import sys
import traceback
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.compat.rospy.exceptions import ROSException, ROSSerializationException
from gazelle_ros.compat.rospy.logs import logerr
from gazelle_ros.compat.rospy.msg import AnyMsg, args_kwds_to_message, is_message_class
from gazelle_ros.compat.rospy.names import resolve_name, resolve_name_without_node_name
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.errors import NodeClosedError, RosError
from gazelle_ros.messages import SerializationError
from gazelle_ros.tcpros.frames import frame

if TYPE_CHECKING:
    from gazelle_ros.node import Node
    from gazelle_ros.publishing import Publisher as NodePublisher
    from gazelle_ros.subscribing import Subscriber as NodeSubscriber

DEFAULT_BUFF_SIZE = 65536
_UNBOUNDED = sys.maxsize
_NO_QUEUE_SIZE = (
    "The publisher should be created with an explicit keyword argument 'queue_size'. Please see "
    "http://wiki.ros.org/rospy/Overview/Publishers%20and%20Subscribers for more information."
)

__all__ = ["AnyMsg", "Publisher", "SubscribeListener", "Subscriber", "Topic"]


class Topic:
    """Common base of publishers and subscribers.

    Attributes:
        name: The topic's resolved name; so is `resolved_name`.
        data_class: Of the messages.
        type: Name of the message type.
        md5sum: Of the message type.

    Raises:
        ValueError: The name is empty, or the class is no message class.
    """

    reg_type = ""

    def __init__(self, name: str, data_class: Any, reg_type: str) -> None:
        if not name or not isinstance(name, str):
            raise ValueError("topic name is not a non-empty string")
        if data_class is None:
            raise ValueError("topic parameter 'data_class' is not initialized")
        if not isinstance(data_class, type):
            raise ValueError(f"data_class [{data_class}] is not a class")  # noqa: TRY004  # rospy's error
        if not is_message_class(data_class):
            raise ValueError(f"data_class [{data_class.__name__}] is not a message data class")
        if process.node is None:
            self.resolved_name = resolve_name_without_node_name(name)
        else:
            self.resolved_name = resolve_name(name)
        self.name = self.resolved_name
        self.data_class: Any = data_class
        self.type: str = data_class._type  # type: ignore[attr-defined]
        self.md5sum: str = data_class._md5sum  # type: ignore[attr-defined]
        self.reg_type = reg_type
        self.impl: Any = None

    def get_num_connections(self) -> int:
        """Return the number of connected nodes."""
        return 0 if self.impl is None else int(self.impl.get_num_connections())

    def unregister(self) -> None:
        """Unregister from the topic."""
        impl, self.impl = self.impl, None
        if impl is not None:
            impl.close()


class SubscribeListener:
    """Base class of listeners of a publisher's subscribers."""

    def peer_subscribe(
        self,
        topic_name: str,
        topic_publish: Callable[..., None],
        peer_publish: Callable[[Any], None],
    ) -> None:
        """Handle a new subscriber.

        Args:
            topic_name: The topic's resolved name.
            topic_publish: Publishes to all.
            peer_publish: Publishes to this subscriber only.
        """

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        """Handle the end of a subscriber.

        Args:
            topic_name: The topic's resolved name.
            num_peers: Number of remaining peers.
        """


class _PublisherImpl:
    """Implementation object that older scripts access behind a `Publisher`."""

    def __init__(self, publisher: NodePublisher | None, *, latch: bool) -> None:
        self.publisher = publisher
        self.owner: Node | None = None
        self.is_latch = latch
        self.headers: dict[str, str] = {}
        self.subscriber_listeners: list[SubscribeListener] = []

    def get_num_connections(self) -> int:
        return 0 if self.publisher is None else self.publisher.num_connections

    def has_connections(self) -> bool:
        return self.get_num_connections() > 0

    def close(self) -> None:
        if self.publisher is not None:
            self.publisher.close()

    def add_subscriber_listener(self, listener: SubscribeListener) -> None:
        self.subscriber_listeners.append(listener)


class Publisher(Topic):
    """Publishes messages on a topic.

    Args:
        name: Of the topic.
        data_class: Of the messages.
        subscriber_listener: Called when subscribers come and go.
        tcp_nodelay: Send small packets at once.
        latch: Send the last message to later subscribers.
        headers: More fields for the connection header.
        queue_size: Messages kept for a slow subscriber, the oldest dropped; 0 for all; None to
            wait for slow subscribers.
    """

    def __init__(
        self,
        name: str,
        data_class: Any,
        subscriber_listener: SubscribeListener | None = None,
        tcp_nodelay: bool = False,  # noqa: FBT001, FBT002  # rospy's interface
        latch: bool = False,  # noqa: FBT001, FBT002
        headers: dict[str, str] | None = None,
        queue_size: int | None = None,
    ) -> None:
        super().__init__(name, data_class, "pub")
        if queue_size is None:
            warnings.warn(_NO_QUEUE_SIZE, SyntaxWarning, stacklevel=2)
        self.queue_size = queue_size
        self._nodelay = tcp_nodelay
        self.impl = _PublisherImpl(None, latch=latch)
        self.impl.headers.update(headers or {})
        if subscriber_listener is not None:
            self.impl.add_subscriber_listener(subscriber_listener)
        process.when_ready(self._advertise)

    def _advertise(self) -> None:
        impl = self.impl
        if impl is None:  # unregistered before there was a node
            return
        impl.owner = process.require()
        try:
            impl.publisher = impl.owner.advertise(
                self.resolved_name,
                self.data_class,
                queue_size=_UNBOUNDED if self.queue_size == 0 else self.queue_size,
                latch=impl.is_latch,
                tcp_nodelay=self._nodelay,
                on_connect=self._connected,
                on_disconnect=self._disconnected,
                headers=impl.headers,
            )
        except RosError as error:
            raise ROSException(str(error)) from error

    @property
    def closed(self) -> bool:
        """True if it can publish no more."""
        impl = self.impl
        return impl is None or (impl.owner is not None and impl.owner.closed)

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Publish a message.

        Args:
            args: The message, or its fields in order.
            kwds: Or its fields by name.

        Raises:
            ROSException: There is no node, or it was shut down.
            ROSSerializationException: A field holds a value outside its type.
        """
        impl = self.impl
        node = process.node
        if node is None:
            raise ROSException(
                "ROS node has not been initialized yet. Please call init_node() first"
            )
        if impl is None or impl.publisher is None:
            raise ROSException("publish() to an unregistered() handle")
        if node.closed:
            raise ROSException("publish() to a closed topic")
        if len(args) == 1 and not kwds and type(args[0]) is self.data_class:
            message = args[0]
        else:
            message = args_kwds_to_message(self.data_class, args, kwds)
        try:
            impl.publisher.publish(message)
        except NodeClosedError:
            raise ROSException("publish() to a closed topic") from None
        except SerializationError as error:
            logerr(traceback.format_exc())
            raise ROSSerializationException(str(error)) from error

    def _connected(self, peer: str) -> None:
        def to_peer(*args: Any, **kwds: Any) -> None:
            self._publish_to(peer, args_kwds_to_message(self.data_class, args, kwds))

        for listener in self.impl.subscriber_listeners if self.impl else ():
            listener.peer_subscribe(self.resolved_name, self.publish, to_peer)

    def _disconnected(self, _peer: str) -> None:
        for listener in self.impl.subscriber_listeners if self.impl else ():
            listener.peer_unsubscribe(self.resolved_name, self.get_num_connections())

    def _publish_to(self, peer: str, message: Any) -> None:
        publication = process.require().publication(self.resolved_name)
        if publication is None:
            return
        data = frame(message)
        for link in publication.remote:
            if link.peer == peer:
                link.send(data)
        for local in publication.local:
            if local.peer == peer:
                local.send(message, data[4:])


class _SubscriberImpl:
    """Implementation object that older scripts access behind a `Subscriber`."""

    def __init__(self) -> None:
        self.subscriber: NodeSubscriber | None = None
        self.callbacks: tuple[tuple[Callable[..., Any], Any], ...] = ()

    def get_num_connections(self) -> int:
        return 0 if self.subscriber is None else self.subscriber.num_connections

    def has_connections(self) -> bool:
        return self.get_num_connections() > 0

    def add_callback(self, callback: Callable[..., Any], cb_args: Any) -> None:
        self.callbacks = (*self.callbacks, (callback, cb_args))

    def remove_callback(self, callback: Callable[..., Any], cb_args: Any) -> None:
        left = list(self.callbacks)
        left.remove((callback, cb_args))
        self.callbacks = tuple(left)

    def deliver(self, message: Any) -> None:
        for callback, arguments in self.callbacks:
            try:
                if arguments is None:
                    callback(message)
                else:
                    callback(message, arguments)
            except Exception as error:  # noqa: BLE001  # a callback must not end its thread
                if not process.shutdown.is_set():
                    logerr(f"bad callback: {callback}\n{traceback.format_exc()}")
                elif not isinstance(error, KeyboardInterrupt):
                    continue

    def close(self) -> None:
        if self.subscriber is not None:
            self.subscriber.close()
        self.callbacks = ()


class Subscriber(Topic):
    """Calls back with the messages of a topic, one after another.

    Args:
        name: Of the topic.
        data_class: Of the messages; `AnyMsg` takes any.
        callback: Called with each message.
        callback_args: Passed to the callback after the message, if not None.
        queue_size: Messages kept while callbacks are slow, the oldest dropped; None for all.
        buff_size: Accepted, and not needed.
        tcp_nodelay: Request that publishers send small packets at once.
    """

    def __init__(
        self,
        name: str,
        data_class: Any,
        callback: Callable[..., Any] | None = None,
        callback_args: Any = None,
        queue_size: int | None = None,
        buff_size: int = DEFAULT_BUFF_SIZE,
        tcp_nodelay: bool = False,  # noqa: FBT001, FBT002  # rospy's interface
    ) -> None:
        super().__init__(name, data_class, "sub")
        del buff_size
        self.callback = callback
        self.callback_args = callback_args
        self._queue_size = queue_size or None
        self._nodelay = tcp_nodelay
        self.impl = _SubscriberImpl()
        if callback is not None:
            self.impl.add_callback(callback, callback_args)
        process.when_ready(self._subscribe)

    def _subscribe(self) -> None:
        impl = self.impl
        if impl is None:  # unregistered before there was a node
            return
        try:
            impl.subscriber = process.require().subscribe(
                self.resolved_name,
                self.data_class,
                impl.deliver,
                queue_size=self._queue_size,
                tcp_nodelay=self._nodelay,
            )
        except RosError as error:
            raise ROSException(str(error)) from error
