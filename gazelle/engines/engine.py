"""What every engine can do: hold many copies of one world, and move them.

All state is in arrays with a leading axis over worlds. ``worlds`` arguments name some
of them by index, shape (n,), sorted and unique; None means all, n = nworld. Positions are in
metres, velocities in m/s and rad/s, both in the world frame; quaternions are (x, y, z, w).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.description import Model, World

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Placement:
    """Where something is in each world.

    Attributes:
        position: [m], shape (n, 3).
        quaternion: Unit quaternions (x, y, z, w), shape (n, 4).
    """

    position: Floats
    quaternion: Floats


@dataclass(frozen=True, slots=True)
class Motion:
    """How something moves in each world, seen from the world frame.

    Attributes:
        linear: Velocity of its origin [m/s], shape (n, 3).
        angular: Angular velocity [rad/s], shape (n, 3).
    """

    linear: Floats
    angular: Floats


@dataclass(frozen=True, slots=True)
class Hits:
    """What rays met in each world.

    Attributes:
        distance: To the nearest collision shape [m], shape (n, rays); infinite for none.
        from_inside: Whether the ray started inside that shape, shape (n, rays).
    """

    distance: Floats
    from_inside: NDArray[np.bool_]


class Engine(Protocol):
    """A batch of copies of one world, all made of the same models."""

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    @property
    def time_step(self) -> float:
        """Physics step [s]."""

    @property
    def world(self) -> World:
        """The world that runs, with what was spawned and without what was deleted."""

    @property
    def link_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::link``."""

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::joint``, of joints that can move."""

    def step(self, count: int = 1) -> None:
        """Advance every world by ``count`` physics steps.

        Raises:
            EngineError: The state of a world became infinite or undefined.
        """

    def reset(self, worlds: Worlds | None = None) -> None:
        """Put worlds back to their initial state: poses, rest, no forces."""

    def link_placement(self, link: str, worlds: Worlds | None = None) -> Placement:
        """Where a link is."""

    def link_motion(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link moves."""

    def link_acceleration(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link's motion changes in the next physics step [m/s², rad/s²].

        Contacts, joints and commands are taken as they are now; nothing moves.
        """

    def model_placement(self, model: str, worlds: Worlds | None = None) -> Placement:
        """Where a model's frame is: it moves with the canonical link."""

    def set_model_placement(
        self, model: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Move a model rigidly, joints as they are; a static model too.

        Args:
            model: Name.
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4).
            worlds: Which worlds.
        """

    def set_model_motion(
        self, model: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give all links of a model the velocity of one rigid body, joints at rest.

        Args:
            model: Name.
            linear: Of the model's frame, in the world frame [m/s], shape (3,) or (n, 3).
            angular: In the world frame [rad/s], shape (3,) or (n, 3).
            worlds: Which worlds.
        """

    def joint_position(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Position [m or rad], shape (n, axes)."""

    def joint_velocity(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Velocity [m/s or rad/s], shape (n, axes)."""

    def set_joint_position(
        self, joint: str, position: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a joint somewhere [m or rad], shape (axes,) or (n, axes)."""

    def set_joint_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a joint a velocity [m/s or rad/s], shape (axes,) or (n, axes)."""

    def set_joint_effort(self, joint: str, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply an effort [N or N m] until told otherwise, shape (axes,) or (n, axes)."""

    def add_motor(self, joint: str, max_effort: float) -> None:
        """Give a joint of one axis a motor that holds a velocity with limited effort [N or N m]."""

    def set_motor_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity that a joint's motor holds [m/s or rad/s], shape () or (n,)."""

    def make_kinematic(self, model: str) -> None:
        """Let a model move only by ``set_model_placement``; it pushes, nothing pushes it."""

    def cast_rays(
        self,
        link: str,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
    ) -> Hits:
        """Follow rays to the nearest collision shape.

        Args:
            link: The link that the rays move with.
            origins: In the link frame [m], shape (rays, 3).
            directions: Unit vectors in the link frame, shape (rays, 3).
            worlds: Which worlds.
        """

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is.

        Raises:
            EngineError: The name is taken, or the model cannot be simulated; nothing is changed.
        """

    def delete(self, model: str) -> None:
        """Take a model out of every world; all else stays as it is."""

    def snapshot(self) -> Floats:
        """The whole dynamic state, shape (nworld, size)."""

    def restore(self, state: Floats) -> None:
        """Put back what ``snapshot`` gave; the models must be the same.

        Raises:
            EngineError: The state does not fit the models that run now.
        """

    def close(self) -> None:
        """Free threads and memory."""
