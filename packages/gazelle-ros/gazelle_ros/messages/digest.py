"""MD5 sums and full texts of definitions, by the rules of genmsg.

The rules are public: http://wiki.ros.org/ROS/Technical%20Overview, "Message serialization and
msg MD5 sums".
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator

from gazelle_ros.messages.spec import BUILTIN, MessageSpec, ServiceSpec

SEPARATOR = "=" * 80
"""The line between a definition and those it depends on, in a full text."""

Lookup = Callable[[str], MessageSpec]
Md5Of = Callable[[str], str]


def hashed_text(spec: MessageSpec, md5_of: Md5Of) -> str:
    """Return the text for the MD5 sum of a message: constants, then fields, no comments."""
    lines = [f"{each.type} {each.name}={each.text}" for each in spec.constants]
    for field in spec.fields:
        if field.base in BUILTIN:
            lines.append(f"{field.type} {field.name}")
        else:
            lines.append(f"{md5_of(field.base)} {field.name}")
    return "\n".join(lines).strip()


def message_md5(spec: MessageSpec, md5_of: Md5Of) -> str:
    """Return MD5 sum of a message; ``md5_of`` gives those of the messages in it."""
    return _md5(hashed_text(spec, md5_of))


def service_md5(spec: ServiceSpec, md5_of: Md5Of) -> str:
    """Return MD5 sum of a service."""
    return _md5(hashed_text(spec.request, md5_of) + hashed_text(spec.response, md5_of))


def full_text(spec: MessageSpec, lookup: Lookup) -> str:
    """Return a definition followed by all that it depends on, each once."""
    names = dict.fromkeys(_all_depends(spec, lookup))
    others = [f"{SEPARATOR}\nMSG: {name}\n{lookup(name).text}" for name in names]
    return "\n".join([spec.text, *others])


def split_full_text(text: str) -> tuple[str, dict[str, str]]:
    """Return the main definition of a full text, and the texts of the others by their names."""
    main, *others = text.split(f"\n{SEPARATOR}\n")
    depends = {}
    for part in others:
        head, _, body = part.partition("\n")
        if head.startswith("MSG: "):
            name = head.removeprefix("MSG: ").strip()
            depends["std_msgs/Header" if name == "roslib/Header" else name] = body
    return main, depends


def _all_depends(spec: MessageSpec, lookup: Lookup) -> Iterator[str]:
    for name in spec.depends:
        yield name
        yield from _all_depends(lookup(name), lookup)


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()
