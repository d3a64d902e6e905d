"""Expansion of the elements of a ``<world>`` that stand for models.

Actors, populations, and what the first ``<state>`` says was added to or taken from the
world become plain elements, or go, before anything is read.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from gazelle.description import Parameters
from gazelle.formats.reading import Reading
from gazelle.formats.sdf import actor, population

_CHANGES = ("insertions", "deletions")


def prepared(world: Parameters, reading: Reading) -> Parameters:
    """Return the world as plain elements.

    Raises:
        FormatError: An actor makes no sense, or a population is too large.
    """
    children = tuple(_plain(world.children, reading))
    state = world.find("state")
    if state is not None and any(tag in state for tag in _CHANGES):
        children = tuple(_changed(children, state, reading))
    return world if children == world.children else replace(world, children=children)


def _plain(nodes: tuple[Parameters, ...], reading: Reading) -> Iterator[Parameters]:
    for node in nodes:
        if node.tag == "actor":
            yield actor.as_model(node)
        elif node.tag == "population":
            yield from population.expanded(node, reading)
        else:
            yield node


def _changed(
    children: tuple[Parameters, ...], state: Parameters, reading: Reading
) -> Iterator[Parameters]:
    """Yield the children after the state's deletions and insertions.

    The state no longer names them then.
    """
    gone = {name.text for part in state.find_all("deletions") for name in part.find_all("name")}
    own = {(node.tag, node.attributes.get("name", "")) for node in children}
    for node in children:
        if node is state:
            kept = (child for child in state.children if child.tag not in _CHANGES)
            yield replace(state, children=tuple(kept))
        elif node.tag not in {"model", "light"} or node.attributes.get("name") not in gone:
            yield node
    for part in state.find_all("insertions"):
        for node in _plain(part.children, reading):
            # Gazebo's logs repeat what was there from the start
            if (node.tag, node.attributes.get("name", "")) not in own:
                yield node
