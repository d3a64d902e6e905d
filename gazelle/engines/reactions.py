"""Forces that engines report: joint wrenches and contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.errors import EngineError


@dataclass(frozen=True, slots=True)
class Wrench:
    """A force and a torque in each world.

    Attributes:
        force: [N], shape (n, 3).
        torque: [N m], shape (n, 3).
    """

    force: Floats
    torque: Floats


@dataclass(frozen=True, slots=True)
class ContactTable:
    """Contacts of some sets of collisions, set by set and world by world; see ``Contacts``.

    Attributes:
        sets: Set of each contact, shape (k,).
        worlds: World of each contact, shape (k,).
        names: Scoped names of collisions; another object when models have changed.
        collisions: Of the set, as indices of ``names``, shape (k,).
        others: Other collisions of the contacts, likewise.
        terms: Position, normal, depth, force and torque side by side, shape (k, 13).
    """

    sets: Indices
    worlds: Indices
    names: Sequence[str]
    collisions: Indices
    others: Indices
    terms: Floats

    def named(self) -> Contacts:
        """Return the contacts by the names of their collisions, in the same order."""
        return Contacts(
            collisions=tuple(self.names[i] for i in self.collisions.tolist()),
            others=tuple(self.names[i] for i in self.others.tolist()),
            position=self.terms[:, :3],
            normal=self.terms[:, 3:6],
            depth=self.terms[:, 6],
            force=self.terms[:, 7:10],
            torque=self.terms[:, 10:],
        )


@checked(EngineError, after=True)
@dataclass(frozen=True, slots=True)
class Contacts:
    """The points where some collisions touch others, in the world frame.

    Attributes:
        collisions: Scoped names, ``model::link::collision``, of the requested ones, length k.
        others: Scoped names of what touches them, length k.
        position: Between the two surfaces [m], shape (k, 3).
        normal: Unit vectors from the other into the collision, shape (k, 3).
        depth: Penetration depth [m], shape (k,); negative for a contact that
            acts shortly before they touch.
        force: On the collision, at ``position`` [N], shape (k, 3).
        torque: On the collision, of torsional friction [N m], shape (k, 3).
    """

    collisions: tuple[str, ...]
    others: tuple[str, ...]
    position: Floats
    normal: Floats
    depth: Floats
    force: Floats
    torque: Floats

    def __len__(self) -> int:
        return len(self.collisions)
