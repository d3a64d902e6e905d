"""The services of a ros_control controller manager."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.clients.calls import Caller
from gazelle.clients.errors import ClientError
from gazelle.ros import Node

_STRICT = 2


class Controllers:
    """Loads, starts and stops controllers; their parameters must be on the parameter server.

    Args:
        node: Calls.
        namespace: Of the robot; the manager is ``<namespace>/controller_manager``.
        timeout: For services and answers [s of wall time].
    """

    def __init__(self, node: Node, namespace: str = "/", timeout: float = 30.0) -> None:
        space = f"{namespace.rstrip('/')}/controller_manager"
        self._caller = Caller(node, space, timeout, retries=2)

    def states(self) -> dict[str, str]:
        """What each controller does: ``initialized``, ``running`` or ``stopped``."""
        answer = self._caller.call("list_controllers", "controller_manager_msgs/ListControllers")
        return {each.name: each.state for each in answer.controller}

    def load(self, names: Sequence[str]) -> None:
        """Load controllers.

        Raises:
            ClientError: One cannot be loaded.
        """
        for name in names:
            self._demand("load_controller", "LoadController", name=name)

    def unload(self, names: Sequence[str]) -> None:
        """Unload controllers that do not run.

        Raises:
            ClientError: One cannot be unloaded.
        """
        for name in names:
            self._demand("unload_controller", "UnloadController", name=name)

    def switch(self, start: Sequence[str] = (), stop: Sequence[str] = ()) -> None:
        """Start some and stop others at once.

        Raises:
            ClientError: One of them cannot be.
        """
        self._demand(
            "switch_controller",
            "SwitchController",
            start_controllers=list(start),
            stop_controllers=list(stop),
            strictness=_STRICT,
        )

    def spawn(self, names: Sequence[str]) -> None:
        """Load controllers and start them."""
        self.load(names)
        self.switch(start=names)

    def reset(self, names: Sequence[str]) -> None:
        """Stop controllers and start them anew."""
        self.switch(stop=names)
        self.switch(start=names)

    def close(self) -> None:
        """Close the connections."""
        self._caller.close()

    def _demand(self, name: str, kind: str, /, **fields: object) -> None:
        answer = self._caller.call(name, f"controller_manager_msgs/{kind}", **fields)
        if not answer.ok:
            raise ClientError(f"{self._caller.namespace}/{name} refuses: {fields}")
