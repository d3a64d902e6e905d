"""Joints that mimic others."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.description import Joint


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
