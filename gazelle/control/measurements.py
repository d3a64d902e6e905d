"""Measurements of poses, joints and wrenches."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.array_types import Floats

SixNumbers = tuple[float, float, float, float, float, float]

NO_VARIANCE: SixNumbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Odometry:
    """Odometry of a robot, in every world.

    Attributes:
        stamp: Simulated time [ns].
        frame: Frame of the pose.
        child_frame: Frame of the twist.
        position: [m], shape (nworld, 3).
        quaternion: (x, y, z, w), shape (nworld, 4).
        linear: Velocity in the child frame [m/s], shape (nworld, 3).
        angular: Angular velocity in the child frame [rad/s], shape (nworld, 3).
        pose_variance: Of x, y, z [m²] and roll, pitch, yaw [rad²].
        twist_variance: Of the velocities, in the same order.
    """

    stamp: int
    frame: str
    child_frame: str
    position: Floats
    quaternion: Floats
    linear: Floats
    angular: Floats
    pose_variance: SixNumbers = NO_VARIANCE
    twist_variance: SixNumbers = NO_VARIANCE


class TruePose(Odometry):
    """The same of a body, as the simulation knows it; its name is taken as it is written.

    The velocities are in the frame of the pose.
    """

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class JointStates:
    """Joints by name, in every world.

    Attributes:
        stamp: Simulated time [ns].
        names: Plain joint names.
        position: [m or rad], shape (nworld, joints).
        velocity: [m/s or rad/s], shape (nworld, joints); (nworld, 0) when not measured.
        effort: [N or N m], in the same way.
    """

    stamp: int
    names: tuple[str, ...]
    position: Floats
    velocity: Floats
    effort: Floats | None = None


@dataclass(frozen=True, slots=True)
class Transform:
    """Pose of one frame in another, in every world.

    Attributes:
        frame: The parent.
        child_frame: The child.
        position: Of the child in the parent [m], shape (nworld, 3).
        quaternion: (x, y, z, w), shape (nworld, 4).
    """

    frame: str
    child_frame: str
    position: Floats
    quaternion: Floats


@dataclass(frozen=True, slots=True)
class Transforms:
    """Several frames at one time.

    Attributes:
        stamp: Simulated time [ns].
        transforms: In any order.
    """

    stamp: int
    transforms: tuple[Transform, ...]


@dataclass(frozen=True, slots=True)
class WrenchValue:
    """Force and torque.

    Attributes:
        stamp: Simulated time [ns].
        force: [N], shape (nworld, 3).
        torque: [N m], shape (nworld, 3).
    """

    stamp: int
    force: Floats
    torque: Floats
