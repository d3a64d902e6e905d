"""Operations that need forces, which the planar engine lacks; part of ``Engine``."""

# ruff: noqa: ARG001  # every request is refused

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from gazelle.array_types import Worlds
from gazelle.engines.reactions import ContactTable
from gazelle.errors import EngineError


def refuse(what: str) -> EngineError:
    """Return the error for a feature that the plane lacks."""
    return EngineError(
        f"the planar engine computes no forces and does not support {what}",
        hint="use the engine mujoco",
    )


def contacts(sets: Sequence[Sequence[str]], worlds: Worlds | None = None) -> ContactTable:
    """Raise an error: the plane has no contacts."""
    raise refuse("contact points")


def attach(
    parent: str,
    child: str,
    worlds: Worlds | None = None,
    settling: float | None = None,
) -> None:
    """Raise an error: the plane has no attachments."""
    raise refuse(f"a joint between '{parent}' and '{child}'")


def detach(parent: str, child: str, worlds: Worlds | None = None) -> None:
    """Raise an error: the plane has no attachments."""
    raise refuse(f"a joint between '{parent}' and '{child}'")


def set_parameter(kind: str, name: str, values: ArrayLike, worlds: Worlds | None = None) -> None:
    """Raise an error: the plane's parameters are fixed."""
    raise refuse(f"the parameter {kind}")
