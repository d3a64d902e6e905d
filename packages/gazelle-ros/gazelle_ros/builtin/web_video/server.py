"""The HTTP server of ``web_video_server``, and its node."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qsl, urlsplit

from gazelle_ros.base.errors import Error, RosError
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.web_video.pages import stream_list, viewer
from gazelle_ros.builtin.web_video.streams import (
    NewestPicture,
    Picture,
    StreamRequest,
    compressed_stream,
    picture_stream,
)
from gazelle_ros.net import MAX_PORT, is_loopback
from gazelle_ros.node import Node
from gazelle_ros.rosbridge.origins import may_connect
from gazelle_ros.rosbridge.settings import BridgeSettings

_BOUNDARY = "boundarydonotcross"
_LOOK_S = 0.25
_SNAPSHOT_S = 30.0
_FRESH = {
    "Cache-Control": "no-cache, no-store, must-revalidate, pre-check=0, post-check=0, max-age=0",
    "Pragma": "no-cache",
}
_TYPES = ("mjpeg", "png", "ros_compressed")
_LOG = logging.getLogger("gazelle.ros.web_video")


@dataclass(frozen=True, slots=True)
class WebVideoSettings:
    """Parameters of ``web_video_server``.

    Attributes:
        port: To listen on; 0 for any free one.
        address: Of the interface; ``0.0.0.0``, the original's default, for all.
        verbose: Whether requests are logged.
        server_threads: Not needed: each request has a thread.
        ros_threads: Not needed.
        publish_rate: Least rate of pictures, by repeating the last one [Hz]; -1 for none.
        default_stream_type: Of requests that name none.
    """

    port: int = 8080
    address: str = "127.0.0.1"
    verbose: bool = True
    server_threads: int = 1
    ros_threads: int = 2
    publish_rate: float = -1.0
    default_stream_type: str = "mjpeg"

    def __post_init__(self) -> None:
        if not 0 <= self.port <= MAX_PORT:
            raise RosError(f"'port' is 0 to {MAX_PORT}, not {self.port}")


class WebVideoServer:
    """A server of images for web pages.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong, or the port is taken.

    Attributes:
        port: The port it listens on.
    """

    def __init__(self, node: Node) -> None:
        self.settings = settings_of(node, WebVideoSettings)
        self.node = node
        self._ended = threading.Event()
        at = (self.settings.address or "0.0.0.0", self.settings.port)  # noqa: S104  # as the original
        try:
            self._http = _PictureServer(at, _Handler)
        except (OSError, UnicodeError) as error:
            raise RosError(f"the video server cannot listen on {at[0]}:{at[1]}: {error}") from None
        self._http.owner = self
        self.port: int = self._http.server_address[1]

    def run(self, stop: threading.Event) -> None:
        """Answer requests until shutdown."""
        _LOG.info("Waiting For connections on %s:%d", self.settings.address, self.port)
        if not is_loopback(self.settings.address):
            _LOG.warning("every machine that reaches this one can see its images")
        thread = threading.Thread(target=self._http.serve_forever, args=(_LOOK_S,), daemon=True)
        thread.start()
        while not self.node.closed and not stop.wait(_LOOK_S):
            pass
        self._ended.set()
        self._http.shutdown()
        self._http.server_close()
        thread.join()

    @property
    def ended(self) -> bool:
        """True once it shuts down."""
        return self._ended.is_set() or self.node.closed

    def topics(self, kind: str) -> list[str]:
        """Return names of the topics of a type."""
        return [name for name, each in self.node.master.published_topics() if each == kind]

    def stream(self, kind: str, asked: StreamRequest) -> NewestPicture:
        """Return the pictures that a request asks for.

        Raises:
            RosError: Nothing publishes them.
        """
        known = dict(self.node.master.published_topics())
        topic = self.node.resolve(f"/{asked.topic.lstrip('/')}")
        compressed = f"{topic}/compressed" in known
        if topic not in known and not compressed:
            raise RosError(f"nothing publishes '{topic}'")
        if kind == "ros_compressed":
            if compressed:
                return compressed_stream(self.node, asked)
            _LOG.warning("%s has no compressed images: they are sent as mjpeg", topic)
        return picture_stream(self.node, "png" if kind == "png" else "jpeg", asked)


class _PictureServer(ThreadingHTTPServer):
    daemon_threads = True
    owner: WebVideoServer


class _Handler(BaseHTTPRequestHandler):
    """Answer of one request."""

    server: _PictureServer
    server_version, sys_version = "web_video_server", ""

    def do_GET(self) -> None:
        """Send a page, a picture or a stream."""
        parts = urlsplit(self.path)
        query = dict(parse_qsl(parts.query, keep_blank_values=True))
        answers: dict[str, Callable[[dict[str, str]], None]] = {
            "/": self._list,
            "/stream": self._stream,
            "/stream_viewer": self._view,
            "/snapshot": self._snapshot,
        }
        answer = answers.get(parts.path)
        if not may_connect(self.headers.get("Origin"), self.headers.get("Host", ""), _ACCESS):
            self._refuse(403, "pages of this origin may not read images")
        elif answer is None:
            self._refuse(404, "there are /, /stream, /stream_viewer and /snapshot")
        else:
            try:
                answer(query)
            except Error as error:
                self._refuse(404, str(error))
            except OSError:
                self.close_connection = True  # the client has left

    def log_message(self, format: str, *arguments: Any) -> None:  # noqa: A002  # http.server's name
        """Log a request."""
        if self.server.owner.settings.verbose:
            _LOG.info(format, *arguments)

    # Answers ------------------------------------------------------------------------------

    def _list(self, _query: dict[str, str]) -> None:
        owner = self.server.owner
        images, cameras = map(owner.topics, ("sensor_msgs/Image", "sensor_msgs/CameraInfo"))
        self._send(200, stream_list(images, cameras).encode(), "text/html", _FRESH)

    def _view(self, query: dict[str, str]) -> None:
        self._kind(query)
        page = viewer(query.get("topic", ""), urlsplit(self.path).query)
        self._send(200, page.encode(), "text/html")

    def _snapshot(self, query: dict[str, str]) -> None:
        pictures = self.server.owner.stream("mjpeg", StreamRequest.read(query))
        try:
            waited = 0.0
            while waited < _SNAPSHOT_S and not self.server.owner.ended:
                found = pictures.wait(_LOOK_S)
                if found is not None:
                    more = {**_FRESH, "X-Timestamp": _stamp(found)}
                    self._send(200, found.data, found.kind, more)
                    return
                if pictures.fault:
                    raise RosError(pictures.fault)
                waited += _LOOK_S
        finally:
            pictures.close()
        raise RosError(f"no image came within {_SNAPSHOT_S:g} s")

    def _stream(self, query: dict[str, str]) -> None:
        owner = self.server.owner
        pictures = owner.stream(self._kind(query), StreamRequest.read(query))
        rate = owner.settings.publish_rate
        try:
            self.send_response(200)
            kind = f"multipart/x-mixed-replace;boundary={_BOUNDARY}"
            self._headers({"Content-type": kind, **_FRESH})
            self.wfile.write(f"--{_BOUNDARY}\r\n".encode())
            last, silent = None, 0.0
            patience = min(1.0 / rate, _LOOK_S) if rate > 0.0 else _LOOK_S
            while not owner.ended and not pictures.fault:
                found = pictures.wait(patience)
                silent = 0.0 if found is not None else silent + patience
                last = found or last
                if found is not None or (last is not None and silent * rate >= 1.0):
                    silent = 0.0
                    self._part(last)
            if pictures.fault:
                _LOG.error("%s", pictures.fault)
        finally:
            pictures.close()
            self.close_connection = True

    def _kind(self, query: dict[str, str]) -> str:
        """Return the type of a stream.

        Raises:
            RosError: There is none of that name.
        """
        kind = query.get("type", self.server.owner.settings.default_stream_type)
        if kind not in _TYPES:
            raise RosError(f"there is no stream type '{kind:.60}' here; there are {list(_TYPES)}")
        return kind

    # Bytes --------------------------------------------------------------------------------

    def _part(self, picture: Picture | None) -> None:
        if picture is None:
            return
        lines = {
            "Content-type": picture.kind,
            "X-Timestamp": _stamp(picture),
            "Content-Length": str(len(picture.data)),
        }
        head = "".join(f"{name}: {value}\r\n" for name, value in lines.items())
        self.wfile.write(f"{head}\r\n".encode() + picture.data + f"\r\n--{_BOUNDARY}\r\n".encode())

    def _refuse(self, code: int, reason: str) -> None:
        self._send(code, f"{reason}\n".encode(), "text/plain")

    def _send(self, code: int, data: bytes, kind: str, more: dict[str, str] | None = None) -> None:
        self.send_response(code)
        length = str(len(data))
        self._headers({"Content-type": kind, "Content-Length": length, **(more or {})})
        self.wfile.write(data)

    def _headers(self, lines: dict[str, str]) -> None:
        """Send the headers of an answer. A page that may connect may read it, too."""
        origin = self.headers.get("Origin")
        for name, value in lines.items():
            self.send_header(name, value)
        self.send_header("Connection", "close")
        self.send_header("Access-Control-Allow-Origin", origin or "*")
        self.end_headers()


_ACCESS = BridgeSettings()
"""Access of pages of this machine, and of the host that is asked, as to rosbridge."""


def _stamp(picture: Picture) -> str:
    return f"{picture.stamp * 1e-9:.6f}"


def main(arguments: Sequence[str]) -> int:
    """Serve images until shutdown; returns the exit code."""
    return run_node(arguments, "web_video_server", WebVideoServer)
