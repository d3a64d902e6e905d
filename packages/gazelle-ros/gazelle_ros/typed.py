"""The message class that a connection's header describes, known here or not."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any

from gazelle_ros.base.errors import Error
from gazelle_ros.errors import RosError
from gazelle_ros.messages import class_from_text, load_message
from gazelle_ros.raw import RawMessage


def class_for(header: Mapping[str, str]) -> Any:
    """Return the class of a connection's messages, or of a connection in a bag.

    The class known here is taken if it has the same checksum; else one is made of the definition
    in the header, so that a type that is not installed is understood all the same.

    Raises:
        RosError: The type is not known here, and there is no definition in the header.
    """
    kind, checksum = header.get("type", ""), header.get("md5sum", "")
    return _class_for(kind, checksum, header.get("message_definition", ""))


@functools.lru_cache(maxsize=512)
def _class_for(kind: str, checksum: str, text: str) -> Any:
    try:
        known = load_message(kind)
    except Error:
        known = None
    if known is not None and checksum in {known._md5sum, "*", ""}:
        return known
    if not text:
        raise RosError(f"the type {kind} is not known here, nor did its definition come along")
    return class_from_text(kind, text)


def decode(raw: RawMessage) -> Any:
    """Decode a message of bytes.

    Raises:
        RosError: Its type is not known here, and its definition did not come along.
    """
    kind = class_for(raw._connection_header)
    return kind().deserialize(raw._buff)
