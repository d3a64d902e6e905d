"""Types and their definitions, as rosmsg and rossrv show them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.messages import definitions, load_message, load_service
from gazelle_ros.messages.errors import UnknownTypeError
from gazelle_ros.messages.parse import parse_message
from gazelle_ros.messages.registry import package_names
from gazelle_ros.messages.search import find_packages
from gazelle_ros.messages.spec import MessageSpec
from gazelle_ros.tools.errors import ToolError

Kind = Literal["msg", "srv"]


def types_named(name: str, kind: Kind) -> list[str]:
    """Return the types of a word: itself if it has a package, else all types of that name."""
    if "/" in name:
        return [name]
    return [each for each in definitions(kind) if each.partition("/")[2] == name]


def show_type(name: str, kind: Kind, *, raw: bool = False) -> str:
    """Return the definition of a type; those of its fields below them, unless it is raw.

    Raises:
        ToolError: There is no such type.
    """
    halves = list(_halves(name, kind))
    if raw:
        return "---\n".join(_ended(spec.text) for spec in halves)
    return "---\n".join("".join(_lines(spec, "")) for spec in halves)


def type_md5(name: str, kind: Kind) -> str:
    """Return the MD5 sum of a type.

    Raises:
        ToolError: There is no such type.
    """
    try:
        return (load_message if kind == "msg" else load_service)(name)._md5sum
    except UnknownTypeError as error:
        raise _unknown(name, kind, error) from None


def package_types(package: str, kind: Kind) -> list[str]:
    """Return full names of the types of a package.

    Raises:
        ToolError: There is no such package.
    """
    found = package_names(package, kind)
    if not found and package not in {*find_packages(), *packages_with(kind)}:
        raise ToolError(
            f"there is no package '{package}'", hint=did_you_mean(package, packages_with(kind))
        )
    return [f"{package}/{name}" for name in found]


def packages_with(kind: Kind) -> list[str]:
    """Return names of the packages that have types."""
    return sorted({name.partition("/")[0] for name in definitions(kind)})


def _halves(name: str, kind: Kind) -> Iterator[MessageSpec]:
    try:
        if kind == "msg":
            classes = [load_message(name)]
        else:
            service = load_service(name)
            classes = [service._request_class, service._response_class]
    except UnknownTypeError as error:
        raise _unknown(name, kind, error) from None
    for each in classes:
        yield parse_message(each._type, each._full_text.partition("\n" + "=" * 80)[0])


def _lines(spec: MessageSpec, indent: str) -> Iterator[str]:
    for constant in spec.constants:
        yield f"{indent}{constant.type} {constant.name}={constant.text}\n"
    for field in spec.fields:
        yield f"{indent}{field.type} {field.name}\n"
        if field.is_message:
            (inner,) = _halves(field.base, "msg")
            yield from _lines(inner, indent + "  ")


def _ended(text: str) -> str:
    return text if not text or text.endswith("\n") else text + "\n"


def _unknown(name: str, kind: Kind, error: UnknownTypeError) -> ToolError:
    what = "message" if kind == "msg" else "service"
    return ToolError(f"there is no {what} type '{name}'", hint=error.hint)
