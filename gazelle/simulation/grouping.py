"""Put things of one kind together, and one thing in the place of each such group."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")


def of_one_kind(items: Iterable[T], kind: Callable[[T], Hashable | None]) -> list[list[T]]:
    """Group items by kind, in order; those without a kind (None) are left out."""
    groups: dict[Hashable, list[T]] = {}
    for item in items:
        its = kind(item)
        if its is not None:
            groups.setdefault(its, []).append(item)
    return list(groups.values())


def with_replacements(
    items: Iterable[T], replaced: Iterable[tuple[Sequence[T], R | None]]
) -> list[T | R]:
    """Return items in order, with each group replaced by its substitute at the group's first item.

    Args:
        items: All.
        replaced: Groups of them, and what stands for each; None for nothing.
    """
    first: dict[int, R] = {}
    gone = set[int]()
    for group, replacement in replaced:
        gone.update(map(id, group))
        if replacement is not None:
            first[id(group[0])] = replacement
    return [
        first.get(id(item), item) for item in items if id(item) in first or id(item) not in gone
    ]
