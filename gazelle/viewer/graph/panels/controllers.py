"""Controllers of a controller manager, as rqt_controller_manager shows them."""

from __future__ import annotations

from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.panels.markup import table
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.msgs import controller_manager_msgs

_NONE = "choose ..."
_LIST = "/list_controllers"
_STRICT = 2
_COLORS = {"running": "#2f9e44", "stopped": "", "initialized": ""}


class ControllersPanel(GraphPanel):
    """Lists controllers, and starts, stops, loads and unloads them."""

    title = "Controller manager"

    def build(self) -> None:
        """Add the choices, the table and the buttons."""
        gui, context = self.context.gui, self.context
        self._manager: Any = gui.add_dropdown("Manager", (_NONE,))
        self._table: Any = gui.add_html("")
        self._chosen: Any = gui.add_dropdown("Controller", (_NONE,))
        buttons = gui.add_button_group("Change", ("Start", "Stop", "Load", "Unload"))
        buttons.on_click(lambda event: context.guarded(lambda: self._change(event.target.value)))
        self.inputs = {}

    def refresh(self) -> None:
        """Update managers and controllers."""
        services = self.context.node.master.system_state()[2]
        managers = sorted(name.removesuffix(_LIST) for name in services if name.endswith(_LIST))
        if tuple(self._manager.options) != (*managers, _NONE):
            self._manager.options = (*managers, _NONE)
            if self._manager.value == _NONE and managers:
                self._manager.value = managers[0]
        if self._manager.value == _NONE:
            self._table.content = ""
            return
        found = self._call("list_controllers", "ListControllers").controller
        rows = [
            (
                (each.name, each.state, each.type, ", ".join(
                    name for claim in each.claimed_resources for name in claim.resources
                )),
                _COLORS.get(each.state, "#d9822b"),
            )
            for each in found
        ]  # fmt: skip
        head = ("Controller", "State", "Type", "Claims")
        self._table.content = table(head, rows, ("Type", "Claims"))
        options = (_NONE, *self._names([each.name for each in found]))
        if tuple(self._chosen.options) != options:
            self._chosen.options = options

    def _names(self, loaded: list[str]) -> list[str]:
        """Return loaded controllers, and those that parameters describe."""
        space = self._manager.value.rpartition("/")[0]
        described = [
            name.removeprefix(f"{space}/").removesuffix("/type")
            for name in self.context.node.param_names()
            if name.startswith(f"{space}/") and name.endswith("/type")
        ]
        return list(dict.fromkeys([*loaded, *(name for name in described if "/" not in name)]))

    def _change(self, button: str) -> None:
        """Start, stop, load or unload the chosen controller.

        Raises:
            Error: The manager refused it.
        """
        name = self._chosen.value
        if name == _NONE:
            raise Error("no controller is chosen")
        if button in {"Start", "Stop"}:
            answer = self._call(
                "switch_controller", "SwitchController", strictness=_STRICT,
                start_controllers=[name] if button == "Start" else [],
                stop_controllers=[name] if button == "Stop" else [],
            )  # fmt: skip
        else:
            service = f"{button.lower()}_controller"
            answer = self._call(service, f"{button}Controller", name=name)
        if not answer.ok:
            raise Error(f"{self._manager.value} did not {button.lower()} {name}")

    def _call(self, service: str, kind: str, **fields: Any) -> Any:
        definition = getattr(controller_manager_msgs.srv, kind)
        return self.call(f"{self._manager.value}/{service}", definition, **fields)
