"""What engines have that update systems between their steps, without Python."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from gazelle.array_types import Floats
from gazelle.engines.range_rays import RangeRays
from gazelle.native.system import System


@dataclass(frozen=True, slots=True)
class CastRanges:
    """Rays of some range finders of one kind in all worlds.

    Attributes:
        system: Casts them, a row each range finder.
        ranges: What that writes: distances from somewhat behind where rays begin [m], infinite for
            nothing, minus infinite from inside, shape (nworld * n, rays).
        begin: How far behind [m].
    """

    system: System
    ranges: Floats
    begin: float


@runtime_checkable
class SystemEngine(Protocol):
    """What an engine has that updates systems between its steps, in native code."""

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    @property
    def revision(self) -> int:
        """Counts changes of models: systems then have to be bound to the state anew."""

    def update(self, system: System) -> None:
        """Update a system now, whatever its rate, on all threads."""

    def ranges_kind(self, rays: RangeRays) -> Hashable | None:
        """Equal for rays that ``ranges_of`` casts together; None where it cannot at all."""

    def ranges_of(self, rays: Sequence[RangeRays]) -> CastRanges:
        """What casts rays of one kind together; good for one ``revision``."""

    def command_models(self, models: tuple[str, ...], law: Any) -> None:
        """Let a law with a row for each of some models give them their velocities."""

    def follow(self, model: str, path: Any) -> None:
        """Let a path carry a model."""
