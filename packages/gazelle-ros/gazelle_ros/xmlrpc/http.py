"""As much of HTTP/1.1 (RFC 9112) as XML-RPC peers use: messages with a Content-Length."""

from __future__ import annotations

from gazelle_ros.errors import ProtocolError
from gazelle_ros.limits import LIMITS, NetworkLimits

REASONS = {
    200: "OK",
    400: "Bad Request",
    403: "Forbidden",
    404: "Not Found",
    411: "Length Required",
    413: "Content Too Large",
    431: "Request Header Fields Too Large",
    501: "Not Implemented",
}


class HttpError(ProtocolError):
    """A message that is not accepted.

    Attributes:
        status: The HTTP status that says so.
    """

    def __init__(self, status: int, message: str) -> None:
        self.status = status
        super().__init__(message)


class HttpMessage:
    """One request or response."""

    __slots__ = ("body", "first", "headers", "keep_alive")

    def __init__(self, first: list[str], headers: dict[str, str]) -> None:
        self.first = first
        self.headers = headers
        self.body = b""
        version = first[-1] if first[0][:5] != "HTTP/" else first[0]
        connection = headers.get("connection", "").lower()
        self.keep_alive = (
            "keep-alive" in connection if version == "HTTP/1.0" else "close" not in connection
        )


class MessageReader:
    """Cuts a stream of bytes into messages.

    Args:
        limits: Bounds on header and body.
        response: True if the stream holds responses; a body without length ends the stream.
    """

    def __init__(self, limits: NetworkLimits = LIMITS, *, response: bool = False) -> None:
        self._limits = limits
        self._response = response
        self._buffer = bytearray()
        self._searched = 0
        self._message: HttpMessage | None = None
        self._length: int | None = None
        self.expects_continue = False

    def __bool__(self) -> bool:
        """Return True if part of a message has arrived."""
        return bool(self._buffer) or self._message is not None

    def feed(self, data: bytes) -> None:
        """Add what came in."""
        self._buffer += data

    def next(self) -> HttpMessage | None:
        """Return the next whole message, or None.

        Raises:
            HttpError: The stream is not acceptable; it cannot be read further.
        """
        if self._message is None and not self._read_head():
            return None
        message, length = self._message, self._length
        if message is None or length is None or len(self._buffer) < length:
            return None
        with memoryview(self._buffer) as view:
            message.body = bytes(view[:length])
        del self._buffer[:length]
        self._message, self._searched = None, 0
        return message

    def end(self) -> HttpMessage | None:
        """Return the message with a body ended by the stream, if any."""
        message, self._message = self._message, None
        if message is None or self._length is not None:
            return None
        message.body = bytes(self._buffer)
        message.keep_alive = False
        self._buffer.clear()
        return message

    def _read_head(self) -> bool:
        end = self._buffer.find(b"\r\n\r\n", max(0, self._searched - 3))
        if end < 0:
            self._searched = len(self._buffer)
            if self._searched > self._limits.http_header_bytes:
                raise HttpError(431, "the HTTP header is too long")
            self._check_start()
            return False
        if end > self._limits.http_header_bytes:
            raise HttpError(431, "the HTTP header is too long")
        head = self._buffer[:end].decode("latin-1")
        del self._buffer[: end + 4]
        self._message = self._parse_head(head)
        self._length = self._body_length(self._message)
        self.expects_continue = "100-continue" in self._message.headers.get("expect", "").lower()
        return True

    def _check_start(self) -> None:
        """Raise an error early for anything but HTTP, such as a TCPROS header on this port."""
        start = bytes(self._buffer[:16]).lstrip(b"\r\n")
        if start and not start[:1].isalpha():
            raise HttpError(400, "this is not HTTP")

    def _parse_head(self, head: str) -> HttpMessage:
        lines = head.lstrip("\r\n").split("\r\n")
        first = lines[0].split(" ", 2) if self._response else lines[0].split()
        if len(first) < 2 or (not self._response and len(first) != 3):
            raise HttpError(400, f"not an HTTP message: {lines[0][:60]!r}")
        version = first[0] if self._response else first[-1]
        if not version.startswith("HTTP/1."):
            raise HttpError(400, f"not HTTP/1: {version[:20]!r}")
        headers = {}
        for line in lines[1:]:
            name, colon, value = line.partition(":")
            if not colon:
                raise HttpError(400, f"not a header line: {line[:60]!r}")
            headers[name.strip().lower()] = value.strip()
        return HttpMessage(first, headers)

    def _body_length(self, message: HttpMessage) -> int | None:
        if "transfer-encoding" in message.headers:
            raise HttpError(501, "transfer encodings are not supported")
        text = message.headers.get("content-length")
        if text is None:
            if self._response:
                return None
            if message.first[0] == "POST":
                raise HttpError(411, "the request has no Content-Length")
            return 0
        if not (text.isascii() and text.isdigit()):
            raise HttpError(400, f"not a Content-Length: {text[:40]!r}")
        length = int(text) if len(text) < 19 else self._limits.xml_bytes + 1
        if length > self._limits.xml_bytes:
            raise HttpError(413, f"the body is longer than {self._limits.xml_bytes} bytes")
        return length


def request(host: str, path: str, body: bytes) -> bytes:
    """Return a POST request with an XML body."""
    head = (
        f"POST {path} HTTP/1.1\r\nHost: {host}\r\nUser-Agent: gazelle\r\n"
        f"Content-Type: text/xml\r\nContent-Length: {len(body)}\r\n\r\n"
    )
    return head.encode() + body


def response(status: int, body: bytes, *, keep_alive: bool = True, kind: str = "text/xml") -> bytes:
    """Return a response; HTTP/1.1."""
    head = (
        f"HTTP/1.1 {status} {REASONS.get(status, 'Error')}\r\nServer: gazelle\r\n"
        f"Content-type: {kind}\r\nContent-length: {len(body)}\r\n"
    )
    if not keep_alive:
        head += "Connection: close\r\n"
    return head.encode() + b"\r\n" + body
