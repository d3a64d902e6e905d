"""The WebSocket server of rosbridge."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import itertools
import logging
import ssl
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.errors import MissingExtraError, RosError
from gazelle_ros.errors import report
from gazelle_ros.node import Node
from gazelle_ros.rosbridge.client_list import ClientList
from gazelle_ros.rosbridge.client_queue import ClientQueue, OutgoingMessage
from gazelle_ros.rosbridge.fragments import split_text
from gazelle_ros.rosbridge.origins import may_connect
from gazelle_ros.rosbridge.session import BridgeContext, BridgeSession
from gazelle_ros.rosbridge.settings import BridgeSettings
from gazelle_ros.server_faults import HandshakeFilter, report_shortages

if TYPE_CHECKING:
    from websockets.asyncio.server import Server, ServerConnection
    from websockets.http11 import Request, Response

LOG = logging.getLogger("gazelle.rosbridge")
_CONNECTIONS = logging.getLogger("gazelle.rosbridge.websockets")
_CONNECTIONS.addFilter(HandshakeFilter("rosbridge"))
_STARTING_S = 30.0
_SMALL = 4096  # bytes; what is longer is encoded off the server's thread
_TOO_SLOW = 1008  # WebSocket's code for a client that breaks the server's rules


class BridgeServer(Closeable):
    """Server for WebSocket clients of a ROS graph; a context manager.

    Each client has its own queue and its own sender, so that a slow one blocks no other.

    Args:
        node: On the graph. Its topics ``client_count`` and ``connected_clients`` list the clients.
        settings: Of the server.

    Attributes:
        node: Likewise.
        port: Port.

    Raises:
        MissingExtraError: The extra ``bridge`` is not installed.
        RosError: It cannot listen there.
    """

    def __init__(self, node: Node, settings: BridgeSettings) -> None:
        _require_packages()
        self.node, self._settings = node, settings
        self._context = BridgeContext(node, settings)
        self._clients = ClientList(node)
        self._fragment_numbers = itertools.count(1)
        self._loop = asyncio.new_event_loop()
        report_shortages(self._loop, "rosbridge")
        self._stop = asyncio.Event()
        self._started = threading.Event()
        self._errors: list[Exception] = []
        self.port = settings.port
        self._thread = threading.Thread(target=self._run, name="rosbridge", daemon=True)
        self._thread.start()
        if not self._started.wait(_STARTING_S):
            raise RosError("the rosbridge server did not start")
        if self._errors:
            self._thread.join()
            where = f"{settings.address}:{settings.port}"
            raise RosError(
                f"rosbridge cannot listen on {where}: {self._errors[0]}",
                hint="give it another port; 0 is any free one",
            ) from None

    def close(self) -> None:
        """Disconnect all clients, and stop listening; a second call does nothing."""
        with contextlib.suppress(RuntimeError):  # it ended by itself
            self._loop.call_soon_threadsafe(self._stop.set)
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._serve())
        except (OSError, ValueError) as error:
            self._errors.append(error)
        finally:
            self._started.set()
            self._loop.close()

    async def _serve(self) -> None:
        from websockets.asyncio.server import serve

        settings = self._settings
        context = None
        if settings.certfile:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(settings.certfile, settings.keyfile)
        ping = settings.websocket_ping_interval or None
        async with serve(
            self._serve_client,
            settings.address,
            settings.port,
            process_request=self._judge,
            compression="deflate" if settings.use_compression else None,
            max_size=settings.max_incoming_bytes,
            max_queue=16,
            ping_interval=ping,
            ping_timeout=settings.websocket_ping_timeout if ping else None,
            close_timeout=2,
            ssl=context,
            logger=_CONNECTIONS,
        ) as server:
            self.port = _port_of(server)
            self._started.set()
            await self._stop.wait()

    def _judge(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return a rejection of web pages from elsewhere, and of clients beyond the limit."""
        if self._clients.count >= self._settings.max_clients:
            return connection.respond(503, "there are too many clients\n")
        origin, host = request.headers.get("Origin"), request.headers.get("Host", "")
        if may_connect(origin, host, self._settings):
            return None
        LOG.warning("refused a web page of %s", origin)
        return connection.respond(
            403, "pages of this origin may not connect; see rosbridge's parameter allowed_origins\n"
        )

    async def _serve_client(self, connection: ServerConnection) -> None:
        """Serve one client, from its first message to its last."""
        from websockets.exceptions import ConnectionClosed

        news = asyncio.Event()
        wake = _waker(self._loop, news)
        outbox = ClientQueue(self._settings.max_waiting_bytes, wake)
        session = BridgeSession(self._context, outbox)
        self._clients.add(connection)
        sender = asyncio.create_task(self._send_all(connection, outbox, news))
        try:
            async for message in connection:
                await self._run_on_worker(functools.partial(session.receive, message))
                if outbox.stuck:
                    await connection.close(_TOO_SLOW, "answers are not taken")
        except ConnectionClosed:
            pass
        finally:
            sender.cancel()
            self._clients.remove(connection)
            await self._run_on_worker(session.close)

    async def _send_all(
        self, connection: ServerConnection, outbox: ClientQueue, news: asyncio.Event
    ) -> None:
        """Send the messages of the outbox as fast as the client receives them."""
        from websockets.exceptions import ConnectionClosed

        delay = self._settings.delay_between_messages
        with contextlib.suppress(ConnectionClosed):
            while True:
                news.clear()
                outgoing, later = outbox.take(time.monotonic())
                if outgoing is None:
                    await _wait(news, later)
                    continue
                for frame in await self._frames(outgoing):
                    await connection.send(frame)
                    if delay:
                        await asyncio.sleep(delay)

    async def _frames(self, outgoing: OutgoingMessage) -> list[str | bytes]:
        """Encode a outgoing as WebSocket frames; long messages are encoded on another thread."""
        message, settings = outgoing.message, outgoing.settings
        if message is None:
            return [] if outgoing.text is None else [outgoing.text]
        try:
            if len(message) <= _SMALL:
                data = message.encoded(settings.compression)
            else:
                data = await self._run_on_worker(lambda: message.encoded(settings.compression))
        except Exception as error:  # noqa: BLE001  # a message that is none must not end the rest
            report("rosbridge cannot encode a message", error)
            return []
        size = settings.fragment_size or self._settings.max_message_size
        if size is None or isinstance(data, bytes):
            return [data]
        return list(split_text(data, size, str(next(self._fragment_numbers))))

    async def _run_on_worker(self, task: Callable[[], Any]) -> Any:
        """Run what may take long on a worker thread, and wait for it."""
        done: asyncio.Future[Any] = self._loop.create_future()

        def settle(result: Any, error: BaseException | None) -> None:
            if done.cancelled():
                return
            if error is None:
                done.set_result(result)
            else:
                done.set_exception(error)

        def work() -> None:
            result, problem = None, None
            try:
                result = task()
            except Exception as error:  # noqa: BLE001  # it is raised again where it is awaited
                problem = error
            with contextlib.suppress(RuntimeError):  # the server has ended meanwhile
                self._loop.call_soon_threadsafe(settle, result, problem)

        self.node.loop.submit(work)
        return await done


async def _wait(news: asyncio.Event, until: float | None) -> None:
    """Wait until there is something new, or a moment has come [s]."""
    timeout = None if until is None else max(0.0, until - time.monotonic())
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(news.wait(), timeout)


def _waker(loop: asyncio.AbstractEventLoop, news: asyncio.Event) -> Callable[[], None]:
    """Return a function that sets the event from any thread, once at a time."""

    def wake() -> None:
        if not news.is_set():
            with contextlib.suppress(RuntimeError):  # the server has ended
                loop.call_soon_threadsafe(news.set)

    return wake


def _port_of(server: Server) -> int:
    port: int = next(iter(server.sockets)).getsockname()[1]
    return port


def _require_packages() -> None:
    for name in ("websockets", "cbor2"):
        try:
            __import__(name)
        except ImportError:
            raise MissingExtraError(name, "rosbridge", "gazelle-ros") from None
