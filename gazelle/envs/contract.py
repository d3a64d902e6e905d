"""Contract of a policy: its observations and actions, independent of the training environment.

A user with a policy elsewhere, on a robot or in another simulator, has to give it the same
numbers in the same order, as often, and do with its actions what the environment did. A task says
all that by a `PolicyContract`; it is kept beside the policy as JSON.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

import gymnasium as gym
import numpy as np

from gazelle.argument_checks import checked
from gazelle.errors import TaskError, did_you_mean

FORMAT = "gazelle-contract-1"

Kind = Literal[
    "scan",
    "goal_heading",
    "goal_distance",
    "nearest_range",
    "nearest_ray",
    "forward_speed",
    "yaw_rate",
    "other",
]
"""Kinds of parts of an observation; ``other`` is known to its task alone."""

_MEANINGS = {
    "achieved_goal": "what is reached now, in the terms of goals",
    "desired_goal": "the goal of the episode",
}
"""Of parts that goal environments have."""


@checked(TaskError, most=math.inf)
@dataclass(frozen=True, slots=True, kw_only=True)
class ObservationPart:
    """Some entries of an observation that stand side by side."""

    name: str
    """Such as ``ranges``."""
    kind: Kind = "other"
    """Kind of the part."""
    start: int = 0
    """Index of the first entry."""
    size: int = 1
    """Number of entries."""
    unit: str = ""
    """``m``, ``rad``, ``m/s``, ``rad/s``; ``1`` for counts; empty if unspecified."""
    low: float | tuple[float, ...] | None = None
    """Lower bound, of each entry where they differ; None where there is none."""
    high: float | tuple[float, ...] | None = None
    """Upper bound, likewise."""
    decimals: int | None = None
    """Rounded to a given number of decimals, as Python's ``round`` does; None where it is not."""
    meaning: str = ""
    """One sentence."""


@checked(TaskError)
@dataclass(frozen=True, slots=True, kw_only=True)
class ScanRule:
    """Conversion of a lidar's ranges to a policy's input."""

    first_angle: float
    """Angle of the first ray from straight ahead, left positive [rad]."""
    last_angle: float
    """Angle of the last one [rad]; the others lie evenly between."""
    no_return: float
    """Value that replaces +inf: nothing was in range [m]."""
    too_near: float
    """Value that replaces -inf: something is nearer than the lidar can measure [m]."""
    failed: float = 0.0
    """Value that replaces NaN: the ray failed [m]."""
    farthest: float = np.inf
    """Longer ranges are cut to this [m]."""
    frame: str = "base_scan"
    """Frame that ranges are measured from; x ahead, z up, as in REP 103."""


@checked(TaskError, most=math.inf)
@dataclass(frozen=True, slots=True, kw_only=True)
class ActionRule:
    """Meaning of actions."""

    kind: Literal["velocity", "other"] = "other"
    """``velocity``: a forward speed and a yaw rate; ``other`` is known to its task alone."""
    type: Literal["discrete", "continuous"] = "continuous"
    """Type of an action: one int or some floats."""
    first: int = 0
    """The number of the first discrete action."""
    low: tuple[float, ...] = ()
    """Least continuous actions."""
    high: tuple[float, ...] = ()
    """Greatest continuous actions."""
    choices: tuple[tuple[float, float], ...] = ()
    """Forward speed [m/s] and yaw rate [rad/s] of each discrete action."""
    at_low: tuple[float, float] | None = None
    """Forward speed [m/s] and yaw rate [rad/s] of the least actions; linear up to `at_high`."""
    at_high: tuple[float, float] | None = None
    """The same of the greatest actions."""
    frame: str = "base_footprint"
    """Frame of the velocities; x ahead, left turns positive, as in REP 103."""
    meaning: str = ""
    """One sentence."""


