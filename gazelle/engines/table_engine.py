"""What engines have that look at many links at once, for parts of many robots updated together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats
from gazelle.engines.engine import Engine
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.reactions import TouchTable


@runtime_checkable
class TableEngine(Protocol):
    """What it gives of many is the same bits as one by one, in all worlds."""

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    def link_placements(self, links: Sequence[str]) -> Placement:
        """Where links are: shapes (nworld, links, 3) and (nworld, links, 4)."""

    def link_motions(self, links: Sequence[str]) -> Motion:
        """How links move, shape (nworld, links, 3)."""

    def link_accelerations(self, links: Sequence[str]) -> Motion:
        """How that changes in the next physics step, likewise; see ``link_acceleration``."""

    def model_placements(self, models: Sequence[str]) -> Placement:
        """Where models' frames are: shapes (nworld, models, 3) and (nworld, models, 4)."""

    def set_ground_motions(self, models: Sequence[str], twist: ArrayLike) -> None:
        """Give models the velocities of ``Engine.set_ground_motion``.

        Args:
            models: Names.
            twist: Forward and to the left [m/s], turning [rad/s], shape (nworld, models, 3).
        """

    def joint_positions(self, joints: Sequence[str]) -> Floats:
        """Positions of joints' first axes [m or rad], shape (nworld, joints).

        Raises:
            EngineError: There is no such joint, or it is a ball or floating one, without an axis.
        """

    def joint_velocities(self, joints: Sequence[str]) -> Floats:
        """Velocities of joints' first axes [m/s or rad/s], likewise."""

    def drive_joints(
        self, joints: Sequence[str], velocity: ArrayLike, chosen: Bools | None = None
    ) -> None:
        """Set the velocities that motors on joints' first axes hold [m/s or rad/s].

        Args:
            joints: Scoped names.
            velocity: Shape (nworld, joints) or (joints,).
            chosen: Which of them, shape (joints,); all if None.

        Raises:
            EngineError: One of them has no motor.
        """

    def place_joints(
        self, joints: tuple[str, ...], position: Floats, velocity: Floats, chosen: Bools
    ) -> None:
        """Put joints with one axis somewhere; see ``CarryingEngine.place_joints``."""

    def parameter(self, kind: str, name: str) -> Floats:
        """A physical parameter, shape (nworld, width)."""

    def cast_ranges_together(
        self, links: Sequence[str], origins: Floats, directions: Floats
    ) -> tuple[Floats, float]:
        """Follow the rays of many range finders; see ``cast_ranges``.

        Args:
            links: That carry them, n in all; one may carry several.
            origins: In the links' frames [m], shape (n, rays, 3).
            directions: Unit vectors, likewise.

        Returns:
            Distances from somewhat behind the origins [m], shape (nworld, n, rays), infinite for
            nothing, minus infinite from inside; and how far behind [m].
        """

    def touching_each(self, sets: Sequence[tuple[str, ...]]) -> TouchTable:
        """What ``touching`` says of each of some sets of collisions, in all worlds."""


def as_table_engine(engine: Engine) -> TableEngine:
    """An engine that is one of these.

    Raises:
        TypeError: It looks at one link at a time.
    """
    if not isinstance(engine, TableEngine):
        raise TypeError(f"{type(engine).__name__} looks at one link at a time")
    return engine
