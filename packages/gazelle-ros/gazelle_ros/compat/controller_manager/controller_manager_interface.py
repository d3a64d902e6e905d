"""Call a controller manager and say what came of it, as ``rosrun controller_manager`` does.

The manager is the one in the namespace of this node: ``controller_manager/load_controller`` and its
like. All functions wait for their service, for ever if need be.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle_ros.base.output import say_line
from gazelle_ros.compat import rospy
from gazelle_ros.messages import load_service

_MANAGER = "controller_manager"
_STRICT = 2
_BEST_EFFORT = 1


def list_controller_types() -> None:
    """Print the types of controllers that can be loaded."""
    for kind in _call("list_controller_types", "ListControllerTypes").types:
        say_line(kind)


def reload_libraries(force_kill: bool, restore: bool = False) -> bool:  # noqa: FBT001, FBT002  # the original's interface
    """Load the code of the controllers again.

    Args:
        force_kill: Stop and unload what is loaded; else there must be nothing.
        restore: Load and start it again afterwards.

    Returns:
        Whether the code was loaded again.
    """
    say_line(f"Restore: {restore}")
    before = _call("list_controllers", "ListControllers").controller if restore else []
    done = _call("reload_controller_libraries", "ReloadControllerLibraries", force_kill=force_kill)
    if done.ok:
        say_line("Successfully reloaded libraries")
    else:
        say_line("Failed to reload libraries. Do you still have controllers loaded?")
    if restore:
        for each in before:
            _call("load_controller", "LoadController", name=each.name)
        running = [each.name for each in before if each.state == "running"]
        _switch(running, (), _BEST_EFFORT)
        say_line("Controllers restored to original state")
    return bool(done.ok)


def list_controllers() -> None:
    """Print name, interfaces and state of what is loaded."""
    loaded = _call("list_controllers", "ListControllers").controller
    if not loaded:
        say_line("No controllers are loaded in mechanism control")
    for each in loaded:
        interfaces = dict.fromkeys(claim.hardware_interface for claim in each.claimed_resources)
        say_line(f"'{each.name}' - '{'+'.join(interfaces)}' ( {each.state} )")


def load_controller(name: str) -> bool:
    """Load a controller whose parameters are on the parameter server; returns whether it is."""
    done = bool(_call("load_controller", "LoadController", name=name).ok)
    say_line(f"Loaded '{name}'" if done else f"Error when loading '{name}'")
    return done


def unload_controller(name: str) -> bool:
    """Unload a controller that does not run; returns whether it is."""
    done = bool(_call("unload_controller", "UnloadController", name=name).ok)
    say_line(f"Unloaded '{name}' successfully" if done else f"Error when unloading '{name}'")
    return done


def start_controller(name: str) -> bool:
    """Start a controller; returns whether it was started."""
    return start_stop_controllers(start_controllers=[name])


def start_controllers(names: Sequence[str]) -> bool:
    """Start controllers, all or none; returns whether they were started."""
    return start_stop_controllers(start_controllers=names)


def stop_controller(name: str) -> bool:
    """Stop a controller; returns whether it was stopped."""
    return start_stop_controllers(stop_controllers=[name])


def stop_controllers(names: Sequence[str]) -> bool:
    """Stop controllers, all or none; returns whether they were stopped."""
    return start_stop_controllers(stop_controllers=names)


def start_stop_controllers(
    start_controllers: Sequence[str] = (), stop_controllers: Sequence[str] = ()
) -> bool:
    """Start some controllers and stop others at once, all or none; returns whether it was done."""
    start, stop = list(start_controllers), list(stop_controllers)
    done = _switch(start, stop, _STRICT)
    if not done:
        say_line(f"Error when starting {start} and stopping {stop}")
    elif start or stop:
        for verb, names in (("Started", start), ("Stopped", stop)):
            if names:
                say_line(f"{verb} {names} successfully")
    return done


def _switch(start: Sequence[str], stop: Sequence[str], strictness: int) -> bool:
    answer = _call(
        "switch_controller",
        "SwitchController",
        start_controllers=list(start),
        stop_controllers=list(stop),
        strictness=strictness,
    )
    return bool(answer.ok)


def _call(name: str, kind: str, /, **fields: Any) -> Any:
    full = f"{_MANAGER}/{name}"
    rospy.wait_for_service(full)
    service = load_service(f"controller_manager_msgs/{kind}")
    return rospy.ServiceProxy(full, service)(service._request_class(**fields))
