"""Operations that need forces, which the planar engine lacks; part of ``Engine``."""

# ruff: noqa: ARG001  # whatever is asked for is refused

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from gazelle.array_types import Worlds
from gazelle.engines.reactions import ContactTable
from gazelle.errors import EngineError


def refuse(what: str) -> EngineError:
    """The error for something that the plane has not."""
    return EngineError(
        f"the planar engine knows no forces, so it has not {what}", hint="use the engine mujoco"
    )


def contacts(sets: Sequence[Sequence[str]], worlds: Worlds | None = None) -> ContactTable:
    """Refused."""
    raise refuse("contact points")


def attach(
    parent: str,
    child: str,
    worlds: Worlds | None = None,
    settling: float | None = None,
) -> None:
    """Refused."""
    raise refuse(f"a joint between '{parent}' and '{child}'")


def detach(parent: str, child: str, worlds: Worlds | None = None) -> None:
    """Refused."""
    raise refuse(f"a joint between '{parent}' and '{child}'")


def set_parameter(kind: str, name: str, values: ArrayLike, worlds: Worlds | None = None) -> None:
    """Refused."""
    raise refuse(f"the parameter {kind}")
