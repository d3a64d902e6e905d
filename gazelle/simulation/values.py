"""Plain values that ports carry. Arrays have a leading axis over worlds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.engines import Contacts
from gazelle.sensors import ImuReading

Floats = NDArray[np.float64]
SixNumbers = tuple[float, float, float, float, float, float]

NO_VARIANCE: SixNumbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Odometry:
    """Where a robot believes to be, in every world.

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
    """Where one frame is in another, in every world.

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


@dataclass(frozen=True, slots=True)
class Touches:
    """Contacts, in every world.

    Attributes:
        stamp: Simulated time [ns].
        contacts: One for each world.
    """

    stamp: int
    contacts: tuple[Contacts, ...]


@dataclass(frozen=True, slots=True)
class RangeValue:
    """One distance, in every world.

    Attributes:
        stamp: Simulated time [ns].
        distance: [m], shape (nworld,).
        least: Shortest that is measured [m].
        most: Longest that is measured [m].
        field_of_view: Angle of the cone [rad].
        ultrasound: Whether by sound; else by infrared light.
    """

    stamp: int
    distance: Floats
    least: float
    most: float
    field_of_view: float
    ultrasound: bool


@dataclass(frozen=True, slots=True)
class Push:
    """A force and a torque to act with, in one world or in many.

    Attributes:
        force: In the world frame [N], shape (3,) or (n, 3).
        torque: In the world frame [N m], shape (3,) or (n, 3).
    """

    force: ArrayLike
    torque: ArrayLike


@dataclass(frozen=True, slots=True)
class LinkPair:
    """Two links of any models, to be joined or parted.

    Attributes:
        model_1: Name of a model.
        link_1: Name of a link of it.
        model_2: Name of the other model.
        link_2: Name of a link of that.
    """

    model_1: str
    link_1: str
    model_2: str
    link_2: str


@dataclass(frozen=True, slots=True)
class JointPath:
    """Where joints have to be, and when.

    Attributes:
        names: Plain joint names.
        times: Since the start [s], rising, shape (k,).
        positions: [m or rad], shape (k, joints).
        start_ns: Simulated time of the start; at once if that is past.
    """

    names: tuple[str, ...]
    times: Floats
    positions: Floats
    start_ns: int = 0


@dataclass(frozen=True, slots=True)
class PathRequest:
    """A joint path, and a place for the model before it.

    Attributes:
        path: Of the joints.
        position: Of the model [m], shape (3,); None to leave it.
        quaternion: (x, y, z, w), shape (4,); None to leave it.
    """

    path: JointPath
    position: ArrayLike | None = None
    quaternion: ArrayLike | None = None


@dataclass(frozen=True, slots=True)
class Outcome:
    """Whether something could be done.

    Attributes:
        success: Whether.
        text: Why not, or what was done.
    """

    success: bool
    text: str


@dataclass(frozen=True, slots=True)
class Flags:
    """Yes or no, in every world.

    Attributes:
        values: Shape (nworld,).
    """

    values: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class LaserPoints:
    """Where the rays of a lidar ended, in its own frame, in every world.

    Attributes:
        stamp: Simulated time [ns].
        points: [m], shape (nworld, rays, 3).
        intensities: Of the returns, shape (rays,).
        rings: Row of each ray, from the lowest, shape (rays,).
        kept: Which are worth telling, shape (nworld, rays).
    """

    stamp: int
    points: Floats
    intensities: Floats
    rings: NDArray[np.intp]
    kept: NDArray[np.bool_]


class ChannelPoints(LaserPoints):
    """The same, for those who want each property in a channel of its own."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class UnsureImu:
    """An IMU's reading and how sure each of its parts is.

    Attributes:
        reading: Of all worlds.
        orientation_variance: [rad²], three numbers.
        rate_variance: [rad²/s²], three numbers.
        acceleration_variance: [m²/s⁴], three numbers.
    """

    reading: ImuReading
    orientation_variance: Floats
    rate_variance: Floats
    acceleration_variance: Floats


@dataclass(frozen=True, slots=True)
class Fix:
    """Where a receiver is on Earth, in every world.

    Attributes:
        stamp: Simulated time [ns].
        latitude: [deg], shape (nworld,).
        longitude: [deg], shape (nworld,).
        altitude: [m], shape (nworld,).
        variance: Of east, north and up [m²], three numbers.
        status: As ``sensor_msgs/NavSatStatus`` counts.
        service: As ``sensor_msgs/NavSatStatus`` counts.
    """

    stamp: int
    latitude: Floats
    longitude: Floats
    altitude: Floats
    variance: Floats
    status: int = 0
    service: int = 0


@dataclass(frozen=True, slots=True)
class VectorValue:
    """A vector, in every world.

    Attributes:
        stamp: Simulated time [ns].
        values: Shape (nworld, 3).
    """

    stamp: int
    values: Floats


class MagneticValue(VectorValue):
    """A magnetic field [T]."""

    __slots__ = ()


class PointValue(VectorValue):
    """A place [m]."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Bias:
    """What a sensor shall be wrong by from now on.

    Attributes:
        values: Three numbers, in the sensor's unit.
    """

    values: ArrayLike


@dataclass(frozen=True, slots=True)
class GeoReference:
    """Where on Earth the world's origin is to be.

    Attributes:
        latitude: [deg].
        longitude: [deg].
        altitude: [m].
        heading: [rad].
    """

    latitude: float
    longitude: float
    altitude: float
    heading: float


@dataclass(frozen=True, slots=True)
class Trigger:
    """That something shall happen; it says no more."""


@dataclass(frozen=True, slots=True)
class MotorPower:
    """Whether motors shall have power."""

    on: bool


@dataclass(frozen=True, slots=True)
class CliffValue:
    """What a sensor that looks at the floor sees.

    Attributes:
        place: 0 left, 1 in the middle, 2 right.
        deep: Whether the floor is farther than it should be, shape (nworld,).
        reading: Of the sensor's converter, shape (nworld,).
    """

    place: int
    deep: NDArray[np.bool_]
    reading: Floats


@dataclass(frozen=True, slots=True)
class BumperValue:
    """Whether a bumper is pressed.

    Attributes:
        place: 0 left, 1 in the middle, 2 right.
        pressed: Shape (nworld,).
    """

    place: int
    pressed: NDArray[np.bool_]
