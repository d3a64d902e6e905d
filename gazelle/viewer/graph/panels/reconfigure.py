"""Parameters of nodes that can be changed while they run, as rqt_reconfigure shows them."""

from __future__ import annotations

import ast
import math
import threading
from collections.abc import Sequence
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.compat.dynamic_reconfigure.encoding import (
    decode_config,
    decode_description,
    encode_config,
    extract_params,
)
from gazelle_ros.msgs import dynamic_reconfigure

_NONE = "choose ..."
_DESCRIPTIONS = "/parameter_descriptions"
_TYPES = {"bool": bool, "int": int, "str": str, "double": float}
_WIDE = 1e6  # ranges beyond it have no slider


class ReconfigurePanel(GraphPanel):
    """Controls for the parameters of one dynamic_reconfigure server.

    Args:
        context: Of the page.
    """

    title = "Reconfigure"
    period = 0.5

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._lock = threading.Lock()
        self._description: Any = None
        self._values: dict[str, Any] = {}
        self._subscribers: list[Any] = []
        self._controls: dict[str, Any] = {}
        self._kinds: dict[str, type] = {}
        self._server, self._wanted = "", ""

    def build(self) -> None:
        """Add the choice of the node."""
        gui = self.context.gui
        self._node: Any = gui.add_dropdown("Node", (_NONE,))
        self._folder: Any = gui.add_folder("Parameters", visible=False)

    def use(self, arguments: Sequence[str]) -> None:
        """Open the node that the command line names."""
        self._wanted = next((word for word in arguments if not word.startswith("-")), "")

    def refresh(self) -> None:
        """List the servers, and show their values."""
        types = dict(self.context.node.master.topic_types())
        kind = "dynamic_reconfigure/ConfigDescription"
        servers = sorted(
            topic.removesuffix(_DESCRIPTIONS) for topic, each in types.items() if each == kind
        )
        if tuple(self._node.options) != (_NONE, *servers):
            self._node.options = (_NONE, *servers)
        if self._wanted in servers:
            self._node.value, self._wanted = self._wanted, ""
        if self._node.value != self._server:
            self._follow(self._node.value)
        with self._lock:
            described, self._description = self._description, None
            values, self._values = self._values, {}
        if described is not None:
            self._build(extract_params(decode_description(described)))
            values = {**decode_config(described.dflt), **values}
        for name, value in values.items():
            control = self._controls.get(name)
            if control is not None and control.value != value:
                control.value = value

    def close(self) -> None:
        """Leave the node."""
        self._follow("")

    def _follow(self, server: str) -> None:
        """Subscribe to another server."""
        for each in self._subscribers:
            each.close()
        for control in self._controls.values():
            control.remove()
        self._controls, self._subscribers, self._server = {}, [], server
        self._folder.visible = bool(server) and server != _NONE
        if not self._folder.visible:
            return
        subscribe, messages = self.context.node.subscribe, dynamic_reconfigure.msg
        self._subscribers = [
            subscribe(f"{server}{_DESCRIPTIONS}", messages.ConfigDescription, self._describe, 2),
            subscribe(f"{server}/parameter_updates", messages.Config, self._update, 10),
        ]

    def _describe(self, message: Any) -> None:
        with self._lock:
            self._description = message

    def _update(self, message: Any) -> None:
        with self._lock:
            self._values |= decode_config(message)

    def _build(self, parameters: Sequence[dict[str, Any]]) -> None:
        """Add a control for each parameter."""
        for control in self._controls.values():
            control.remove()
        self._controls = {}
        with self._folder:
            for each in parameters:
                self._controls[each["name"]] = control = self._control(each)
                self._kinds[each["name"]] = _TYPES.get(each["type"], str)
                self.context.on_user_change(control, self._sender(each["name"]))

    def _control(self, parameter: dict[str, Any]) -> Any:
        gui, name = self.context.gui, parameter["name"]
        kind, value = parameter["type"], parameter["default"]
        hint = parameter["description"] or None
        least, most = parameter["min"], parameter["max"]
        choices = choices_of(parameter["edit_method"])
        if kind == "bool":
            return gui.add_checkbox(name, bool(value), hint=hint)
        if kind == "str":
            return gui.add_text(name, str(value), hint=hint)
        if choices:
            hint = "; ".join(f"{each}: {word}" for word, each in choices.items())
        if kind == "int":
            return gui.add_number(name, int(value), min=least, max=most, step=1, hint=hint)
        value, bounded = float(value), math.isfinite(least) and math.isfinite(most)
        if bounded and 0.0 < most - least < _WIDE and least <= value <= most:
            step = 10.0 ** math.floor(math.log10((most - least) / 500.0))
            return gui.add_slider(name, least, most, step, value, hint=hint)
        return gui.add_number(name, value, step=0.001, hint=hint)

    def _sender(self, name: str) -> Any:
        def send() -> None:
            kind = dynamic_reconfigure.srv.Reconfigure
            client = self.context.node.client(f"{self._server}/set_parameters", kind)
            try:
                value = self._kinds[name](self._controls[name].value)
                client.call(kind._request_class(config=encode_config({name: value})))
            except Error as error:
                raise Error(f"{self._server} did not change {name}: {error}") from error
            finally:
                client.close()

        return send


def choices_of(edit_method: str) -> dict[str, Any]:
    """Return the values of an enumeration by name; empty for other parameters."""
    try:
        found = ast.literal_eval(edit_method) if edit_method else {}
        return {each["name"]: each["value"] for each in found["enum"]} if found else {}
    except (ValueError, SyntaxError, KeyError, TypeError):
        return {}
