"""Protocols of an engine's state: readable and writable quantities of links, joints and models.

``worlds`` arguments are as in ``engine``. Arrays of one row have the shape (n, ...), those of several
rows the shape (n, rows, ...). Positions are in metres, velocities in m/s and rad/s, both in the world
frame; quaternions are (x, y, z, w).
"""

from __future__ import annotations

from typing import Protocol

from numpy.typing import ArrayLike

from gazelle.array_types import Bools, Floats, Indices, Worlds
from gazelle.description import Pose
from gazelle.engines.motion import Hits, Motion, Placement
from gazelle.engines.reactions import Wrench
from gazelle.native.joint_system import JointSystem
from gazelle.native.paths import ModelPath
from gazelle.native.system import System


class LinkRows(Protocol):
    """Links of all worlds, to be read."""

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the poses of the links."""

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Return the velocities of the links."""

    def acceleration(self, worlds: Worlds | None = None) -> Motion:
        """Return by how much the velocities change in the next physics step [m/s², rad/s²].

        Contacts, joints and commands are taken as they are now; nothing moves.
        """


class LinkRow(LinkRows, Protocol):
    """One link of all worlds."""

    def centre(self, worlds: Worlds | None = None) -> Floats:
        """Return the centre of mass [m], shape (n, 3)."""

    def cast_rays(
        self,
        origins: Floats,
        directions: Floats,
        worlds: Worlds | None = None,
        *,
        ignore_own: bool = False,
    ) -> Hits:
        """Cast rays that move with the link to the nearest collision shape.

        Args:
            origins: In the link frame [m], shape (rays, 3).
            directions: Unit vectors in the link frame, shape (rays, 3).
            worlds: Worlds.
            ignore_own: Whether rays pass through the shapes of the link.
        """

    def set_placement(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> str:
        """Move the link, and all that hangs on it, joints as they are.

        A link that hangs on a joint takes the part of the pose that its joint allows: a hinge the
        turn about its axis, a slide the way along it, within its limits. Its parent stays.

        Args:
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4).
            worlds: Worlds.

        Returns:
            The scoped name of the joint that was moved; empty if the whole model was.

        Raises:
            EngineError: The link is fixed to the world.
        """

    def set_motion(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of the link; attached links keep the speeds of their joints.

        A link that hangs on a joint takes the part that its joint allows, as of a pose.

        Args:
            linear: Of the link's origin [m/s], shape (3,) or (n, 3).
            angular: [rad/s], shape (3,) or (n, 3).
            worlds: Worlds.
        """

    def set_wrench(self, force: ArrayLike, torque: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply a wrench at the centre of mass until another is set, in the world frame.

        Args:
            force: [N], shape (3,) or (n, 3).
            torque: [N m], shape (3,) or (n, 3).
            worlds: Worlds.

        Raises:
            EngineError: The link does not move, or the engine knows no forces.
        """


class JointRows(Protocol):
    """First axes of joints of all worlds, one column each.

    Raises:
        EngineError: There is no such joint, or it is a ball or floating joint, without an axis.
    """

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return positions [m or rad], shape (n, joints)."""

    def velocity(self, worlds: Worlds | None = None) -> Floats:
        """Return velocities [m/s or rad/s], shape (n, joints)."""

    def limits(self) -> tuple[Floats, Floats]:
        """Return least and greatest positions [m or rad], shape (nworld, joints) each.

        Raises:
            EngineError: The engine has none.
        """

    def place(self, position: Floats, velocity: Floats, chosen: Bools) -> None:
        """Set positions and velocities, positions to their limits at most.

        Args:
            position: [m or rad], shape (nworld, joints).
            velocity: [m/s or rad/s], shape (nworld, joints).
            chosen: Those to set, shape (nworld, joints).
        """

    @property
    def in_step(self) -> bool:
        """True where systems of the joints can act within the engine's steps."""

    def bind(self, system: JointSystem, *, in_step: bool = False) -> None:
        """Set a system's columns of the joints, valid for one ``Engine.revision``.

        Args:
            system: To be bound.
            in_step: Whether steps are to call it; what has to be compiled for that is.
        """

    def read(self, system: JointSystem) -> None:
        """Update positions and velocities of a bound system."""

    def act(self, system: JointSystem) -> None:
        """Apply the efforts and motors' velocities that a bound system has set."""

    def set_motor_velocity(self, velocity: ArrayLike, chosen: Bools | None = None) -> None:
        """Set the velocities that motors hold [m/s or rad/s].

        Args:
            velocity: Shape (nworld, joints) or (joints,).
            chosen: Joints to set, shape (joints,); all if None.

        Raises:
            EngineError: One of the joints has no motor.
        """

    def motor_targets(self) -> tuple[Floats, Indices]:
        """Return the velocities that motors hold, to be written, and the joints' columns.

        They are shapes (nworld, n) and (joints,), and good for one ``revision`` of the engine.

        Raises:
            EngineError: One of the joints has no motor.
        """


class JointRow(Protocol):
    """One joint of all worlds, with all its axes."""

    def position(self, worlds: Worlds | None = None) -> Floats:
        """Return the position [m or rad], shape (n, axes).

        Of a ball joint it is a quaternion (x, y, z, w), shape (n, 4); of a floating one a
        position and a quaternion, shape (n, 7).
        """

    def velocity(self, worlds: Worlds | None = None) -> Floats:
        """Return the velocity [m/s or rad/s], shape (n, axes)."""

    def effort(self, worlds: Worlds | None = None) -> Floats:
        """Return the effort that ``set_effort`` applies [N or N m], shape (n, axes)."""

    def wrench(self, worlds: Worlds | None = None) -> Wrench:
        """Return the wrench of the child on the parent through the joint, about its origin.

        It is in the world frame and holds all that the joint transmits: weight, contacts and motion
        of what hangs on it, and along its axes its own effort, motor, spring, damping and stops.
        It is that of the next physics step, as ``LinkRows.acceleration``; nothing moves.

        Raises:
            EngineError: There is no such joint between links that move: its model is static
                or kinematic, or it is a gearbox.
        """

    def set_position(self, position: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the position [m or rad], shape as read or (axes,), to its limits at most."""

    def set_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity [m/s or rad/s], shape (axes,) or (n, axes)."""

    def set_effort(self, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply an effort until another is set [N or N m], shape (axes,) or (n, axes)."""

    def set_motor_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity that the joint's motor holds [m/s or rad/s].

        Args:
            velocity: Shape () or (n,); of a joint with several axes (), (axes,) or (n, axes).
            worlds: Worlds.

        Raises:
            EngineError: The joint has no motor.
        """


class FrameRows(Protocol):
    """Frames of one or several models of all worlds."""

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the poses of the models' frames, which move with the canonical links."""

    def set_ground_motion(self, twist: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set level velocities of the models along and across their headings, joints at rest.

        Args:
            twist: Forward and to the left [m/s], turning [rad/s], shape (3,) or that of the rows.
            worlds: Worlds.
        """


class ModelRows(FrameRows, Protocol):
    """Several models of all worlds."""

    def twist(self, linear: Floats, angular: Floats) -> System | None:
        """Return what gives the models level velocities, as ``set_ground_motion``, in every step.

        It is good for one ``revision`` of the engine. None where only ``set_ground_motion`` can.

        Args:
            linear: Forward and to the left [m/s], may be written later, shape (nworld, models, 3).
            angular: The third is the turning rate [rad/s], likewise.
        """


class ModelRow(FrameRows, Protocol):
    """One model of all worlds."""

    def pose(self, world: int) -> Pose:
        """Return the pose of the model's frame in one world, to the bit that of ``placement``."""

    def planar_pose(self, worlds: Worlds | None = None) -> Floats:
        """Return the pose seen from above: x, y [m] and heading [rad], shape (n, 3)."""

    def set_placement(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Move the model rigidly, joints as they are; a static model too.

        Args:
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4).
            worlds: Worlds.
        """

    def set_motion(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of all links of the model to that of one rigid body, joints at rest.

        Args:
            linear: Of the model's frame [m/s], shape (3,) or (n, 3).
            angular: [rad/s], shape (3,) or (n, 3).
            worlds: Worlds.
        """

    def path(self, path: ModelPath) -> System | None:
        """Return what moves the model, which is kinematic, along a path when it is updated.

        It is good for one ``revision`` of the engine. None where only ``set_placement`` can.
        """
