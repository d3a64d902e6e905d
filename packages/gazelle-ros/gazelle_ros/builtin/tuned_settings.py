"""Settings of a node that a dynamic_reconfigure server changes while it runs."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Generic, TypeVar

from gazelle_ros.base.tuned_fields import tuned_fields
from gazelle_ros.node import Node
from gazelle_ros.reconfigure import ReconfigureServer, Values

Settings = TypeVar("Settings")


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
        self.tunables = tuned_fields(settings)
        self.settings = settings
        first = {name: each.clamp(getattr(settings, name)) for name, each in self.tunables.items()}
        if first != self.values:
            self.send(**first)
        ReconfigureServer(node, node.resolve(namespace), self)

    @property
    def values(self) -> Values:
        """Current values."""
        return {name: getattr(self.settings, name) for name in self.tunables}

    def send(self, /, **requested: Any) -> Values:
        """Set some values, within their limits; returns the values in effect."""
        with self._lock:
            allowed = {name: self.tunables[name].clamp(value) for name, value in requested.items()}
            settings = replace(self.settings, **allowed)  # type: ignore[type-var]  # a dataclass
            self._change(settings)
            self.settings = settings
            return self.values
