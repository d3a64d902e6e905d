"""Robots by name, each made when somebody first asks for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, MutableMapping
from typing import Generic, TypeVar

T = TypeVar("T")


class MadeOnDemand(MutableMapping[str, T], Generic[T]):
    """Items by name; some are made when they are first asked for.

    Args:
        make: Makes and returns an item that was put off, by its name.
    """

    def __init__(self, make: Callable[[str], T]) -> None:
        self._make = make
        self._items: dict[str, T | None] = {}

    def put_off(self, name: str) -> None:
        """There is an item, to be made later."""
        self._items[name] = None

    def made(self) -> list[T]:
        """All that were made."""
        return [item for item in self._items.values() if item is not None]

    def __getitem__(self, name: str) -> T:
        item = self._items[name]
        return self._make(name) if item is None else item

    def __setitem__(self, name: str, item: T) -> None:
        self._items[name] = item

    def __delitem__(self, name: str) -> None:
        del self._items[name]

    def __contains__(self, name: object) -> bool:
        return name in self._items

    def __iter__(self) -> Iterator[str]:
        return iter(tuple(self._items))

    def __len__(self) -> int:
        return len(self._items)
