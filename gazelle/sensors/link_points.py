"""Points fixed to links."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.array_types import Floats, Worlds
from gazelle.engines import Engine
from gazelle.rotations import cross, rotate


@dataclass(frozen=True, slots=True)
class LinkPoint:
    """Position and velocity of a point of a link, in every world.

    Attributes:
        engine: Knows the motion.
        link: Scoped name of the link.
        offset: The point in the link frame [m], shape (3,).
    """

    engine: Engine
    link: str
    offset: Floats

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return the position in the world frame [m], shape (n, 3)."""
        place = self.engine.links[self.link].placement(worlds)
        return place.position + rotate(place.quaternion, self.offset)

    def position_and_velocity(self, worlds: Worlds | None = None) -> tuple[Floats, Floats]:
        """Return position [m] and velocity [m/s] in the world frame, shapes (n, 3)."""
        place = self.engine.links[self.link].placement(worlds)
        motion = self.engine.links[self.link].motion(worlds)
        arm = rotate(place.quaternion, self.offset)
        return place.position + arm, motion.linear + cross(motion.angular, arm)
