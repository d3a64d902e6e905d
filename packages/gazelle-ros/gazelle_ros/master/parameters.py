"""The tree of parameters, and the subscribers of its changes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from gazelle_ros.names import SEPARATOR, canonical, namespace_of

_MISSING = object()
_MOST_FRESH = 10_000


class ParameterTree:
    """Nested dicts, addressed by names like ``/a/b``.

    What was given out never changes, so it need not be copied, however large, and may be read on
    any thread: a change copies the dicts on its way, but for those that it made since the last
    value was given out.
    """

    def __init__(self) -> None:
        self._root: dict[str, Any] = {}
        self._fresh: dict[int, dict[str, Any]] = {}
        """Dicts without other owners, by their identity."""

    def get(self, key: str) -> Any:
        """Return the value of `key`, which is not to be changed; a namespace is a dict.

        Raises:
            KeyError: It is not set.
        """
        value = self._find(key)
        if value is _MISSING:
            raise KeyError(key)
        self._fresh.clear()
        return value

    def has(self, key: str) -> bool:
        """Return True if `key` is set, if only to an empty dict."""
        return self._find(key) is not _MISSING

    def set(self, key: str, value: Any) -> None:
        """Set `key`; a dict replaces the whole namespace, a scalar in the way gives way.

        The value is not to be changed afterwards.

        Raises:
            TypeError: The root is to be something other than a dict.
        """
        parts = _parts(key)
        if not parts:
            if not isinstance(value, dict):
                raise TypeError("cannot set root of parameter tree to non-dictionary")
            self._root = value
            return
        self._writable(parts[:-1])[parts[-1]] = value

    def delete(self, key: str) -> None:
        """Remove `key` and all below it.

        Raises:
            KeyError: It is not set, or it is the root.
        """
        parts = _parts(key)
        if not parts:
            raise KeyError(key)
        place: Any = self._root
        for part in parts[:-1]:
            place = place.get(part) if isinstance(place, dict) else None
        if not isinstance(place, dict) or parts[-1] not in place:
            raise KeyError(key)
        del self._writable(parts[:-1])[parts[-1]]

    def _writable(self, parts: list[str]) -> dict[str, Any]:
        """Return the dict at the end of a path, after copying shared ones on it."""
        place = self._root = self._own(self._root)
        for part in parts:
            inner = place.get(part)
            place[part] = self._own(inner if isinstance(inner, dict) else {})
            place = place[part]
        return place

    def _own(self, tree: dict[str, Any]) -> dict[str, Any]:
        if id(tree) in self._fresh:
            return tree
        if len(self._fresh) >= _MOST_FRESH:
            self._fresh.clear()
        made = dict(tree)
        self._fresh[id(made)] = made
        return made

    def names(self) -> list[str]:
        """Return all keys that hold a value; namespaces and empty dicts are not among them."""
        return list(_leaves(self._root, SEPARATOR))

    def search(self, namespace: str, key: str) -> str | None:
        """Return the name of `key` in the nearest enclosing namespace that has its first part.

        Args:
            namespace: Initial namespace: the name of a node.
            key: Relative or global.

        Raises:
            ValueError: The key is empty or private.
        """
        if not key or key.startswith("~"):
            raise ValueError("invalid key")
        if key.startswith(SEPARATOR):
            return key if self.has(key) else None
        first = _parts(key)[0]
        place = canonical(namespace) + SEPARATOR if namespace != SEPARATOR else SEPARATOR
        while True:
            if self.has(place + first):
                return place + key
            if place == SEPARATOR:
                return None
            place = namespace_of(place)

    def _find(self, key: str) -> Any:
        value: Any = self._root
        for part in _parts(key):
            if not isinstance(value, dict) or part not in value:
                return _MISSING
            value = value[part]
        return value


def changes(
    tree: ParameterTree, subscribed: Iterable[str], key: str, value: Any
) -> Iterator[tuple[str, str, Any]]:
    """Yield the notifications of subscribers after `key` was set to `value` or deleted (`{}`).

    Args:
        tree: After the change.
        subscribed: The keys with subscribers.
        key: Changed key.
        value: New value.

    Yields:
        The subscribed key, the key to report (with a slash at the end), and the value to report.
    """
    changed = key.rstrip(SEPARATOR) + SEPARATOR
    deleted = value == {} and not tree.has(key)
    for watched in subscribed:
        place = watched.rstrip(SEPARATOR) + SEPARATOR
        if changed.startswith(place):
            yield watched, changed, value
        elif place.startswith(changed):
            # The subscriber looks at a part of what changed.
            missing = deleted or not tree.has(place)
            yield watched, place, {} if missing else tree.get(place)


def _parts(key: str) -> list[str]:
    return [part for part in key.split(SEPARATOR) if part]


def _leaves(tree: dict[str, Any], prefix: str) -> Iterator[str]:
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from _leaves(value, prefix + key + SEPARATOR)
        else:
            yield prefix + key
