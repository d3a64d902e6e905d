"""Service caller: requests from YAML, as rqt_service_caller sends them."""

from __future__ import annotations

from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.markup import preformatted
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros import load_service
from gazelle_ros.base import bounded_yaml
from gazelle_ros.messages.yaml import to_yaml
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.services import ServiceCaller, service_type

_NONE = "choose ..."


class ServiceCallerPanel(GraphPanel):
    """Calls one service of the graph.

    Args:
        context: Of the page.
    """

    title = "Service caller"
    period = 2.0

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._graph = GraphInspector("gazelle_view", context.node.master_uri)

    def build(self) -> None:
        """Add service, request and response."""
        gui, context = self.context.gui, self.context
        self._part: Any = gui.add_text("Filter", "", hint="Part of the service's name")
        self._service: Any = gui.add_dropdown("Service", (_NONE,))
        self._kind: Any = gui.add_markdown("")
        self._request: Any = gui.add_text("Request", "", multiline=True, hint="YAML")
        context.on_user_click(gui.add_button("Call"), self._call)
        self._response: Any = gui.add_html("")
        context.on_user_change(self._service, self._fill)
        self.inputs = {"filter": self._part}

    def refresh(self) -> None:
        """Update the list of services."""
        part, chosen = self._part.value, self._service.value
        names = sorted(name for name, _ in self._graph.services() if part in name or name == chosen)
        options = (_NONE, *names)
        if tuple(self._service.options) != options:
            self._service.options = options

    def close(self) -> None:
        """Leave the master."""
        self._graph.close()

    def _fill(self) -> None:
        """Fill in a request of zeros."""
        name = self._service.value
        self._response.content = ""
        if name == _NONE:
            self._kind.content = self._request.value = ""
            return
        kind = service_type(self._graph, name)
        self._kind.content = kind
        self._request.value = to_yaml(load_service(kind)._request_class())

    def _call(self) -> None:
        if self._service.value == _NONE:
            return
        caller = ServiceCaller(self._graph, self.context.node, self._service.value)
        value = bounded_yaml.safe_load(self._request.value) if self._request.value.strip() else None
        self._response.content = preformatted("calling ...")
        try:
            response = caller.call(caller.request([] if value is None else [value]))
        except Exception:
            self._response.content = ""
            raise
        self._response.content = preformatted(to_yaml(response) or "(empty response)")
