"""Rays of range finders, and tables of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.errors import EngineError
from gazelle.native.system import System


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class RangeRays:
    """Rays of a range finder, the same in every scan.

    Attributes:
        link: Scoped name of their link.
        origins: In the link's frame [m], shape (rays, 3).
        directions: Unit vectors, likewise.
        reach: Range [m]; farther bodies may be left out.
    """

    link: str
    origins: Floats
    directions: Floats
    reach: float = math.inf


class RangeTable(Protocol):
    """Range finders of one kind with rays cast together; good for one ``Engine.revision``.

    Distances are infinite where a ray meets nothing, and minus infinite where it starts inside of
    something.

    Attributes:
        system: Casts all rays within the engine's steps; None where the engine has no such system.
        ranges: Distances that the system writes [m], shape (nworld * finders, rays).
    """

    system: System | None
    ranges: Floats

    @property
    def begin(self) -> float:
        """Distance from where distances are measured to the rays' origins [m]."""

    def cast(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, finders, rays); the next call may overwrite them."""
