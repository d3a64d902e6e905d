"""Joints by the links that they connect."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Generic, Protocol, TypeVar


class LinkConnection(Protocol):
    """A joint of any file format."""

    @property
    def name(self) -> str:
        """Unique name."""

    @property
    def parent(self) -> str:
        """Name of the parent link."""

    @property
    def child(self) -> str:
        """Name of the child link."""


J = TypeVar("J", bound=LinkConnection)


class JointGraph(Generic[J]):
    """Joints of a robot, of which each holds its child link to its parent link.

    Args:
        joints: In their order; of several that hold one link the first is the link's.

    Attributes:
        holders: The joint that holds each link, by the name of the link.
        below: The joints that hold others to a link, by the name of that link.
        rest: Joints with a child link that another joint holds already.
    """

    def __init__(self, joints: Iterable[J]) -> None:
        self.holders: dict[str, J] = {}
        self.below: dict[str, list[J]] = {}
        self.rest: list[J] = []
        for joint in joints:
            if self.holders.setdefault(joint.child, joint) is joint:
                self.below.setdefault(joint.parent, []).append(joint)
            else:
                self.rest.append(joint)

    def roots(self, links: Iterable[str]) -> list[str]:
        """Return the links that no joint holds."""
        return [link for link in links if link not in self.holders]

    def outwards(self, root: str) -> Iterator[J]:
        """Yield the joints beyond a link, depth first, in their order."""
        waiting = self.below.get(root, [])[::-1]
        while waiting:
            joint = waiting.pop()
            yield joint
            if joint.child != root:
                waiting.extend(reversed(self.below.get(joint.child, ())))

    def inwards(self, link: str) -> Iterator[J]:
        """Yield the joints from a link to its root; those of a ring once."""
        seen: set[str] = set()
        while link in self.holders and link not in seen:
            seen.add(link)
            yield self.holders[link]
            link = self.holders[link].parent

    def between(self, first: str, second: str) -> list[J]:
        """Return the joints on the way from one link to another."""
        up, down = list(self.inwards(first)), list(self.inwards(second))
        shared = {joint.name for joint in up} & {joint.name for joint in down}
        return [joint for joint in (*up, *down) if joint.name not in shared]

    def ring(self, link: str) -> J | None:
        """Return the joint that closes a ring on the way from a link to its root, if one does."""
        seen = {link}
        for joint in self.inwards(link):
            if joint.parent in seen:
                return joint
            seen.add(joint.parent)
        return None
