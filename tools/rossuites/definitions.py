"""Writes Gazelle's definitions of messages as packages, for generators that read files."""

from __future__ import annotations

from collections.abc import Container
from pathlib import Path
from typing import Any

from gazelle_ros import load_message, load_service
from gazelle_ros.messages import definitions

_RULE = "=" * 80


def write(packages: Container[str], folder: Path) -> None:
    """Write the messages and services of packages below a folder; actions as their messages."""
    for name in definitions():
        if name.partition("/")[0] in packages:
            _put(folder, name, "msg", _own(load_message(name)))
    for name in definitions("srv"):
        if name.partition("/")[0] in packages:
            service: Any = load_service(name)
            halves = (_own(service._request_class), _own(service._response_class))
            _put(folder, name, "srv", "\n---\n".join(halves))


def _own(kind: Any) -> str:
    return str(kind._full_text).partition(_RULE)[0]


def _put(folder: Path, name: str, kind: str, text: str) -> None:
    package, _, own = name.partition("/")
    file = folder / package / kind / f"{own}.{kind}"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
