"""Methods of MoveIt's Python classes that only pass on what they are given."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class PassedOn:
    """A method that is that of another object, under the same name or another one.

    Args:
        attribute: Where the other object is.
        kind: Its class.
        name: Of its method; that of the attribute if None.
    """

    def __init__(self, attribute: str, kind: type[Any], name: str | None = None) -> None:
        self._attribute, self._kind, self._name = attribute, kind, name

    def __set_name__(self, owner: type[Any], name: str) -> None:
        self._name = self._name or name

    def __get__(self, instance: Any, owner: type[Any]) -> Callable[..., Any]:
        source = self._kind if instance is None else getattr(instance, self._attribute)
        found: Callable[..., Any] = getattr(source, str(self._name))
        return found
