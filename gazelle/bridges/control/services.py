"""The services of a controller manager."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.bridges.control.description import find_model
from gazelle.control import (
    BASE_CLASS,
    ControllerManager,
    LoadedController,
    Switch,
    cpp_name,
)
from gazelle.errors import ControlError
from gazelle_ros import Node, load_service
from gazelle_ros.msgs import controller_manager_msgs

LOG = logging.getLogger("gazelle.control")
_LOOK_S = 0.005
_GRACE_S = 1.0
"""Wait for a switch beyond its time-out, in wall time."""


class ManagerServices:
    """Loads, unloads, switches and lists controllers, one call at a time, also while nothing steps.

    Args:
        node: Serves.
        space: Namespace of the manager, without a slash at its end.
        manager: Does it.

    Raises:
        RosError: The node has such services already.
    """

    def __init__(self, node: Node, space: str, manager: ControllerManager) -> None:
        self._node, self._space, self._manager = node, space, manager
        self._one = threading.Lock()
        self._servers = []
        for name, kind, act in (
            ("list_controllers", "ListControllers", self._list),
            ("list_controller_types", "ListControllerTypes", self._list_types),
            ("load_controller", "LoadController", self._load),
            ("unload_controller", "UnloadController", self._unload),
            ("switch_controller", "SwitchController", self._switch),
            ("reload_controller_libraries", "ReloadControllerLibraries", self._reload),
        ):
            service = load_service(f"controller_manager_msgs/{kind}")
            full = f"{space}/controller_manager/{name}"
            self._servers.append(node.serve(full, service, self._alone(act)))

    def close(self) -> None:
        """Serve no more."""
        for server in self._servers:
            server.close()

    def _alone(self, act: Callable[[Any], Mapping[str, Any]]) -> Callable[[Any], Mapping[str, Any]]:
        def handle(request: Any) -> Mapping[str, Any]:
            with self._one:
                return act(request)

        return handle

    def _list(self, _request: controller_manager_msgs.srv.ListControllersRequest) -> dict[str, Any]:
        return {"controller": [_state_of(entry) for entry in self._manager.loaded]}

    def _list_types(
        self, _request: controller_manager_msgs.srv.ListControllerTypesRequest
    ) -> dict[str, Any]:
        types = self._manager.types()
        return {"types": types, "base_classes": [BASE_CLASS] * len(types)}

    def _load(self, request: controller_manager_msgs.srv.LoadControllerRequest) -> dict[str, Any]:
        name = request.name

        def load() -> None:
            # Queried here, not where the robot steps: the master may be far away.
            found = self._node.get_param(f"{self._space}/{name}", None) if name else None
            if self._manager.model is None:
                self._manager.model = find_model(self._node, self._space)
            self._manager.load(name, found if isinstance(found, dict) else {})

        return {"ok": _done(load)}

    def _unload(
        self, request: controller_manager_msgs.srv.UnloadControllerRequest
    ) -> dict[str, Any]:
        return {"ok": _done(lambda: self._manager.unload(request.name))}

    def _switch(
        self, request: controller_manager_msgs.srv.SwitchControllerRequest
    ) -> dict[str, Any]:
        timeout = float(request.timeout)

        def switch() -> None:
            begun = self._manager.switch(
                request.start_controllers,
                request.stop_controllers,
                request.strictness,
                start_asap=request.start_asap,
                timeout=timeout,
            )
            self._wait(begun, timeout)

        return {"ok": _done(switch)}

    def _wait(self, switch: Switch, timeout: float) -> None:
        """Wait until the robot has switched.

        Raises:
            ControlError: It has not, or not in time.
        """
        deadline = time.monotonic() + timeout + _GRACE_S if timeout > 0.0 else None
        while not switch.done:
            if self._node.closed or (deadline is not None and time.monotonic() > deadline):
                raise ControlError("controller switch took too long; it may still come")
            time.sleep(_LOOK_S)
        if switch.failed:
            raise ControlError(f"the robot did not switch for {', '.join(sorted(switch.failed))}")

    def _reload(
        self, request: controller_manager_msgs.srv.ReloadControllerLibrariesRequest
    ) -> dict[str, Any]:
        done = self._manager.reload(force_kill=bool(request.force_kill))
        if not done:
            LOG.error(
                "Controller manager: Cannot reload controller libraries because there are still "
                "controllers loaded"
            )
        return {"ok": done}


def _done(act: Callable[[], None]) -> bool:
    """Call a function; log the reason if it fails, and return whether it succeeded."""
    try:
        act()
    except ControlError as error:
        LOG.error("%s", error)  # noqa: TRY400  what users did wrong needs no traceback
        return False
    return True


def _state_of(entry: LoadedController) -> controller_manager_msgs.msg.ControllerState:
    """Return a ``ControllerState`` with all interfaces, including those without claims."""
    controller = entry.controller
    claims = dict.fromkeys(controller.interfaces, ()) | controller.claimed
    made = controller_manager_msgs.msg.HardwareInterfaceResources
    return controller_manager_msgs.msg.ControllerState(
        name=controller.name,
        state=entry.state,
        type=controller.type,
        claimed_resources=[
            made(cpp_name(interface), sorted(names)) for interface, names in claims.items()
        ],
    )
