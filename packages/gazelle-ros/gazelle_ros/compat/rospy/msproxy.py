"""The master as rospy shows it: its API, and the parameter server as a dict."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from gazelle_ros.compat.rospy import params
from gazelle_ros.compat.rospy.guest import user
from gazelle_ros.compat.rospy.names import resolve_name

_PLACE = {"subscribeParam": 1, "unsubscribeParam": 1}
_PLACE |= dict.fromkeys(("deleteParam", "setParam", "getParam", "hasParam", "lookupService"), 0)
"""Index of the argument that is a name to resolve."""


class MasterProxy:
    """The master.

    Methods of the master's API are called without the caller's name, and return the triple
    ``[code, text, value]``; names in them are resolved for the node. Parameters are reached as
    items.

    Args:
        uri: Of the master.
    """

    def __init__(self, uri: str) -> None:
        self._uri = uri

    @property
    def target(self) -> MasterProxy:
        """The proxy itself."""
        return self

    def __getattr__(self, method: str) -> Callable[..., Any]:
        if method.startswith("_"):
            raise AttributeError(method)

        def call(*args: Any) -> Any:
            values = list(args)
            place = _PLACE.get(method)
            if place is not None and len(values) > place:
                values[place] = resolve_name(values[place])
            return user().master.call_raw(method, *values)

        return call

    def __getitem__(self, key: str) -> Any:
        return params.get_param(key)

    def __setitem__(self, key: str, value: Any) -> None:
        params.set_param(key, value)

    def __delitem__(self, key: str) -> None:
        params.delete_param(key)

    def __contains__(self, key: str) -> bool:
        return params.has_param(key)

    def __iter__(self) -> Iterator[str]:
        return iter(params.get_param_names())

    def search_param(self, key: str) -> str | None:
        """Return the name of the nearest parameter of this name."""
        return params.search_param(key)

    def get_param_cached(self, key: str) -> Any:
        """Return the value of a parameter, requested only once."""
        return params.get_param_cached(key)
