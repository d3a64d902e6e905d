"""Peers that read and write ROS 1 messages too."""

import re
import sys
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import message_samples
import pytest

from gazelle_ros.messages import Message, load_message, register

_CONSTANT = re.compile(r"\w+ +\w+ *= *[^=]")
_DEBIAN = "/usr/lib/python3/dist-packages"


@pytest.fixture(scope="session")
def all_kinds() -> type[Message]:
    """Return a message type with every kind of field."""
    for name, text in message_samples.SAMPLE_TYPES.items():
        register("sample_msgs", name, text)
    return load_message("sample_msgs/AllKinds")


@pytest.fixture(scope="session")
def rosbags_store() -> Callable[[type[Message]], tuple[Any, str]]:
    """Return rosbags' type store with a message type in it, and the type's name there."""
    typesys = pytest.importorskip("rosbags.typesys", reason="rosbags is not installed")
    store = typesys.get_typestore(typesys.Stores.EMPTY)

    def of(made: type[Message]) -> tuple[Any, str]:
        name = made._type.replace("/", "/msg/")
        if name not in store.types:
            # Its grammar has no constants with small letters; they are not in the bytes anyway.
            lines = (line for line in made._full_text.split("\n") if not _CONSTANT.match(line))
            store.register(typesys.get_types_from_msg("\n".join(lines), name))
        return store, name

    return of


@pytest.fixture(scope="session")
def genpy() -> Iterator[SimpleNamespace]:
    """Yield the real genpy: its modules, and its class of any type of ours."""
    before = set(sys.modules)
    sys.path.append(_DEBIAN)
    try:
        import genpy
        import genpy.dynamic
        import genpy.message
    except ImportError:
        pytest.skip("the real genpy is not installed (python3-genpy)")
    finally:
        sys.path.remove(_DEBIAN)
    if not genpy.__file__.startswith(_DEBIAN):
        pytest.skip("another genpy hides the real one")
    made: dict[str, dict[str, Any]] = {}

    def class_of(ours: type[Message]) -> Any:
        if ours._type not in made:
            made[ours._type] = genpy.dynamic.generate_dynamic(ours._type, ours._full_text)
        # Where it looks for the classes of messages in arrays, before it imports packages.
        genpy.message._message_class_cache.update(made[ours._type])
        return made[ours._type][ours._type]

    def copy_of(message: Message) -> Any:
        family = class_of(type(message)) and made[type(message)._type]
        return _copy(message, family, genpy)

    yield SimpleNamespace(
        class_of=class_of,
        copy_of=copy_of,
        message=genpy.message,
        Time=genpy.Time,
        Duration=genpy.Duration,
    )
    for name in set(sys.modules) - before:
        if name.partition(".")[0] in {"genpy", "genmsg"}:
            del sys.modules[name]


def _copy(value: Any, family: dict[str, Any], genpy: Any) -> Any:
    if isinstance(value, Message):
        copied = [_copy(getattr(value, name), family, genpy) for name in value.__slots__]
        return family[value._type](*copied)
    if isinstance(value, (list, tuple)):
        return [_copy(each, family, genpy) for each in value]
    if type(value).__name__ in {"Time", "Duration"}:
        copied = getattr(genpy, type(value).__name__)()
        copied.secs, copied.nsecs = value.secs, value.nsecs
        return copied
    return value
