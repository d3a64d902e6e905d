"""Ray tracing of the visible shapes of a world, apart from those that collide.

A tracer knows no physics. It gets the poses of links and casts rays to the nearest
visual, on the processor, with no graphics card and no screen.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import Pose, Visual, World


@dataclass(frozen=True, slots=True)
class RayHits:
    """Hits of rays.

    Attributes:
        distance: [m], shape (rays,); infinite for nothing.
        normal: Of the surface, away from it, shape (rays, 3); zero for nothing.
        visual: Index into ``Tracer.visuals``, shape (rays,); -1 for nothing.
    """

    distance: Floats
    normal: Floats
    visual: NDArray[np.intp]


class Tracer(Protocol):
    """Follows rays through the visuals of one world."""

    @property
    def visuals(self) -> tuple[Visual, ...]:
        """All visuals that can be met."""

    def place(self, poses: Mapping[str, Pose]) -> None:
        """Set the poses of links in the world, by scoped name."""

    def trace(self, origins: Floats, directions: Floats) -> RayHits:
        """Cast rays in the world frame, shapes (rays, 3), directions of unit length."""


def make_tracer(world: World) -> Tracer:
    """Create a tracer of a world, its links at the described poses.

    Raises:
        EngineError: A shape cannot be built.
    """
    from gazelle.engines.mujoco.tracer import MujocoTracer

    return MujocoTracer(world)
