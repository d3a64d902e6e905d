"""Make message and service classes from their definitions."""

from __future__ import annotations

from typing import Any, cast

from gazelle_ros.messages.base import Message, ServiceDefinition
from gazelle_ros.messages.spec import MessageSpec, ServiceSpec, python_name


def message_class(
    spec: MessageSpec,
    *,
    md5sum: str,
    full_text: str,
    known: dict[str, type[Message]],
    module: str = "msg",
) -> type[Message]:
    """Create a message class; its code is compiled when it is first used.

    Args:
        spec: The definition.
        md5sum: Its MD5 sum.
        full_text: It and all it depends on.
        known: Classes of the message types in its fields, at any depth.
        module: ``msg``, or ``srv`` for requests and responses.
    """
    body: dict[str, Any] = {
        "__slots__": [field.attribute for field in spec.fields],
        "__module__": f"{spec.package}.{module}._{spec.short_name}",
        "__qualname__": spec.short_name,
        "__doc__": f"The message {spec.full_name}.",
        "_slot_types": [field.type for field in spec.fields],
        "_type": spec.full_name,
        "_md5sum": md5sum,
        "_full_text": full_text,
        "_has_header": spec.has_header,
        "_spec": spec,
        "_known": known,
    }
    body |= {python_name(each.name): each.value for each in spec.constants}
    return cast("type[Message]", type(spec.short_name, (Message,), body))


def service_class(
    spec: ServiceSpec,
    *,
    md5sum: str,
    full_text: str,
    request: type[Message],
    response: type[Message],
) -> type[ServiceDefinition]:
    """Create a service class, which names its request and response classes."""
    package, _, short = spec.full_name.partition("/")
    body: dict[str, Any] = {
        "__slots__": (),
        "__module__": f"{package}.srv._{short}",
        "__qualname__": short,
        "__doc__": f"The service {spec.full_name}.",
        "_type": spec.full_name,
        "_md5sum": md5sum,
        "_full_text": full_text,
        "_request_class": request,
        "_response_class": response,
    }
    return cast("type[ServiceDefinition]", type(short, (ServiceDefinition,), body))
