"""Changes of several physical parameters at once, or of none."""

from __future__ import annotations

from collections.abc import Mapping

from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.errors import Error, SimulationError
from gazelle.simulation.inputs import VECTORS, chosen, numbers
from gazelle.simulation.running_state import RunningState

_LIMITS = ("joint_lower", "joint_upper")


def set_parameters(
    simulation: RunningState,
    name: str,
    parameters: Mapping[str, ArrayLike | None],
    worlds: Worlds | None,
) -> None:
    """Set several parameters, or none of them if one is invalid."""
    engine = simulation.engine
    some = chosen(worlds, simulation.nworld)
    changes = {kind: values for kind, values in parameters.items() if values is not None}

    before: dict[str, Floats] = {}
    try:
        for kind, values in changes.items():
            old = engine.parameter(kind, name, some)
            what, alike = f"the {kind} of '{name}'", kind not in VECTORS
            rows = numbers(what, values, old.shape[1], len(old), alike=alike)
            engine.set_parameter(kind, name, rows, some)
            before[kind] = old
        if not before.keys().isdisjoint(_LIMITS):
            _check_limits(simulation, name, some)
    except Error:
        for kind, old in before.items():
            engine.set_parameter(kind, name, old, some)
        raise


def _check_limits(simulation: RunningState, joint: str, worlds: Worlds | None) -> None:
    lower, upper = (simulation.engine.parameter(kind, joint, worlds) for kind in _LIMITS)
    if (lower > upper).any():
        low, high = lower[lower > upper][0], upper[lower > upper][0]
        raise SimulationError(
            f"the lower limit of joint '{joint}' would be {low:g}, above the upper one, {high:g}"
        )
