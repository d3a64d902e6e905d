"""Joints that mimic others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from gazelle.description import Joint
from gazelle.errors import Error

_SHOWN = 20  # joints of a cycle that a message names


def leaders_of(joints: Iterable[tuple[str, Joint]]) -> dict[str, str]:
    """Return the joint that each joint mimics, by the names given."""
    return {name: axis.mimic.joint for name, joint in joints for axis in joint.axes if axis.mimic}


def mimic_cycles(leaders: Mapping[str, str]) -> dict[str, str]:
    """Return each joint that mimics itself through others, and the names from it back to it.

    Args:
        leaders: Of ``leaders_of``.
    """
    cycles: dict[str, str] = {}
    seen: set[str] = set()
    for first in leaders:
        path: dict[str, int] = {}
        joint: str | None = first
        while joint is not None and joint not in seen:
            seen.add(joint)
            path[joint] = len(path)
            joint = leaders.get(joint)
        ring = list(path)[path[joint] :] if joint in path else []
        cycles.update((name, _shown(ring, place)) for place, name in enumerate(ring))
    return cycles


def _shown(ring: Sequence[str], place: int) -> str:
    """Return the names of a ring from one on, back to it."""
    names = [ring[(place + step) % len(ring)] for step in range(min(len(ring), _SHOWN))]
    return " -> ".join((*names, *(["..."] if len(names) < len(ring) else []), ring[place]))


def refuse_cycle(name: str, joint: Joint, cycles: Mapping[str, str], error: type[Error]) -> None:
    """Check that a joint does not mimic itself, through others or not.

    Args:
        name: Of the joint, as in the leaders.
        joint: The joint.
        cycles: Of ``mimic_cycles``.
        error: Class of the error.

    Raises:
        Error: It mimics itself.
    """
    if name in cycles:
        raise error(
            f"joint '{name}' mimics itself: {cycles[name]}",
            source=joint.source,
            hint="let one of them mimic no other",
        )
