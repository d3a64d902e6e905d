"""rosmsg's interface: definitions of messages and services as text."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

from gazelle_ros.compat import commands
from gazelle_ros.errors import RosError
from gazelle_ros.tools import definitions
from gazelle_ros.tools.definitions import Kind

MODE_MSG = ".msg"
MODE_SRV = ".srv"


class ROSMsgException(Exception):  # noqa: N818  # rosmsg's name
    """There is no such type or package."""


def _kind(mode: str) -> Kind:
    if mode not in {MODE_MSG, MODE_SRV}:
        raise ValueError(f"Unknown mode: {mode}")
    return cast("Kind", mode[1:])


def _text(kind: Kind, name: str, *, raw: bool) -> str:
    try:
        return definitions.show_type(name, kind, raw=raw)
    except RosError as error:
        raise ROSMsgException(str(error)) from None


def get_msg_text(type_: str, raw: bool = False, rospack: Any = None) -> str:  # noqa: FBT001, FBT002  # rosmsg's interface
    """Return the definition of a message with those of its fields, or with `raw` the file's text.

    Raises:
        ROSMsgException: There is no such type.
    """
    del rospack
    return _text("msg", type_, raw=raw)


def get_srv_text(type_: str, raw: bool = False, rospack: Any = None) -> str:  # noqa: FBT001, FBT002  # rosmsg's interface
    """Return the definition of a service; see `get_msg_text`.

    Raises:
        ROSMsgException: There is no such type.
    """
    del rospack
    return _text("srv", type_, raw=raw)


def list_types(package: str, mode: str = MODE_MSG, rospack: Any = None) -> list[str]:
    """Return full names of a package's types.

    Raises:
        ValueError: There is no such package.
    """
    del rospack
    try:
        return definitions.package_types(package, _kind(mode))
    except RosError as error:
        raise ValueError(str(error)) from None


def list_msgs(package: str, rospack: Any = None) -> list[str]:
    """Return full names of a package's messages."""
    return list_types(package, MODE_MSG, rospack)


def list_srvs(package: str, rospack: Any = None) -> list[str]:
    """Return full names of a package's services."""
    return list_types(package, MODE_SRV, rospack)


def iterate_packages(rospack: Any, mode: str) -> Iterator[tuple[str, str]]:
    """Yield packages with types of a mode, and their folders, empty for built-in ones."""
    from gazelle_ros.messages.search import find_packages

    del rospack
    folders = find_packages()
    for package in definitions.packages_with(_kind(mode)):
        folder = folders.get(package)
        yield package, "" if folder is None else str(folder / mode[1:])


def rosmsg_search(rospack: Any, mode: str, base_type: str) -> Iterator[str]:
    """Yield full names of all types of a short name."""
    del rospack
    yield from definitions.types_named(base_type, _kind(mode))


def rosmsg_md5(mode: str, type_: str) -> str:
    """Return the MD5 sum of a type.

    Raises:
        OSError: There is no such type.
    """
    try:
        return definitions.type_md5(type_, _kind(mode))
    except RosError:
        raise OSError(f"cannot load [{type_}]") from None


def rosmsgmain(mode: str = MODE_MSG) -> None:
    """Run ``rosmsg`` or ``rossrv`` with this process's command line.

    Raises:
        SystemExit: It failed.
    """
    commands.run(_kind(mode))
