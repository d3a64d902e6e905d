"""Plugins that have nothing to do here, and need no word about it."""

from __future__ import annotations

from typing import Any

from gazelle.simulation import ModelPlugin, SensorPlugin, VisualPlugin, WorldPlugin


class Silent(WorldPlugin, ModelPlugin, SensorPlugin, VisualPlugin):
    """Does nothing: Gazelle does what it is for by itself, or it is a library of others."""

    def load(self, entity: Any, parameters: Any) -> None:
        """Nothing to do, on anything."""
