"""A page on this machine, served only to clients that know its address.

viser serves every client of its port, and offers to share the page over the internet. Here every
request, the websocket's too, has to begin with a secret; what comes without it is refused before
viser sees it, and nothing is shared.
"""

from __future__ import annotations

import asyncio
import hmac
import http.client
import importlib
import logging
import secrets
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from http import HTTPStatus
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qsl, urlsplit

from gazelle.errors import Error, MissingExtraError
from gazelle_ros.base.closing import Closeable
from gazelle_ros.server_faults import report_shortages

if TYPE_CHECKING:
    import viser
    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

HOST = "127.0.0.1"
GUESTS = 8
"""Pages that are served at once."""

_LIGHT_BRAND, _DARK_BRAND = (58, 110, 165), (76, 138, 204)
_NAMES = frozenset([HOST, "localhost"])
_OPENING = threading.Lock()
_SAFE = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}

Handler = Callable[[Mapping[str, str]], None]


class PageServer(Closeable):
    """Serves one page of viser's on the loopback address, behind a secret.

    Args:
        title: Of the page's panel.
        port: Any free one if 0.

    Attributes:
        viser: Server of the page and its panel.
        url: Address of the page, with the secret.
        handlers: Requests that scripts on the page may make, by name.

    Raises:
        MissingExtraError: viser is not installed.
        Error: The port is taken, or this viser cannot be guarded.
    """

    def __init__(self, title: str, port: int = 0) -> None:
        package = required_viser()
        if not 0 <= port < 2**16:
            raise Error(f"there is no port {port}", hint="ports are 0 to 65535")
        self._token = secrets.token_urlsafe(16)
        self._changed = threading.Event()
        self._closed = False
        self.handlers: dict[str, Handler] = {}
        with _OPENING, _guarded(self._admit), _silent():
            self.viser: viser.ViserServer = package.ViserServer(HOST, port, title, verbose=False)
        self.port = self.viser.get_port()
        self.url = f"http://{HOST}:{self.port}/{self._token}/"
        try:
            self._check(port)
        except BaseException:
            self.close()
            raise
        self._refuse_shared_port()
        self.viser.on_client_connect(self._note)
        self.viser.on_client_disconnect(self._note)

    @property
    def watched(self) -> bool:
        """True if any page is open."""
        return bool(self.viser.get_clients())

    @property
    def closed(self) -> bool:
        """True once it serves no pages any more."""
        return self._closed

    def wait(self, seconds: float | None = None) -> None:
        """Wait until a client comes or goes, or it is closed."""
        self._changed.wait(seconds)
        self._changed.clear()

    def light_up(self) -> None:
        """Add a sun with shadows, and ambient light, so that no side is black."""
        scene = self.viser.scene
        scene.configure_environment_map(None)
        scene.configure_default_lights(enabled=True, cast_shadow=True)
        scene.add_light_hemisphere(
            "/sky", sky_color=(255, 255, 255), ground_color=(150, 150, 150), intensity=1.2
        )

    def use_theme(self, *, dark: bool) -> None:
        """Show every page in the dark or the light theme."""
        self.viser.gui.configure_theme(
            show_logo=False,
            show_share_button=False,
            dark_mode=dark,
            brand_color=_DARK_BRAND if dark else _LIGHT_BRAND,
        )

    def wake(self) -> None:
        """Wake a ``wait``."""
        self._changed.set()

    def close(self) -> None:
        """Stop serving, and give the port back."""
        if self._closed:
            return
        self._closed = True
        self._changed.set()
        with _OPENING, _silent():
            self.viser.stop()

    async def _note(self, _client: object) -> None:
        self._changed.set()

    def _check(self, port: int) -> None:
        """Check that the requested port is used, and that other clients are rejected."""
        if port not in (0, self.port):
            raise Error(f"no view on port {port}: it is taken", hint="choose another port")
        connection = http.client.HTTPConnection(HOST, self.port, timeout=60)
        try:
            connection.request("GET", "/")
            status = connection.getresponse().status
        finally:
            connection.close()
        if status != HTTPStatus.FORBIDDEN:
            raise Error(
                "this release of viser serves its page to everybody",
                hint='pip install "viser==1.1.1"',
            )

    def _refuse_shared_port(self) -> None:
        from viser import _messages

        for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            self.viser._websock_server.unregister_handler(message)  # noqa: SLF001  there is no switch
        self.use_theme(dark=False)

    def _admit(
        self,
        connection: ServerConnection,
        request: Request,
        serve: Callable[[ServerConnection, Request], Response | None],
    ) -> Response | None:
        """Forward a request to viser, answer it, or reject it."""
        host = urlsplit(f"//{request.headers.get('Host', '')}").hostname
        path, _, query = request.path.partition("?")
        _, token, *rest = (*path.split("/", 2), "")[:3]
        if host not in _NAMES or not hmac.compare_digest(token.encode(), self._token.encode()):
            return connection.respond(HTTPStatus.FORBIDDEN, "this page has a secret address\n")
        name = rest[0]
        if request.headers.get("Upgrade", "").lower() == "websocket":
            if len(self.viser.get_clients()) >= GUESTS:
                return connection.respond(HTTPStatus.SERVICE_UNAVAILABLE, "too many pages\n")
            return None
        if name in self.handlers:
            self.handlers[name](dict(parse_qsl(query)))
            return connection.respond(HTTPStatus.OK, "")
        if name not in ("", "index.html"):
            return connection.respond(HTTPStatus.NOT_FOUND, "there is nothing\n")
        request.path = f"/{name}"
        response = serve(connection, request)
        if response is not None:
            for header, value in (*_SAFE.items(), ("Content-Security-Policy", self._policy())):
                response.headers[header] = value
        return response

    def _policy(self) -> str:
        """Return the policy: no content from elsewhere, and no embedding."""
        own = " ".join(f"ws://{name}:{self.port}" for name in sorted(_NAMES))
        return (
            "default-src 'self' data: blob: 'unsafe-inline' 'unsafe-eval'; "
            f"connect-src 'self' data: blob: {own}; frame-ancestors 'none'; base-uri 'none'"
        )


def required_viser() -> Any:
    """Return the package that serves pages.

    Raises:
        MissingExtraError: It is not installed.
    """
    try:
        import viser
    except ImportError as error:
        raise MissingExtraError("viser", "web") from error
    return viser


@contextmanager
def _guarded(admit: Callable[..., Any]) -> Iterator[None]:
    """Make viser's server check each request while it lasts.

    viser has no hook for it: it gives its own ``process_request`` to websockets' ``serve``.
    """
    from websockets.asyncio import server

    original: Any = server.serve
    log = logging.getLogger("gazelle.viewer")
    log.addHandler(logging.NullHandler())
    log.propagate = False

    def serve(handler: Any, *args: Any, **options: Any) -> Any:
        if not handler.__module__.startswith("viser."):
            return original(handler, *args, **options)
        report_shortages(asyncio.get_running_loop(), "the page")
        inner = options.pop("process_request")

        def check_request(connection: Any, request: Any) -> Any:
            return admit(connection, request, inner)

        return original(handler, *args, process_request=check_request, logger=log, **options)

    server.serve = serve  # type: ignore[misc,assignment]
    try:
        yield
    finally:
        server.serve = original  # type: ignore[misc]


@contextmanager
def _silent() -> Iterator[None]:
    """Silence viser while it lasts: its address lacks the secret."""
    rich: Any = importlib.import_module("rich")  # a dependency of viser
    original = rich.print
    rich.print = lambda *_args, **_options: None
    try:
        yield
    finally:
        rich.print = original
