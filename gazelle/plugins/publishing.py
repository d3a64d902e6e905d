"""Plugins that only publish, and need no updates without subscribers."""

from __future__ import annotations

from gazelle.simulation import BasePlugin, ModelPlugin, PublisherSystem
from gazelle.simulation.plugin_system import Published


class PublishingPlugin(BasePlugin):
    """Publisher of its outputs at its rate."""

    system = PublisherSystem

    def __init__(self) -> None:
        self.published: list[Published] = []


class Publishing(PublishingPlugin, ModelPlugin):
    """Publisher of a model."""
