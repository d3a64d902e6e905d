"""Groups of joints that are planned for together, as an SRDF names them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats, Indices
from gazelle.description import EndEffector
from gazelle.errors import PlanningError, did_you_mean
from gazelle.kinematics.limits import MAX_SAMPLES
from gazelle.kinematics.variables import Variable

SAMPLED_SPAN = math.pi
"""Range about zero in which variables without limits are sampled [m or rad]."""


@checked(PlanningError, most=math.inf)
@dataclass(frozen=True, slots=True)
class JointModelGroup:
    """Variables that are planned for together: those that a motor moves, and that mimic no other.

    Attributes:
        name: Its name.
        variables: In the order of the robot's.
        columns: Of the variables among the robot's, shape (n,).
        lower: Limits [m or rad], shape (n,).
        upper: Likewise.
        links: Links of its joints, tips of chains among them, from the root outwards.
        tips: Ends of its chains: the links that are moved to poses. One for an arm.
        base: Base of its one chain; empty where there is none or several.
        effectors: End effectors that are mounted on it.
        states: Named postures, values by name of variable.

    Raises:
        PlanningError: There are more or fewer columns or limits than variables.
    """

    name: str
    variables: tuple[Variable, ...]
    columns: Indices
    lower: Floats
    upper: Floats
    links: tuple[str, ...]
    tips: tuple[str, ...]
    base: str
    effectors: tuple[EndEffector, ...]
    states: Mapping[str, Mapping[str, float]]

    def __post_init__(self) -> None:
        shape = (len(self.variables),)
        for name in ("columns", "lower", "upper"):
            found = getattr(self, name).shape
            if found != shape:
                raise PlanningError(
                    f"the group '{self.name}' has {len(self.variables)} variables, and its {name} "
                    f"the shape {found}"
                )

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables."""
        return tuple(variable.name for variable in self.variables)

    @property
    def tip(self) -> str:
        """Link that poses refer to: the mount of the end effector, else the end of the one chain.

        Raises:
            PlanningError: There is none, or there are several.
        """
        mounts = {each.parent_link for each in self.effectors}
        for ends in (mounts, set(self.tips)):
            if len(ends) == 1:
                return next(iter(ends))
        raise PlanningError(
            f"the group '{self.name}' has {len(self.tips)} ends, not one",
            hint="name the link: " + ", ".join(self.tips) if self.tips else None,
        )

    @property
    def endless(self) -> Bools:
        """Mask of variables that turn without limits, shape (n,)."""
        return np.array([variable.endless for variable in self.variables], bool)

    @property
    def max_velocity(self) -> Floats:
        """Max velocity [m/s or rad/s], infinite by default, shape (n,)."""
        return np.array([variable.bounds.velocity for variable in self.variables])

    @property
    def max_acceleration(self) -> Floats:
        """Max acceleration [m/s² or rad/s²], infinite by default, shape (n,)."""
        return np.array([variable.bounds.acceleration for variable in self.variables])

    def named(self, state: str) -> Mapping[str, float]:
        """Return a named posture: values by name of variable.

        Raises:
            PlanningError: There is none of that name.
        """
        if state not in self.states:
            raise PlanningError(
                f"the group '{self.name}' has no state '{state}'",
                hint=did_you_mean(state, self.states),
            )
        return self.states[state]

    def sample(self, random: np.random.Generator, count: int) -> Floats:
        """Return positions sampled uniformly between the limits, shape (count, n)."""
        if not 0 <= count <= MAX_SAMPLES:
            raise PlanningError(f"draw 0 to {MAX_SAMPLES} positions at once, not {count}")
        low = np.where(np.isfinite(self.lower), self.lower, -SAMPLED_SPAN)
        high = np.where(np.isfinite(self.upper), self.upper, SAMPLED_SPAN)
        return random.uniform(low, high, (count, len(low)))

    def difference(self, first: ArrayLike, second: ArrayLike) -> Floats:
        """Return the differences to the second positions; continuous joints the shorter way round.

        Args:
            first: Shape (..., n).
            second: Likewise.
        """
        way: Floats = np.asarray(second, np.float64) - np.asarray(first, np.float64)
        turned = np.remainder(way + math.pi, 2.0 * math.pi) - math.pi
        return np.where(self.endless, turned, way)

    def distance(self, first: ArrayLike, second: ArrayLike) -> Floats:
        """Return lengths of the differences, all variables alike [m and rad], shape (...)."""
        length: Floats = np.linalg.norm(self.difference(first, second), axis=-1)
        return length

    def beyond(self, positions: ArrayLike, slack: float = 1e-9) -> list[str]:
        """Return the limits that positions, shape (n,), exceed by more than ``slack``: a text each."""
        found = []
        for variable, value in zip(self.variables, np.asarray(positions).tolist(), strict=True):
            low, high = variable.bounds.lower, variable.bounds.upper
            if not low - slack <= value <= high + slack:
                found.append(
                    f"joint '{variable.name}' at {value:.4f} is beyond its limits "
                    f"[{low:.4f}, {high:.4f}]"
                )
        return found

    def positions(self, targets: Mapping[str, float] | ArrayLike, start: ArrayLike) -> Floats:
        """Return positions of all variables, from a mapping or a whole sequence.

        Args:
            targets: By name, the others staying as in ``start``; or shape (n,).
            start: Shape (n,).

        Raises:
            PlanningError: A name is not of this group, or there are more or fewer than n values,
                or one is not finite.
        """
        made = np.array(start, np.float64)
        if isinstance(targets, Mapping):
            for name, value in targets.items():
                if name not in self.names:
                    raise PlanningError(
                        f"the group '{self.name}' has no joint '{name}'",
                        hint=did_you_mean(str(name), self.names),
                    )
                made[self.names.index(name)] = value
        else:
            values = np.asarray(targets, np.float64)
            if values.shape != made.shape:
                raise PlanningError(
                    f"the group '{self.name}' has {len(made)} joints, not the shape {values.shape}",
                    hint="in this order: " + ", ".join(self.names),
                )
            made = values.copy()
        if not np.isfinite(made).all():
            raise PlanningError(f"positions of the group '{self.name}' are not finite numbers")
        return made

    def __repr__(self) -> str:
        return f"<JointModelGroup '{self.name}': {', '.join(self.names)}>"


def ends_of(links: Sequence[str], parents: Mapping[str, str]) -> tuple[str, ...]:
    """Return those of some links that are no parents of others of them, in their order."""
    inner = {parents.get(link, "") for link in links}
    return tuple(link for link in links if link not in inner)
