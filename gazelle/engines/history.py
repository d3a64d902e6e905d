"""Calls that change what an engine computes, from which another becomes like it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

# Every method of ``Engine`` that changes what it computes. All else only reads.
CHANGES = (
    "add_motor",
    "adopt",
    "attach",
    "delete",
    "detach",
    "make_kinematic",
    "reset",
    "restore",
    "set_ground_motion",
    "set_joint_effort",
    "set_joint_position",
    "set_joint_velocity",
    "set_link_motion",
    "set_link_placement",
    "set_link_wrench",
    "set_model_motion",
    "set_model_placement",
    "set_motor_velocity",
    "set_parameter",
    "spawn",
    "step",
    "update_world",
)


@dataclass(frozen=True, slots=True)
class Call:
    """A call of one of an engine's methods that change something.

    Attributes:
        method: Its name.
        arguments: In order.
    """

    method: str
    arguments: tuple[Any, ...]
