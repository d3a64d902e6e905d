"""A motion of a robot's joints that was planned."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class JointMotion:
    """Planned motion of joints over time.

    Attributes:
        joints: Names of those that move.
        times: Since its beginning [s], rising from 0, shape (m,).
        positions: [m or rad], shape (m, joints).
        start: Positions of other joints meanwhile [m or rad]; of those not named zero.
        tip: Name of the link to follow, "" if unknown.
    """

    joints: tuple[str, ...]
    times: Floats
    positions: Floats
    start: Mapping[str, float]
    tip: str = ""
