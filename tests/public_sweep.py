"""Calls of all that packages export with wrong values.

``python tests/public_sweep.py [ROOM[.NAME] ...]`` prints what ends in another error than Gazelle's, and
what takes NaN for a number.
"""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Iterator
from typing import Any

import public_samples
import wrong_calls
from wrong_calls import Findings
from wrong_values import shown

USED_BY = {"DeployNode": "close", "LiveView": "close", "SceneCamera": "render", "TopView": "render"}
"""Classes whose instances fail only when they are used, each with the method for that."""
SMALL: dict[str, dict[str, Any]] = {
    **{key: {"size": (8, 6)} for key in ("SceneCamera", "TopView", "take_picture", "take_plan")},
    **{key: {"rate": 1.0} for key in ("film", "film_plan")},
}
"""Arguments with which calls take less time."""
CLOSING = {"DeployNode"}
"""Classes whose instances close the node that they get first."""
OF_THE_MACHINE = {"SimulatorProcess", "run_master"}
"""They start programs on the graph of this machine, which may be in use."""
NOT_LOADED = {"GoToGoal"}
"""Plugins, whose methods a simulation calls after ``load``."""


def sweep(package: str, only: str = "") -> Findings:
    """Call what a package exports, or one name of it, and the methods of what its classes make."""
    findings = Findings()
    with wrong_calls.limits():
        good = public_samples.Samples(package)
        for name, call in public_samples.public(package):
            if (only and name != only) or name in OF_THE_MACHINE:
                continue
            good.called = name
            said = inspect.getdoc(call) or ""
            attempts = () if inspect.isabstract(call) else _calls(name, call, good)
            for parameter, value, positional, named in attempts:
                what = f"{name}({parameter}={shown(value)})"
                if name in CLOSING and parameter != "node":
                    positional[0] = good.new_node()
                attempt = functools.partial(_use, name, call, positional, named)
                findings.attempt(what, attempt, said, value)
            made = good.instance(call) if isinstance(call, type) else None
            if made is not None and name not in NOT_LOADED:
                wrong_calls.try_members(name, made, good, findings, _of_owners)
        good.stack.close()
    return findings


def _calls(name: str, call: Any, good: Any) -> Iterator[tuple[str, Any, list[Any], dict[str, Any]]]:
    return wrong_calls.calls(
        functools.partial(call, **SMALL[name]) if name in SMALL else call, good
    )


def _use(name: str, call: Any, positional: list[Any], named: dict[str, Any]) -> Any:
    """Make a call, and use what it makes."""
    made = call(*positional, **SMALL.get(name, {}) | named)
    if name in USED_BY:
        getattr(made, USED_BY[name])()
    return made


HOOKS = {
    "achieved",
    "act",
    "shutdown_requested",
    "compute_reward",
    "decide",
    "draw_goals",
    "join",
    "observe",
    "outcome",
    "reached",
    "scenario",
    "start",
}
"""Methods of tasks and sensors that their owners call with what they checked."""


OF_THE_GRAPH = {"adopt", "answer", "check"}
"""Methods of servers on a graph that get what was read from a connection."""


WAITING = {
    *("go_to", "go_to_joints", "move_c", "move_l", "move_ofsc"),
    *("sleep", "wait", "wait_closed", "wait_for", "wait_for_message", "wait_for_model"),
    *("send_goal_and_wait", "wait_for_action_server_to_start", "wait_for_result"),
    *("wait_for_server", "wait_for_service"),
}
"""Methods of clients that wait for what no graph of a sweep has."""


def _nothing() -> None:
    """Do nothing, as hooks do that a subclass may override."""


def _of_owners(handle: Any, name: str) -> bool:
    member = inspect.getattr_static(type(handle), name)
    code = getattr(inspect.unwrap(member), "__code__", None) if callable(member) else None
    if code is not None and code.co_code == _nothing.__code__.co_code:
        return True
    home = getattr(getattr(member, "__func__", member), "__module__", None)
    inherited = home is not None and not home.startswith("gazelle")
    waits = name in WAITING and (home or "").startswith(("gazelle.clients", "gazelle_ros"))
    served = name in OF_THE_GRAPH and (home or "").startswith("gazelle_ros")
    return served or inherited or name in {"close", "restore"} or name in HOOKS or waits


if __name__ == "__main__":
    for each in sys.argv[1:] or public_samples.PACKAGES:
        print(f"== {each}", flush=True)
        package, _, name = each.partition(".")
        sweep(package, name).show()
