"""Common base of the panels of a graph."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from gazelle.viewer.graph.context import GraphContext

_PATIENCE_S = 5.0  # of a call of a service


class GraphPanel(ABC):
    """A part of the page that is opened and closed; it costs nothing while it is closed.

    All methods are called by the thread of the page, one after the other.

    Args:
        context: Of the page.

    Attributes:
        title: On the page.
        period: Time between two calls of ``refresh`` [s].
        inputs: Controls whose values a saved layout keeps, by name.
    """

    title: ClassVar[str]
    period: ClassVar[float] = 1.0

    def __init__(self, context: GraphContext) -> None:
        self.context = context
        self.inputs: dict[str, Any] = {}

    @abstractmethod
    def build(self) -> None:
        """Add the controls; called once, within the panel's place on the page."""

    @abstractmethod
    def refresh(self) -> None:
        """Show new values; called within the panel's place on the page."""

    def pause(self) -> None:  # noqa: B027  most panels need none
        """Leave the graph alone while no page is open."""

    def close(self) -> None:  # noqa: B027  most panels need none
        """Leave the graph."""

    def call(self, service: str, definition: Any, **fields: Any) -> Any:
        """Call a service of the graph; returns the response.

        Raises:
            Error: There is no such service, or the call failed.
        """
        client = self.context.node.client(service, definition)
        try:
            return client.call(definition._request_class(**fields), timeout=_PATIENCE_S)
        finally:
            client.close()

    def use(self, arguments: Sequence[str]) -> None:  # noqa: B027  most panels need none
        """Follow the command line of the rqt program that the panel stands for."""

    @property
    def settings(self) -> dict[str, Any]:
        """Values for a saved layout."""
        return {name: control.value for name, control in self.inputs.items()}

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Take the values of a saved layout, as far as they are there."""
        for name, control in self.inputs.items():
            value = settings.get(name)
            if type(value) is type(control.value):
                control.value = value
