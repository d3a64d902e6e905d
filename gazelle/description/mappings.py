"""Pickles and copies of descriptions that hold read-only mappings, which Python cannot pickle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType
from typing import Any


class HoldsMappings:
    """A dataclass with read-only mappings, also after a pickle or a copy."""

    __slots__ = ()

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the class, and the values of its fields as Python can pickle them."""
        values = {each.name: getattr(self, each.name) for each in fields(self)}  # type: ignore[arg-type]  # a dataclass is
        return _rebuilt, (type(self), {name: _plain(each) for name, each in values.items()})


def _rebuilt(kind: type[Any], values: dict[str, Any]) -> Any:
    return kind(**{name: _read_only(value) for name, value in values.items()})


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _plain(inner) for name, inner in value.items()}
    return value


def _read_only(value: Any) -> Any:
    if isinstance(value, dict):
        return MappingProxyType({name: _read_only(inner) for name, inner in value.items()})
    return value
