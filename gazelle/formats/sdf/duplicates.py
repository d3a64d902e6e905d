"""Names that two elements have, where SDF allows one: Gazebo loads both, or the first."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from gazelle.description import Parameters
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.build import with_attributes

LINK_PARTS = frozenset({"collision", "light", "sensor", "visual"})
MODEL_PARTS = frozenset({"frame", "link"})
_LEFT_OUT = frozenset({"joint"})
"""Gazebo does not load a second one; of the others it loads each."""


def with_own_names(node: Parameters, tags: Collection[str], reading: Reading) -> Parameters:
    """Return the element without two children of one tag and name.

    Of two joints the first stays; of others the second is called ``NAME_1``.
    """
    seen: dict[str, set[str]] = {tag: set() for tag in (*tags, *_LEFT_OUT)}
    free_names: dict[str, FreeNames] = {}
    children: list[Parameters] = []
    for child in node.children:
        name = child.attributes.get("name", "")
        names = seen.get(child.tag)
        if names is None or name not in names:
            children.append(child)
        elif child.tag in _LEFT_OUT:
            reading.fault(f"{_already(child, name)}: this one is left out", child)
        else:
            if child.tag not in free_names:
                free_names[child.tag] = FreeNames(_all_names(node, child.tag))
            free = free_names[child.tag].after(name)
            reading.fault(f"{_already(child, name)}: this one is called '{free}'", child)
            children.append(with_attributes(child, name=free))
        if names is not None:
            names.add(name)
    same = len(children) == len(node.children) and all(map(_is, children, node.children))
    return node if same else replace(node, children=tuple(children))


class FreeNames:
    """Names with a number behind, found in one pass however many are requested.

    Attributes:
        taken: Names that are not free.
    """

    def __init__(self, taken: set[str]) -> None:
        self.taken = taken
        self._last: dict[str, int] = {}

    def after(self, name: str) -> str:
        """Reserve the name with the first free number behind it, and return it."""
        number = self._last.get(name, 0) + 1
        while f"{name}_{number}" in self.taken:
            number += 1
        self._last[name] = number
        self.taken.add(f"{name}_{number}")
        return f"{name}_{number}"


def _is(one: Parameters, other: Parameters) -> bool:
    return one is other


def _all_names(node: Parameters, tag: str) -> set[str]:
    return {child.attributes.get("name", "") for child in node.find_all(tag)}


def _already(child: Parameters, name: str) -> str:
    return f"there is already a <{child.tag}> named '{name}'"
