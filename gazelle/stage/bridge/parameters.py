"""Private parameters of a node that shows a Stage world on the graph."""

from __future__ import annotations

import difflib
import math
import warnings
from dataclasses import dataclass, fields
from typing import Any

from gazelle.errors import RosError, SimulationWarning, did_you_mean
from gazelle_ros import Node

_POSE_TYPES = ("Pose", "Pose2D")


@dataclass(frozen=True, slots=True)
class StageParameters:
    """The parameters, as the docs list them; names are those on the graph.

    Attributes:
        base_watchdog_timeout: Simulated time after which a robot without a command stands [s].
        is_depth_canonical: Whether depths are metres in 32FC1, not millimetres in 16UC1.
        publish_rate: At most so often [Hz of simulated time]; 0 for every step.
        pose_service: Type of ``get_pose``; empty for the usual one where that is known.
        cmd_pose_type: ``Pose`` or ``Pose2D``.
        slashed_frames: Whether frames of several robots begin with ``/``.
        monotonic_clock: Whether the graph's time continues at a reset instead of back to zero.
    """

    base_watchdog_timeout: float = 0.2
    is_depth_canonical: bool = True
    publish_rate: float = 0.0
    pose_service: str = ""
    cmd_pose_type: str = "Pose"
    slashed_frames: bool = False
    monotonic_clock: bool = False

    @property
    def flat_poses(self) -> bool:
        """True if ``cmd_pose`` has the type ``geometry_msgs/Pose2D``."""
        return self.cmd_pose_type == "Pose2D"


def read_parameters(node: Node) -> StageParameters:
    """Read the private parameters of a node.

    stage_ros's own are left at their defaults with a warning where they are of another type,
    as it leaves them without one, and so that launch files written for it continue.

    Raises:
        RosError: One of the others is not what it must be.
    """
    own = f"{node.name}/"
    node_values = {
        name.removeprefix(own): node.get_param(name)
        for name in node.param_names()
        if name.startswith(own)
    }
    values: dict[str, Any] = {}
    for field in fields(StageParameters):
        if field.name not in node_values:
            continue
        value, name = node_values.pop(field.name), own + field.name
        try:
            values[field.name] = _checked(field.name, field.default, value, name)
        except RosError as error:
            if field.name not in {"base_watchdog_timeout", "is_depth_canonical"}:
                raise
            text = f"{error}; {field.default} is taken"
            warnings.warn(text, SimulationWarning, stacklevel=2)
    _warn_of_misspelled(node_values, own)
    return StageParameters(**values)


def _checked(plain: str, default: object, value: Any, name: str) -> Any:
    """Return a value of the type of the default."""
    if isinstance(default, bool):
        if value in (True, False):
            return bool(value)
        raise RosError(f"the parameter {name} must be true or false, not {value!r}")
    if isinstance(default, float):
        whole = isinstance(value, (int, float)) and not isinstance(value, bool)
        least = -math.inf if plain == "base_watchdog_timeout" else 0.0
        if whole and least <= value and (plain != "publish_rate" or value < math.inf):
            return float(value)
        kind = "a number" if least < 0.0 else "a rate [Hz], 0 for every step"
        raise RosError(f"the parameter {name} must be {kind}, not {value!r}")
    if plain != "cmd_pose_type":
        return str(value)
    last = str(value).rpartition("/")[2]
    if last not in _POSE_TYPES:
        raise RosError(
            f"the parameter {name} must be Pose or Pose2D, not {value!r}",
            hint=did_you_mean(last, _POSE_TYPES),
        )
    return last


def _warn_of_misspelled(left: dict[str, Any], own: str) -> None:
    """Warn of unknown names that are similar to known ones."""
    known = [field.name for field in fields(StageParameters)]
    for name in left:
        close = difflib.get_close_matches(name, known, n=1, cutoff=0.8)
        if close:
            text = f"unknown parameter {own}{name}; did you mean '{close[0]}'?"
            warnings.warn(text, SimulationWarning, stacklevel=3)
