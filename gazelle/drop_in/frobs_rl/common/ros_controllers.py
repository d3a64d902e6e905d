"""Load, switch and reset controllers; each helper returns whether it succeeded."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.drop_in.frobs_rl.common.connection import controllers, reporting

_STRICT = 2


@reporting
def load_controller_srv(controller_name: str, ns: str | None = None, max_retries: int = 5) -> None:
    """Load a controller with parameters on the server; a loaded one stays."""
    load_missing([controller_name], ns, max_retries)


def load_controller_list_srv(
    controller_list: Sequence[str], ns: str | None = None, max_retries: int = 5
) -> None:
    """Load controllers."""
    for name in controller_list:
        load_controller_srv(name, ns, max_retries)


@reporting
def unload_controller_srv(
    controller_name: str, ns: str | None = None, max_retries: int = 5
) -> None:
    """Unload a controller that does not run."""
    with controllers(ns, max_retries) as manager:
        manager.unload(controller_name)


def unload_controller_list_srv(
    controller_list: Sequence[str], ns: str | None = None, max_retries: int = 5
) -> None:
    """Unload controllers that do not run."""
    for name in controller_list:
        unload_controller_srv(name, ns, max_retries)


@reporting
def switch_controllers_srv(
    start_controllers: Sequence[str],
    stop_controllers: Sequence[str],
    ns: str | None = None,
    strictness: int = 1,
    start_asap: bool = False,  # noqa: FBT001, FBT002  # frobs_rl's interface
    timeout: float = 3.0,
    max_retries: int = 5,
) -> None:
    """Start some controllers and stop others at one moment.

    Args:
        start_controllers: Those to start.
        stop_controllers: Those to stop.
        ns: Namespace of the robot.
        strictness: 1 to do what can be done, 2 for all or nothing.
        start_asap: Start each once its joints are ready.
        timeout: Longest wait of the manager for the robot [s].
        max_retries: Number of retries of an interrupted call.
    """
    with controllers(ns, max_retries) as manager:
        manager.switch(
            start_controllers,
            stop_controllers,
            strict=strictness == _STRICT,
            start_asap=start_asap,
            timeout=timeout,
        )


def start_controllers_srv(
    start_controllers: Sequence[str],
    ns: str | None = None,
    strictness: int = 1,
    start_asap: bool = False,  # noqa: FBT001, FBT002
    timeout: float = 3.0,
) -> bool:
    """Start controllers that are loaded."""
    return switch_controllers_srv(start_controllers, [], ns, strictness, start_asap, timeout)


def stop_controllers_srv(
    stop_controllers: Sequence[str],
    ns: str | None = None,
    strictness: int = 1,
    start_asap: bool = False,  # noqa: FBT001, FBT002
    timeout: float = 3.0,
) -> bool:
    """Stop controllers."""
    return switch_controllers_srv([], stop_controllers, ns, strictness, start_asap, timeout)


def reset_controllers_srv(
    reset_controllers: Sequence[str],
    max_retries: int = 10,
    ns: str | None = None,
    strictness: int = 1,
    start_asap: bool = False,  # noqa: FBT001, FBT002
    timeout: float = 3.0,
) -> bool:
    """Stop controllers and start them again."""
    rest = (ns, strictness, start_asap, timeout, max_retries)
    stopped = switch_controllers_srv([], reset_controllers, *rest)
    return stopped and switch_controllers_srv(reset_controllers, [], *rest)


def spawn_controllers_srv(
    spawn_controllers: Sequence[str],
    ns: str | None = None,
    strictness: int = 1,
    start_asap: bool = False,  # noqa: FBT001, FBT002
    timeout: float = 3.0,
) -> bool:
    """Load controllers and start them."""
    load_controller_list_srv(spawn_controllers, ns)
    return start_controllers_srv(spawn_controllers, ns, strictness, start_asap, timeout)


def kill_controllers_srv(
    kill_controllers: Sequence[str],
    ns: str | None = None,
    strictness: int = 1,
    start_asap: bool = False,  # noqa: FBT001, FBT002
    timeout: float = 3.0,
) -> bool:
    """Stop controllers and unload them."""
    if not stop_controllers_srv(kill_controllers, ns, strictness, start_asap, timeout):
        return False
    unloaded = [unload_controller_srv(name, ns) for name in kill_controllers]
    return all(unloaded)


def load_missing(names: Sequence[str], ns: str | None, retries: int) -> None:
    """Load those that are not loaded yet.

    Raises:
        ClientError: One cannot be.
    """
    with controllers(ns, retries) as manager:
        known = manager.states()
        manager.load([name for name in names if name not in known])
