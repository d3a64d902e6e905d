"""The services of a ros_control controller manager (http://wiki.ros.org/controller_manager)."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from typing import Any

from gazelle.argument_checks import checked
from gazelle.clients.calls import Caller
from gazelle.clients.errors import ClientError
from gazelle.clients.refusals import why_not_loaded, why_not_switched, why_not_unloaded
from gazelle.errors import did_you_mean
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.deadlines import deadline_after

Names = str | Iterable[str]
"""One name, or several."""

_BEST_EFFORT, _STRICT = 1, 2
_LOOK_S = 0.05


@checked(ClientError, after=True)
class Controllers(Closeable):
    """Loads, starts and stops controllers; their parameters must be on the parameter server.

    Wherever names are taken, one name will do. With ``with`` the connections are closed at the end;
    controllers stay as they are.

    Args:
        node: Calls.
        namespace: Of the robot; the manager is ``<namespace>/controller_manager``.
        timeout: For a service to be there and for it to answer, each [s of wall time].
        retries: Number of retries of an interrupted call.
    """

    def __init__(
        self, node: Node, namespace: str = "/", timeout: float = 30.0, retries: int = 2
    ) -> None:
        self._space = f"/{namespace.strip('/')}".rstrip("/")
        self._caller = Caller(node, f"{self._space}/controller_manager", timeout, retries)

    # -- what there is -------------------------------------------------------------------

    def states(self) -> dict[str, str]:
        """Return the state of each controller: ``initialized``, ``running`` or ``stopped``."""
        return {each.name: each.state for each in self.loaded()}

    def loaded(self) -> Sequence[Any]:
        """Return the ``controller_manager_msgs/ControllerState`` of each loaded controller."""
        answer = self._caller.call("list_controllers", "controller_manager_msgs/ListControllers")
        found: Sequence[Any] = answer.controller
        return found

    def types(self) -> Sequence[str]:
        """Return the types of controllers that can be loaded."""
        kind = "controller_manager_msgs/ListControllerTypes"
        found: Sequence[str] = self._caller.call("list_controller_types", kind).types
        return found

    def wait_for(self, names: Names, state: str = "running", timeout: float = 30.0) -> None:
        """Wait until others, such as a launch file, have brought controllers into a state.

        Raises:
            ClientError: It takes longer than ``timeout`` [s of wall time].
        """
        listed = _several(names)
        deadline = deadline_after(timeout)
        while True:
            found = self.states()
            missing = [name for name in listed if found.get(name) != state]
            if not missing:
                return
            if time.monotonic() > deadline:
                name = missing[0]
                raise ClientError(
                    f"'{name}' is {found.get(name, 'not loaded')}, and not {state}, after "
                    f"{timeout:g} s",
                    hint=did_you_mean(name, found),
                )
            time.sleep(_LOOK_S)

    # -- what is done to them ---------------------------------------------------------------

    def load(self, names: Names) -> None:
        """Load controllers.

        Raises:
            ClientError: One cannot be loaded; those before it are.
        """
        for name in _several(names):
            ok, again = self._call("load_controller", "LoadController", name=name)
            # An answer that got lost: it may be there since.
            if not ok and not (again and name in self.states()):
                raise self._refused("load_controller", name, self._why_not_loaded(name))

    def unload(self, names: Names) -> None:
        """Unload controllers that do not run.

        Raises:
            ClientError: One cannot be unloaded; those before it are.
        """
        for name in _several(names):
            ok, again = self._call("unload_controller", "UnloadController", name=name)
            states = {} if ok else self.states()
            if not ok and not (again and name not in states):
                raise self._refused("unload_controller", name, why_not_unloaded(name, states))

    def switch(
        self,
        start: Names = (),
        stop: Names = (),
        *,
        strict: bool = True,
        start_asap: bool = False,
        timeout: float = 0.0,
    ) -> None:
        """Start some and stop others at one moment.

        Args:
            start: Those to start.
            stop: Those to stop.
            strict: All or nothing; else what cannot be started or stopped is passed over.
            start_asap: Start each as soon as its joints are ready.
            timeout: Longest wait of the manager for the robot [s]; 0 for no limit.

        Raises:
            ClientError: The manager refuses.
        """
        starting, stopping = _several(start), _several(stop)
        ok, _ = self._call(
            "switch_controller",
            "SwitchController",
            start_controllers=starting,
            stop_controllers=stopping,
            strictness=_STRICT if strict else _BEST_EFFORT,
            start_asap=start_asap,
            timeout=timeout,
        )
        if not ok:
            named = ", ".join((*starting, *stopping))
            raise self._refused(
                "switch_controller", named, why_not_switched(starting, stopping, self.loaded())
            )

    def start(self, names: Names, *, strict: bool = True) -> None:
        """Start controllers; all or none, if ``strict``.

        Raises:
            ClientError: As ``switch``.
        """
        self.switch(start=names, strict=strict)

    def stop(self, names: Names, *, strict: bool = True) -> None:
        """Stop controllers; all or none, if ``strict``.

        Raises:
            ClientError: As ``switch``.
        """
        self.switch(stop=names, strict=strict)

    def spawn(self, names: Names, *, stopped: bool = False) -> None:
        """Load controllers and start them; those that are loaded are only started.

        Args:
            names: Of controllers.
            stopped: Load them only.

        Raises:
            ClientError: One is invalid; what this call has loaded is unloaded again.
        """
        requested, before = _several(names), self.states()
        loaded: list[str] = []
        try:
            for name in requested:
                if name not in before:
                    self.load(name)
                    loaded.append(name)
            if not stopped:
                self.switch(start=[name for name in requested if before.get(name) != "running"])
        except ClientError:
            self.unload(reversed(loaded))
            raise

    def kill(self, names: Names) -> None:
        """Stop those that run, and unload all, the last first.

        Raises:
            ClientError: One is invalid; none is unloaded if one does not stop.
        """
        requested, before = _several(names), self.states()
        self.stop([name for name in requested if before.get(name) == "running"])
        self.unload(reversed(requested))

    def reset(self, names: Names) -> None:
        """Stop those that run and start all again.

        Raises:
            ClientError: As ``switch``.
        """
        requested, before = _several(names), self.states()
        self.stop([name for name in requested if before.get(name) == "running"])
        self.start(requested)

    def reload_libraries(self, *, force_kill: bool = False) -> None:
        """Find the types of controllers again.

        Args:
            force_kill: Stop and unload all controllers first.

        Raises:
            ClientError: Controllers are loaded.
        """
        name = "reload_controller_libraries"
        if not self._call(name, "ReloadControllerLibraries", force_kill=force_kill)[0]:
            raise self._refused(name, "", "controllers are loaded; kill them, or force_kill=True")

    def close(self) -> None:
        """Close the connections."""
        self._caller.close()

    # -- calls ------------------------------------------------------------------------------

    def _call(self, name: str, kind: str, /, **fields: object) -> tuple[bool, bool]:
        """Return whether the manager agrees, and whether an earlier try may have been carried out."""
        answer, again = self._caller.call_again(name, f"controller_manager_msgs/{kind}", **fields)
        return bool(answer.ok), again

    def _why_not_loaded(self, name: str) -> str:
        if name in self.states():
            return "it is loaded already"
        place = f"{self._space}/{name}"
        kind = self._caller.node.get_param(f"{place}/type", None)
        return why_not_loaded(place, kind, self.types)

    def _refused(self, service: str, name: str, why: str) -> ClientError:
        whom = f" '{name}'" if name else ""
        return ClientError(f"{self._caller.namespace}/{service} refused{whom}: {why}")


def _several(names: Names) -> list[str]:
    return [names] if isinstance(names, str) else list(names)
