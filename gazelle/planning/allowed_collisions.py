"""Allowed collision matrix: pairs of links and objects that may touch."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Self

from gazelle.argument_checks import checked
from gazelle.errors import PlanningError
from gazelle.kinematics import RobotModel

Pair = tuple[str, str]


@checked(PlanningError)
class AllowedCollisionMatrix:
    """Pairs that may touch, and names that may touch anything.

    A pair's own entry counts before those of its names; of these a False counts before a True.
    """

    def __init__(self) -> None:
        self._pairs: dict[Pair, bool] = {}
        self._names: dict[str, bool] = {}

    @classmethod
    def of_robot(cls, robot: RobotModel) -> Self:
        """Return the rules of an SRDF; without any pair there, adjacent links may touch."""
        made, semantics = cls(), robot.semantics
        for link in semantics.unchecked_links:
            made.set_default(link, allowed=True)
        for pair in semantics.disabled_collisions:
            made.set_pair(pair.link1, pair.link2, allowed=True)
        for pair in semantics.enabled_collisions:
            made.set_pair(pair.link1, pair.link2, allowed=False)
        if not semantics.disabled_collisions and not semantics.unchecked_links:
            parts: dict[str, list[str]] = {}
            for each in robot.links.values():
                parts.setdefault(each.body, []).append(each.name)
            for joint in (*robot.joints.values(), *robot.closing):
                for one in parts[joint.parent]:
                    for other in parts[joint.child]:
                        made.set_pair(one, other, allowed=True)
        return made

    def set_pair(self, first: str, second: str, *, allowed: bool) -> None:
        """Set whether a pair may touch."""
        self._pairs[_key(first, second)] = allowed

    def set_default(self, name: str, *, allowed: bool) -> None:
        """Set whether a name may touch others that no pair covers."""
        self._names[name] = allowed

    def forget(self, name: str) -> None:
        """Remove all entries of a name."""
        self._names.pop(name, None)
        self._pairs = {pair: value for pair, value in self._pairs.items() if name not in pair}

    def clear(self) -> None:
        """Remove all entries: nothing may touch."""
        self._pairs.clear()
        self._names.clear()

    def copy(self) -> AllowedCollisionMatrix:
        """Return an equal matrix."""
        made = AllowedCollisionMatrix()
        made._pairs, made._names = dict(self._pairs), dict(self._names)  # its own class
        return made

    def allows(self, first: str, second: str) -> bool:
        """Return whether two names may touch."""
        own = self._pairs.get(_key(first, second))
        if own is not None:
            return own
        defaults = [self._names[name] for name in (first, second) if name in self._names]
        return bool(defaults) and all(defaults)

    def allowed_among(self, names: Iterable[str]) -> list[Pair]:
        """Return all pairs of some names that may touch."""
        known = sorted(set(names))
        if not self._names:
            here = set(known)
            return [
                p for p, value in self._pairs.items() if value and {*p} <= here and p[0] != p[1]
            ]
        return [(a, b) for i, a in enumerate(known) for b in known[:i] if self.allows(a, b)]

    @property
    def pairs(self) -> Mapping[Pair, bool]:
        """Entries of pairs, names in alphabetic order."""
        return dict(self._pairs)

    @property
    def defaults(self) -> Mapping[str, bool]:
        """Entries of names."""
        return dict(self._names)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, AllowedCollisionMatrix):
            return NotImplemented
        return self._pairs == other._pairs and self._names == other._names

    __hash__ = None  # type: ignore[assignment]  # it changes


def _key(first: str, second: str) -> Pair:
    return (first, second) if first <= second else (second, first)
