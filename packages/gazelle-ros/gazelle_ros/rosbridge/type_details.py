"""Structure of messages, as rosapi's ``message_details`` returns it."""

from __future__ import annotations

from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.messages import Message, load_message, load_service
from gazelle_ros.messages.spec import BUILTIN, TIMES
from gazelle_ros.msgs import rosapi
from gazelle_ros.rosbridge.values import split_type


def message_details(kind: str) -> list[rosapi.msg.TypeDef]:
    """Return a ``rosapi/TypeDef`` of a message type, and one of each type in it.

    Raises:
        RosError: There is no such type.
    """
    return _details(load_message(kind))


def service_details(kind: str, part: str) -> list[rosapi.msg.TypeDef]:
    """Return the ``rosapi/TypeDef`` of the ``request`` or ``response`` of a service type.

    Raises:
        RosError: There is no such type.
    """
    service = load_service(kind)
    return _details(service._request_class if part == "request" else service._response_class)


def definition_text(kind: str) -> str:
    """Return the whole definition of a type; empty if it is not known."""
    try:
        return load_message(kind)._full_text
    except RosError:
        return ""


def _details(message_class: type[Message]) -> list[rosapi.msg.TypeDef]:
    """Return the class first, then the types of its fields, each once, in the order of fields."""
    found: dict[str, rosapi.msg.TypeDef] = {}

    def visit(kind: str, each: type[Message] | None) -> None:
        if kind in found:
            return
        found[kind] = _time_definition(kind) if each is None else _definition(each)
        for inner in found[kind].fieldtypes:
            if inner in TIMES:
                visit(inner, None)
            elif inner not in BUILTIN:
                visit(inner, load_message(inner))

    visit(message_class._type, message_class)
    return list(found.values())


def _definition(message_class: type[Message]) -> rosapi.msg.TypeDef:
    made = rosapi.msg.TypeDef(type=message_class._type)
    instance, lengths = message_class(), []
    for field in message_class._spec.fields:
        base, is_array, length = split_type(field.type)
        made.fieldnames.append(field.name)
        made.fieldtypes.append(base)
        lengths.append((length or 0) if is_array else -1)
        made.examples.append(_example(base, getattr(instance, field.attribute), is_array=is_array))
    made.fieldarraylen = lengths
    for constant in sorted(message_class._spec.constants, key=lambda each: each.name):
        made.constnames.append(constant.name)
        made.constvalues.append(str(constant.value))
    return made


def _example(base: str, default: Any, *, is_array: bool) -> str:
    if is_array:
        return "[]"
    return str(default) if base in BUILTIN - TIMES else "{}"


def _time_definition(kind: str) -> rosapi.msg.TypeDef:
    made = rosapi.msg.TypeDef(type=kind)
    made.fieldnames, made.fieldtypes = ["secs", "nsecs"], ["int32", "int32"]
    made.fieldarraylen, made.examples = [-1, -1], ["0", "0"]
    return made