@checked(TaskError)
@dataclass(frozen=True, slots=True, kw_only=True)
class PolicyContract:
    """Contract of a policy: its observations, its actions and its training."""

    task: str = ""
    """Gymnasium id of the task."""
    control_period: float | None = None
    """Time between two actions [s]; None if unknown."""
    observation: tuple[ObservationPart, ...] = ()
    """The observation, part by part, without gaps."""
    action: ActionRule = ActionRule()
    """Meaning of the action."""
    scan: ScanRule | None = None
    """Conversion of ranges, if the policy observes any."""
    goal_distance: float | None = None
    """Nearer to the goal than this it is reached [m]."""
    collision_range: float | None = None
    """A shorter range counted as a collision [m]."""
    time_limit: float | None = None
    """An episode was cut off after this [s]."""
    frames: dict[str, str] = field(default_factory=dict)
    """Frames of poses and goals."""
    versions: dict[str, str] = field(default_factory=dict)
    """Of the packages that trained it."""
    training: dict[str, Any] = field(default_factory=dict)
    """Algorithm, steps, seed and options of the training."""

    @property
    def size(self) -> int:
        """Entries of an observation."""
        return sum(part.size for part in self.observation)

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for JSON; a missing bound is null."""
        plain: dict[str, Any] = _plain(dataclasses.asdict(self))
        return {"format": FORMAT} | plain

    @classmethod
    def from_dict(cls, values: dict[str, Any]) -> PolicyContract:
        """Return the contract that `to_dict` wrote.

        Raises:
            TaskError: Something in it is missing, unknown or impossible.
        """
        fields = dict(values)
        found = fields.pop("format", None)
        if found != FORMAT:
            raise TaskError(f"the format is {found!r}, expected {FORMAT!r}")
        for number, part in enumerate(fields.get("observation", ())):
            _check_kind(part, number)
        parts = tuple(_made(ObservationPart, part) for part in fields.pop("observation", ()))
        action = _made(ActionRule, fields.pop("action", {}))
        scan = fields.pop("scan", None)
        contract: PolicyContract = _made(
            cls,
            fields
            | {
                "observation": parts,
                "action": action,
                "scan": None if scan is None else _made(ScanRule, _boundless(scan)),
            },
        )
        contract.check()
        return contract

    def check(self) -> None:
        """Check that the parts follow each other without gaps.

        Raises:
            TaskError: They do not.
        """
        place = 0
        for part in self.observation:
            if part.start != place or part.size < 1:
                raise TaskError(
                    f"the part '{part.name}' has entries from {part.start}, {part.size} of them; "
                    f"expected one or more from {place}"
                )
            place += part.size


def generic_contract(
    observations: gym.Space[Any], actions: gym.Space[Any], control_period: float | None
) -> PolicyContract:
    """Return the contract that follows from the spaces alone.

    The parts of a Dict stand in a row, in its order.
    """
    spaces = (
        observations.spaces
        if isinstance(observations, gym.spaces.Dict)
        else {"observation": observations}
    )
    return PolicyContract(
        control_period=control_period,
        observation=in_a_row(*(_part_of(name, space) for name, space in spaces.items())),
        action=action_rule(actions),
    )


def _part_of(name: str, space: gym.Space[Any]) -> ObservationPart:
    part = ObservationPart(name=name, meaning=_MEANINGS.get(name, "known to the task alone"))
    if not isinstance(space, gym.spaces.Box):
        return part
    size = int(np.prod(space.shape))
    return dataclasses.replace(part, size=size, low=_bounds(space.low), high=_bounds(space.high))


def action_rule(space: gym.Space[Any], **values: Any) -> ActionRule:
    """Return the rule of a space of actions; ``values`` are more fields of `ActionRule`."""
    if isinstance(space, gym.spaces.Discrete):
        return ActionRule(type="discrete", first=int(space.start), **values)
    if isinstance(space, gym.spaces.Box):
        low, high = _bounds(space.low), _bounds(space.high)
        return ActionRule(type="continuous", low=low, high=high, **values)
    return ActionRule(**values)


def in_a_row(*parts: ObservationPart) -> tuple[ObservationPart, ...]:
    """Return the parts in sequence, with the ``start`` of each computed."""
    placed, place = [], 0
    for part in parts:
        placed.append(dataclasses.replace(part, start=place))
        place += part.size
    return tuple(placed)


def _bounds(values: Any) -> tuple[float, ...]:
    return tuple(float(value) for value in np.asarray(values).reshape(-1))


def _plain(value: Any) -> Any:
    """Return a value for JSON, in which infinities become null."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


def _boundless(scan: dict[str, Any]) -> dict[str, Any]:
    farthest = scan.get("farthest")
    return {**scan, "farthest": np.inf if farthest is None else farthest}


def _check_kind(part: dict[str, Any], number: int) -> None:
    kind = part.get("kind", "other")
    if kind not in get_args(Kind):
        hint = did_you_mean(str(kind), get_args(Kind))
        raise TaskError(
            f"part {number} of the observation is of an unknown kind '{kind}'", hint=hint
        )


def _made(kind: type[Any], values: dict[str, Any]) -> Any:
    """Return a dataclass of plain values; lists become tuples."""
    known = {each.name for each in dataclasses.fields(kind)}
    for key in values:
        if key not in known:
            raise TaskError(
                f"'{key}' is not part of {kind.__name__}", hint=did_you_mean(key, known)
            )
    try:
        return kind(**{key: _tupled(item) for key, item in values.items()})
    except TypeError as error:
        raise TaskError(f"{kind.__name__}: {error}") from error


def _tupled(value: Any) -> Any:
    return tuple(_tupled(item) for item in value) if isinstance(value, list) else value
