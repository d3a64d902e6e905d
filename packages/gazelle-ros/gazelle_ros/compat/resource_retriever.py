"""Files by ``package://`` and ``file://``, as ``resource_retriever`` gets them; nothing comes from a network."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote

from gazelle_ros.base.bundled_packages import published
from gazelle_ros.base.errors import RosError
from gazelle_ros.launch.packages import Packages

PACKAGE_PREFIX = "package://"
_FILE_PREFIX = "file://"


def get_filename(url: str, use_protocol: bool = True) -> str:  # noqa: FBT001, FBT002  # its own names
    """Return where a resource is, with ``file://`` in front or not.

    Raises:
        RosError: There is no such package, or the address is of another kind.
    """
    if url.startswith(PACKAGE_PREFIX):
        package, slash, path = url.removeprefix(PACKAGE_PREFIX).partition("/")
        if not package or not slash:
            raise RosError(f"'{url}' is not of the form package://PACKAGE/PATH")
        name = str(published(Packages().folder(package) / unquote(path)))
    elif url.startswith(_FILE_PREFIX):
        name = unquote(url.removeprefix(_FILE_PREFIX))
    else:
        raise RosError(
            f"'{url}' is neither package:// nor file://; nothing is fetched from a network"
        )
    return f"{_FILE_PREFIX}{name}" if use_protocol else name


def get(url: str) -> bytes:
    """Return what is in a resource.

    Raises:
        RosError: It is not there.
    """
    try:
        return Path(get_filename(url, use_protocol=False)).read_bytes()
    except OSError as error:
        raise RosError(f"'{url}' cannot be read: {error.strerror}") from None
