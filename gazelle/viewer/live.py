"""A world in the plane, live in a browser on this machine."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, ClassVar

from gazelle.closing import Closeable
from gazelle.errors import Error
from gazelle.simulation import Simulation
from gazelle.viewer.live_world import LiveWorld

_HOST = "127.0.0.1"
_PAGE = Path(__file__).with_name("live.html")
_GUESTS = 8  # pages that are kept up to date at once
_SAFE = {
    "Content-Security-Policy": "default-src 'self' 'unsafe-inline'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
}


class LiveView(Closeable):
    """Shows a world of the planar engine in a browser while it runs; also a context manager.

    A small web server answers on this machine's loopback address only, and only tells: nobody
    can change anything through it. While no page is open it costs nothing.

    Args:
        simulation: Of a world with ``engine="planar"``.
        world: Which world of a batch.
        port: Of the server; any free one if 0.
        rate: Pictures a second.

    Attributes:
        url: Where the page is.

    Raises:
        Error: The simulation is not in the plane, there is no such world, the rate is not above
            zero, or the port is taken.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        world: int = 0,
        port: int = 0,
        rate: float = 10.0,
    ) -> None:
        if not rate > 0.0:
            raise Error(f"a view needs a rate above zero, not {rate:g}")
        self._look = LiveWorld(simulation, world)
        self._call = simulation.requests.call
        self._period = 1.0 / rate
        self._stop = threading.Event()
        self._guests = threading.Semaphore(_GUESTS)
        try:
            self._server = _Server((_HOST, port), _Handler)
        except (OSError, OverflowError) as error:
            raise Error(f"no view on port {port}: {error}", hint="choose another port") from error
        self._server.view = self
        self.url = f"http://{_HOST}:{self._server.server_address[1]}/"
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(0.1,), name="live-view", daemon=True
        )
        self._thread.start()

    def scenery(self) -> dict[str, Any]:
        """What stands still, asked for between two steps."""
        return self._call(self._look.scenery)

    def follow(self, tell: Callable[[dict[str, Any]], None]) -> bool:
        """Tell the state again and again until ``close``; False if too many are told already."""
        if not self._guests.acquire(blocking=False):
            return False
        try:
            while not self._stop.is_set():
                tell(self._call(self._look.state))
                self._stop.wait(self._period)
        finally:
            self._guests.release()
        return True

    def close(self) -> None:
        """End the server; pages that are open show the last picture."""
        self._stop.set()
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


class _Server(ThreadingHTTPServer):
    """Knows what it shows."""

    daemon_threads = True
    block_on_close = False
    allow_reuse_address = False
    view: LiveView


class _Handler(BaseHTTPRequestHandler):
    """Answers GET for the page, the scenery and the stream of states; nothing else."""

    protocol_version = "HTTP/1.1"
    timeout = 10.0
    server: _Server
    _kinds: ClassVar[dict[str, str]] = {
        "/": "text/html; charset=utf-8",
        "/world": "application/json",
    }

    def do_GET(self) -> None:  # http.server's name
        """Answer."""
        if not self._is_local():
            self.send_error(HTTPStatus.FORBIDDEN, "this view is for this machine only")
        elif self.path == "/events":
            self._stream()
        elif self.path == "/":
            self._send(_PAGE.read_bytes())
        elif self.path == "/world":
            self._send(json.dumps(self.server.view.scenery()).encode())
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def _is_local(self) -> bool:
        """Whether the page was asked for by this machine's name, not by one that leads here."""
        name, _, _ = self.headers.get("Host", "").rpartition(":")
        return name in {_HOST, "localhost"}

    def _send(self, body: bytes) -> None:
        self._begin(self._kinds[self.path], {"Content-Length": str(len(body))})
        self.wfile.write(body)

    def _stream(self) -> None:
        """Server-sent events (the HTML standard's), one for each state."""
        begun = False

        def tell(state: dict[str, Any]) -> None:
            nonlocal begun
            if not begun:
                self._begin("text/event-stream", {"Connection": "close"})
                begun = True
            self.wfile.write(b"data: " + json.dumps(state).encode() + b"\n\n")
            self.wfile.flush()

        try:
            if not self.server.view.follow(tell):
                self.send_error(HTTPStatus.SERVICE_UNAVAILABLE, "too many pages are open")
        except OSError:
            pass  # the page was closed
        self.close_connection = True

    def _begin(self, kind: str, more: dict[str, str]) -> None:
        self.send_response(HTTPStatus.OK)
        for name, value in ({"Content-Type": kind} | _SAFE | more).items():
            self.send_header(name, value)
        self.end_headers()

    def log_message(self, *_args: object) -> None:
        """Nothing: a view does not talk."""
