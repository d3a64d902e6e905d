"""Web pages that may connect: any page that a browser has open could try."""

from __future__ import annotations

import ipaddress
import socket
from urllib.parse import urlsplit

from gazelle_ros.net import is_loopback
from gazelle_ros.rosbridge.settings import BridgeSettings, matches

_NULL = "null"


def may_connect(origin: str | None, host: str, settings: BridgeSettings) -> bool:
    """Return True if a client with these HTTP headers may connect.

    Programs send no origin and are let in. Pages are, if they are of this machine, come from the
    very host whose rosbridge they ask for, or fit ``allowed_origins``. A page of another site
    that a browser here has open is not. It could call itself ``null`` by a sandboxed frame, as
    files do: that is let in where ``allowed_origins`` holds the word ``null`` itself, or
    ``websocket_null_origin`` is true. As such a page's host may be made to lead here (DNS rebinding), its name only counts as
    this host's if it is an address, or this machine's own name.

    Args:
        origin: Header ``Origin``.
        host: Header ``Host``.
        settings: Of the server.
    """
    if origin is None:
        return True
    if origin == _NULL:
        return settings.websocket_null_origin or _NULL in settings.allowed_origins
    if settings.allowed_origins and matches(origin, settings.allowed_origins):
        return True
    page, allowed_host = _name(origin), _name(f"//{host}")
    if page is None:
        return False
    return is_loopback(page) or (page == allowed_host and _is_trusted(page))


def _name(uri: str) -> str | None:
    try:
        return urlsplit(uri).hostname
    except ValueError:
        return None


def _is_trusted(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        own = socket.gethostname().lower()
        return name in {own, own.partition(".")[0], f"{own.partition('.')[0]}.local"}
    return True
