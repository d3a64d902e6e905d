"""Objects that only the owner of the state may use, for all other threads."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, update_wrapper
from typing import Any, TypeVar, cast

from gazelle.engines.table import Table
from gazelle.simulation.requests import RequestQueue

T = TypeVar("T")


class _SharedObject:
    """Uses an object between two steps, whatever is read, set or called on it.

    ``isinstance`` takes it for the object.
    """

    __slots__ = ("_requests", "_target")

    def __init__(self, target: Any, requests: RequestQueue) -> None:
        object.__setattr__(self, "_target", target)
        object.__setattr__(self, "_requests", requests)

    @property  # type: ignore[misc]
    def __class__(self) -> type[Any]:
        return type(self._target)

    def __getattr__(self, name: str) -> Any:
        call, target = self._requests.call, self._target
        value = call(lambda: getattr(target, name))
        if isinstance(value, Table):
            return shared(value, self._requests)
        if not callable(value):
            return value

        def asked(*args: Any, **options: Any) -> Any:
            return call(partial(value, *args, **options))

        return cast("Callable[..., Any]", update_wrapper(asked, value))

    def __getitem__(self, key: Any) -> Any:
        return shared(self._requests.call(lambda: self._target[key]), self._requests)

    def __setattr__(self, name: str, value: Any) -> None:
        self._requests.call(lambda: setattr(self._target, name, value))

    def __delattr__(self, name: str) -> None:
        self._requests.call(lambda: delattr(self._target, name))

    def __repr__(self) -> str:
        return f"<shared {self._target!r}>"


def shared(target: T, requests: RequestQueue) -> T:
    """An object as threads see it that do not own the state."""
    return cast("T", _SharedObject(target, requests))
