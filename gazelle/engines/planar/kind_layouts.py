"""Models of kinds that lay themselves out in the plane, as their files have outlines and drives.

What lays out a kind (``Model.kind``) is found by an entry point of the group
``gazelle.engines.planar``, named as the kind. Models of other kinds are made of their links.
"""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from gazelle.argument_checks import checked
from gazelle.description import Model
from gazelle.engines.planar.fleet_bodies import Body
from gazelle.engines.planar.shapes import PrimitiveTable, primitives_of
from gazelle.errors import EngineError
from gazelle_ros.base.entry_points import entry_points_of, load

_GROUP = "gazelle.engines.planar"


@checked(EngineError)
@dataclass(slots=True)
class KindLayout:
    """Models of one kind in a fleet.

    Attributes:
        bodies: One for each model that can move.
        names: Of the models that ``bodies`` are of.
        passive: Names of those among them that move only when they are placed.
        extra_bodies: Other bodies; in a fleet they come after all others.
        statics: All that never moves.
        heights: Of rays beside those of lidars [m].
    """

    bodies: list[Body] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    passive: list[str] = field(default_factory=list)
    extra_bodies: list[Body] = field(default_factory=list)
    statics: PrimitiveTable = field(default_factory=lambda: primitives_of(()))
    heights: frozenset[float] = frozenset()


class KindLayoutFactory(Protocol):
    """Lays out all models of a kind."""

    def __call__(
        self, models: Sequence[Model], *, kinematic: Collection[str], others: int
    ) -> KindLayout:
        """Return a layout.

        Args:
            models: Of the kind.
            kinematic: Names of kinematic models.
            others: Bodies that come between ``bodies`` and ``extra_bodies``.
        """


def lay_out_kind(
    kind: str, models: Sequence[Model], *, kinematic: Collection[str], others: int
) -> KindLayout:
    """Return the layout of models of a kind; an empty one for no model."""
    lay_out = find_layout(kind) if models else None
    if lay_out is None:
        return KindLayout()
    return lay_out(models, kinematic=kinematic, others=others)


def parted_by_kind(models: Iterable[Model]) -> tuple[str, list[Model], list[Model]]:
    """Return a kind that lays itself out, its models, and all others.

    Raises:
        EngineError: There are models of two such kinds.
    """
    kind, own, others = "", list[Model](), list[Model]()
    for model in models:
        if find_layout(model.kind) is None:
            others.append(model)
            continue
        if own and model.kind != kind:
            raise EngineError(
                f"the plane cannot hold models of '{kind}' and '{model.kind}' files at once",
                source=model.source,
            )
        kind = model.kind
        own.append(model)
    return kind, own, others


@functools.cache
def find_layout(kind: str) -> KindLayoutFactory | None:
    """Return what lays out models of a kind; None for one without.

    Raises:
        EngineError: It cannot be imported.
    """
    point = entry_points_of(_GROUP).get(kind) if kind else None
    if point is None:
        return None
    found: KindLayoutFactory = load(point, f"the layout of '{kind}' models", EngineError)
    return found
