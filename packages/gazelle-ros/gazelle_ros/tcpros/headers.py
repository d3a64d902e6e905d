"""Connection headers: ``key=value`` fields, each with its length before it."""

from __future__ import annotations

import struct
from collections.abc import Mapping

from gazelle_ros.errors import Md5MismatchError, ProtocolError

_LENGTH = struct.Struct("<I")
ANY = "*"


def encode(fields: Mapping[str, str]) -> bytes:
    """Return a whole header, with its length before it."""
    parts = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(_LENGTH.pack(len(part)) + part for part in parts)
    return _LENGTH.pack(len(body)) + body


def decode(body: bytes) -> dict[str, str]:
    """Return the fields of a header (without its own length).

    Raises:
        ProtocolError: It is malformed.
    """
    fields: dict[str, str] = {}
    position = 0
    while position < len(body):
        if position + 4 > len(body):
            raise ProtocolError("the connection header ends within a length")
        (length,) = _LENGTH.unpack_from(body, position)
        position += 4
        if position + length > len(body):
            raise ProtocolError("a field is longer than its connection header")
        key, equals, value = body[position : position + length].partition(b"=")
        if not equals or not key:
            raise ProtocolError(f"not a field of a connection header: {key[:40]!r}")
        fields[key.decode(errors="replace")] = value.decode(errors="replace")
        position += length
    return fields


def require(fields: Mapping[str, str], *names: str) -> None:
    """Check that the fields are present.

    Raises:
        ProtocolError: One is missing.
    """
    for name in names:
        if name not in fields:
            raise ProtocolError(f"Missing required '{name}' field")


def check_publisher(fields: Mapping[str, str], topic: str, md5sum: str, kind: str) -> None:
    """Check, as a subscriber, the header of a publisher.

    Raises:
        ProtocolError: The publisher refused, or left out a required field.
        Md5MismatchError: It publishes another type, as it says or as we see.
    """
    if "error" in fields:
        refusal = fields["error"]
        # The words of roscpp, and those of rospy.
        types_differ = "md5sum" in refusal or "types do not match" in refusal
        kind_of_error = Md5MismatchError if types_differ else ProtocolError
        raise kind_of_error(f"the publisher of {topic} refused: {refusal}")
    require(fields, "md5sum", "type")
    if ANY not in {md5sum, fields["md5sum"]} and fields["md5sum"] != md5sum:
        raise Md5MismatchError(
            f"{topic} carries {fields['type']} ({fields['md5sum']}), not {kind} ({md5sum})",
            hint="both ends need the same version of the message definition",
        )


def flag(fields: Mapping[str, str], name: str) -> bool:
    """Return True if the field is present and ``1``."""
    return fields.get(name) == "1"
