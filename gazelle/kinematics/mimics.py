"""Joints that mimic others."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.description import Joint
from gazelle.errors import Error


def leaders_of(joints: Iterable[tuple[str, Joint]]) -> dict[str, str]:
    """Return the joint that each joint mimics, by the names given."""
    return {name: axis.mimic.joint for name, joint in joints for axis in joint.axes if axis.mimic}


def mimic_cycle(joint: str, leaders: dict[str, str]) -> list[str]:
    """Return the joints from one that mimics itself through others back to it; else none.

    Args:
        joint: Name of the joint.
        leaders: Of ``leaders_of``.
    """
    path = [joint]
    while (leader := leaders.get(path[-1])) is not None:
        path.append(leader)
        if leader in path[:-1]:
            return path if leader == joint else []
    return []


def refuse_cycle(name: str, joint: Joint, leaders: dict[str, str], error: type[Error]) -> None:
    """Check that a joint does not mimic itself, through others or not.

    Args:
        name: Of the joint, as in the leaders.
        joint: The joint.
        leaders: Of ``leaders_of``.
        error: Class of the error.

    Raises:
        Error: It mimics itself.
    """
    circle = mimic_cycle(name, leaders)
    if circle:
        raise error(
            f"joint '{name}' mimics itself: {' -> '.join(circle)}",
            source=joint.source,
            hint="let one of them mimic no other",
        )
