"""Reasons why a controller manager refuses, from its state: it answers only that it does."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from gazelle.errors import did_you_mean

_LOG = "the log of the robot's node says more (/rosout)"
_SHARED = {
    "hardware_interface::JointStateInterface",
    "hardware_interface::ImuSensorInterface",
    "hardware_interface::ForceTorqueSensorInterface",
}
"""Interfaces that only read, which any number of controllers may use."""


def why_not_loaded(place: str, kind: object, types: Callable[[], Sequence[str]]) -> str:
    """Return the reason why a controller is not loaded.

    Args:
        place: Full name of its parameters.
        kind: Its parameter ``type``; None if there is none.
        types: Returns the available ones.
    """
    if kind is None:
        return f"there is no parameter {place}/type; load its YAML file first"
    known = types()
    if kind not in known:
        package = f"{kind}".partition("/")[0]
        near = [each for each in known if each.startswith(f"{package}/")] or known
        return f"there is no type '{kind}'; {did_you_mean(str(kind), near)}"
    return f"its parameters in {place} do not suit it, or the robot has not what it needs; {_LOG}"


def why_not_unloaded(name: str, states: Mapping[str, str]) -> str:
    """Return the reason why a controller is not unloaded, from the states of all."""
    if name not in states:
        return _unknown(name, states)
    if states[name] == "running":
        return "it runs; stop it first, or kill it"
    return _LOG


def why_not_switched(start: Sequence[str], stop: Sequence[str], loaded: Sequence[Any]) -> str:
    """Return the reason why controllers are not switched.

    It comes from the loaded ones (``ControllerState`` messages).
    """
    states = {each.name: each.state for each in loaded}
    for name in (*start, *stop):
        if name not in states:
            return f"'{name}': {_unknown(name, states)}"
    for name in stop:
        if states[name] != "running":
            return f"'{name}' does not run"
    for name in start:
        if states[name] == "running" and name not in stop:
            return f"'{name}' runs already"
    running = [each for each in states if states[each] == "running" and each not in stop]
    claims = {each.name: _claims(each) for each in loaded}
    for index, name in enumerate(start):
        for other in (*running, *start[:index]):
            shared = claims[name] & claims[other]
            if shared:
                return f"'{name}' and '{other}' both claim '{min(shared)}'"
    return _LOG


def _claims(state: Any) -> set[str]:
    """Return the resources that a controller has to itself while it runs."""
    return {
        name
        for each in state.claimed_resources
        if each.hardware_interface not in _SHARED
        for name in each.resources
    }


def _unknown(name: str, states: Iterable[str]) -> str:
    return f"it is not loaded; {did_you_mean(name, states)}"
