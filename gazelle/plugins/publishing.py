"""What plugins that only publish have in common: they sleep until somebody listens."""

from __future__ import annotations

from typing import Protocol

from gazelle.simulation import BasePlugin, ModelPlugin


class Published(Protocol):
    """What is published at every update: an output, or several that go together."""

    @property
    def wanted(self) -> bool:
        """Whether anybody listens."""

    def publish(self) -> None:
        """Hand a new value to all who listen."""


class PublishingPlugin(BasePlugin):
    """Publishes its outputs at its rate, and needs no updates while nobody listens."""

    only_publishes = True

    def __init__(self) -> None:
        self._published: list[Published] = []

    @property
    def active(self) -> bool:
        """Whether anybody listens."""
        for output in self._published:  # noqa: SIM110  asked at every step, and ``any`` is slow
            if output.wanted:
                return True
        return False

    def on_update(self, time: float) -> None:  # noqa: ARG002  values carry their own stamps
        """Publish."""
        for output in self._published:
            output.publish()


class Publishing(PublishingPlugin, ModelPlugin):
    """A publisher of a model."""
