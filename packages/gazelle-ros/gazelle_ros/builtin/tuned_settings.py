"""Settings of a node that a dynamic_reconfigure server changes while it runs."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, Generic, TypeVar

from gazelle_ros.node import Node
from gazelle_ros.reconfigure import ReconfigureServer, Values

Settings = TypeVar("Settings")


def tunable(default: Any, least: Any = "", most: Any = "", description: str = "") -> Any:
    """Return a field of a dataclass that dynamic_reconfigure may change.

    Args:
        default: Its type is that of all values: bool, int, str or float.
        least: Smallest value, of a number.
        most: Largest value, of a number.
        description: For people.
    """
    if isinstance(default, bool):
        least, most = False, True
    return field(default=default, metadata={"tuned": (least, most, description)})


@dataclass(frozen=True, slots=True)
class TunedSetting:
    """A setting that can be changed.

    Attributes:
        name: Of the parameter.
        default: Its type is that of all values.
        least: Smallest value.
        most: Largest value.
        description: For people.
    """

    name: str
    default: Any
    least: Any
    most: Any
    description: str

    def clamp(self, value: Any) -> Any:
        """Return the nearest allowed value."""
        kind = type(self.default)
        return kind(value if kind in (bool, str) else min(max(value, self.least), self.most))


class TunedSettings(Generic[Settings]):
    """A dataclass of settings and its dynamic_reconfigure server.

    Args:
        node: On the graph.
        settings: Initial settings; fields that are `tunable` can be changed.
        change: Called with the settings that are to hold; what it raises refuses them.
        namespace: Of the server.

    Attributes:
        tunables: Parameters that can be changed, by name.
        settings: Current settings.
    """

    def __init__(
        self,
        node: Node,
        settings: Settings,
        change: Callable[[Settings], object],
        namespace: str = "~",
    ) -> None:
        self._change = change
        self._lock = threading.Lock()
        self.tunables: Mapping[str, TunedSetting] = {
            each.name: TunedSetting(each.name, each.default, *each.metadata["tuned"])
            for each in fields(settings)  # type: ignore[arg-type]  # a dataclass
            if "tuned" in each.metadata
        }
        self.settings = settings
        first = {name: each.clamp(getattr(settings, name)) for name, each in self.tunables.items()}
        if first != self.values:
            self.send(**first)
        ReconfigureServer(node, node.resolve(namespace), self)

    @property
    def values(self) -> Values:
        """Current values."""
        return {name: getattr(self.settings, name) for name in self.tunables}

    def send(self, /, **wanted: Any) -> Values:
        """Set some values, within their limits; returns the values in effect."""
        with self._lock:
            allowed = {name: self.tunables[name].clamp(value) for name, value in wanted.items()}
            settings = replace(self.settings, **allowed)  # type: ignore[type-var]  # a dataclass
            self._change(settings)
            self.settings = settings
            return self.values
