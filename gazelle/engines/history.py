"""Calls that change what an engine computes, from which another becomes like it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

# Every method of ``Engine`` that changes what it computes, beside those of links, joints and
# models, which change the state (``Engine.peek``). All else only reads.
CHANGES = (
    "add_motor",
    "adopt",
    "attach",
    "delete",
    "detach",
    "make_kinematic",
    "reset",
    "restore",
    "set_parameter",
    "spawn",
    "step",
    "update_world",
    "write_state",
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
