"""Mappings by name: with a hint for unknown names, and with items that are made on demand."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping
from typing import Any, Generic, TypeVar

from gazelle.errors import UnknownNameError, did_you_mean

T = TypeVar("T")


class Named(Mapping[str, T]):
    """A mapping with helpful errors for missing keys.

    Args:
        kind: Kind of the items.
        items: By name.
        scope: Name of the model that has them; may stand before theirs, with ``::`` between them,
            as in Gazebo.
    """

    def __init__(self, kind: str, items: Mapping[str, T], scope: str = "") -> None:
        self._kind = kind
        self._items = items
        self._scope = f"{scope}::" if scope else ""
        self._place = f" in '{scope}'" if scope else ""

    def __getitem__(self, name: str) -> T:
        try:
            return self._items[name]
        except KeyError:
            own = self._own(name)
            if own in self._items:
                return self._items[own]
            raise UnknownNameError(
                f"there is no {self._kind} '{name}'{self._place}",
                hint=did_you_mean(name, self._items),
            ) from None

    def get(self, name: str, default: Any = None) -> Any:
        """Return the item of a name, or the default."""
        return self._items.get(self._own(name), default)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self._own(name) in self._items

    def __repr__(self) -> str:
        return f"<{self._kind}s{self._place}: {', '.join(self._items) or 'none'}>"

    def _own(self, name: str) -> str:
        return name if name in self._items else name.removeprefix(self._scope)

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)


class LazyItems(MutableMapping[str, T], Generic[T]):
    """Items by name; some are made at first access.

    Args:
        make: Makes and returns an item that was put off, by its name.
    """

    def __init__(self, make: Callable[[str], T]) -> None:
        self._make = make
        self._items: dict[str, T | None] = {}

    def register_lazily(self, name: str) -> None:
        """Register an item to be made later."""
        self._items[name] = None

    def made(self) -> list[T]:
        """Return all items made so far."""
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
