"""A node's view of the parameter server, with a cache for parameters it follows."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import Any, Protocol

from gazelle_ros import names
from gazelle_ros.base import bounded_yaml
from gazelle_ros.errors import ApiError, ParameterNotFoundError, RosError, report
from gazelle_ros.loop import EventLoop
from gazelle_ros.master.proxy import MasterProxy

ParameterHook = Callable[[str, Any], None]
"""Called with key and new value, on a worker; ``{}`` means deleted."""
_MISSING: Any = object()


class ParameterNode(Protocol):
    """Interface of a node that `NodeParameters` needs."""

    loop: EventLoop
    master: MasterProxy
    uri: str

    def resolve(self, name: str) -> str:
        """Return the global name of `name` for the node."""


class NodeParameters:
    """Parameters as one node sees them; names are resolved for it."""

    def __init__(self, node: ParameterNode) -> None:
        self._node = node
        self._cache: dict[str, Any] = {}
        self._hooks: dict[str, list[ParameterHook]] = {}
        self._lock = threading.Lock()

    def get(self, name: str, default: Any = _MISSING) -> Any:
        """Return the value of a parameter; a namespace is a dict.

        Raises:
            ParameterNotFoundError: It is not set, and no default was given.
        """
        key = self._node.resolve(name)
        triple = self._node.master.call_raw("getParam", key)
        if triple[0] == 1:
            return triple[2]
        if default is _MISSING:
            raise ParameterNotFoundError(f"the parameter {key} is not set")
        return default

    def get_cached(self, name: str, default: Any = _MISSING) -> Any:
        """Return the same as `get`, with one request to the master and a subscription to changes.

        Raises:
            ParameterNotFoundError: It is not set, and no default was given.
        """
        key = self._node.resolve(name)
        with self._lock:
            known = key in self._cache
        if not known:
            self._follow(key)
        with self._lock:
            value = self._cache.get(key, {})
        if value != {}:
            return copy.deepcopy(value)
        if default is _MISSING:
            raise ParameterNotFoundError(f"the parameter {key} is not set")
        return default

    def subscribe(self, name: str, hook: ParameterHook) -> Any:
        """Call `hook` at every change; returns the value now, ``{}`` if there is none."""
        key = self._node.resolve(name)
        with self._lock:
            self._hooks.setdefault(key, []).append(hook)
        return self._follow(key)

    def set(self, name: str, value: Any) -> None:
        """Set a parameter or, with a dict, a whole namespace.

        Raises:
            MarshalError: XML-RPC cannot represent the value.
        """
        key = self._node.resolve(name)
        self._node.master.set_param(key, value)
        self._apply(key, value)  # the master does not notify the node that did it

    def has(self, name: str) -> bool:
        """Return True if it is set."""
        return self._node.master.has_param(self._node.resolve(name))

    def delete(self, name: str) -> None:
        """Remove a parameter or namespace.

        Raises:
            ParameterNotFoundError: It is not set.
        """
        key = self._node.resolve(name)
        try:
            self._node.master.delete_param(key)
        except ApiError:
            raise ParameterNotFoundError(f"the parameter {key} is not set") from None
        self._apply(key, {})

    def search(self, name: str) -> str | None:
        """Return the name of the nearest parameter of that name, upwards from the namespace."""
        key = self._node.resolve(name) if names.is_private(name) else name
        try:
            return self._node.master.search_param(key) or None
        except ApiError:
            return None

    def names(self) -> list[str]:
        """Return all keys that hold a value."""
        return self._node.master.param_names()

    # Updates by the master ---------------------------------------------------------------

    def update(self, key: str, value: Any) -> bool:
        """Handle a change; False if the parameter is not followed."""
        return self._apply(names.canonical(key), value)

    def followed(self) -> list[str]:
        """Return keys to subscribe to again at a new master."""
        with self._lock:
            return list(self._cache)

    def refresh(self, key: str, value: Any) -> None:
        """Set the value of a new master."""
        with self._lock:
            changed = self._cache.get(key) != value
        if changed:
            self._apply(key, value)

    def _follow(self, key: str) -> Any:
        value = self._node.master.subscribe_param(key, self._node.uri)
        with self._lock:
            self._cache[key] = value
        return copy.deepcopy(value)

    def _apply(self, key: str, value: Any) -> bool:
        """Update the cached values of `key` and of keys above or below it; call the hooks."""
        calls: list[tuple[ParameterHook, str]] = []
        found = False
        with self._lock:
            for watched in self._cache:
                if key == watched or key.startswith(watched.rstrip("/") + "/"):
                    rest = key[len(watched) :].strip("/")
                    self._cache[watched] = _changed(self._cache[watched], rest, value)
                elif watched.startswith(key.rstrip("/") + "/"):
                    self._cache[watched] = _inner(value, watched[len(key) :].strip("/"))
                else:
                    continue
                found = True
                calls += [(hook, watched) for hook in self._hooks.get(watched, ())]
        for hook, watched in calls:
            self._call(hook, watched)
        return found

    def _call(self, hook: ParameterHook, key: str) -> None:
        value = copy.deepcopy(self._cache.get(key, {}))

        def call() -> None:
            try:
                hook(key, value)
            except Exception as error:  # noqa: BLE001  # a hook must not end its thread
                report(f"hook of parameter {key}", error)

        self._node.loop.submit(call)


def _changed(tree: Any, rest: str, value: Any) -> Any:
    """Return `tree` with the value at a path below it replaced."""
    if not rest:
        return copy.deepcopy(value)
    first, _, deeper = rest.partition("/")
    result = dict(tree) if isinstance(tree, dict) else {}
    if not deeper and value == {}:
        result.pop(first, None)
    else:
        result[first] = _changed(result.get(first, {}), deeper, value)
    return result


def _inner(tree: Any, rest: str) -> Any:
    """Return the value at a path below `tree`, ``{}`` if there is none."""
    for part in rest.split("/"):
        if not isinstance(tree, dict) or part not in tree:
            return {}
        tree = tree[part]
    return copy.deepcopy(tree)


def set_private(parameters: NodeParameters, mappings: dict[str, str]) -> None:
    """Set the private parameters of a command line (``_rate:=5``), typed as YAML."""
    import yaml

    for old, new in mappings.items():
        if not old.startswith("_") or old.startswith("__"):
            continue
        try:
            value = bounded_yaml.safe_load(new) if new else ""
        except yaml.YAMLError:
            value = new
        try:
            parameters.set(names.PRIVATE + old[1:], value)
        except RosError as error:
            report(f"private parameter {old}", error)
