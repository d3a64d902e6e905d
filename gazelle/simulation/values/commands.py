"""Commands to plugins, and their answers."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from gazelle.array_types import Floats


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
class LinkName:
    """Link of any model.

    Attributes:
        model: Name of the model.
        link: Name of the link of it.
    """

    model: str
    link: str


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
    """Desired joint positions over time.

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
class ServiceOutcome:
    """Outcome of a service call.

    Attributes:
        success: Whether.
        text: Reason, or what was done.
    """

    success: bool
    text: str


@dataclass(frozen=True, slots=True)
class Trigger:
    """That something shall happen; it says no more."""


@dataclass(frozen=True, slots=True)
class EmergencyStop:
    """State of the emergency stop: pressed or not."""

    on: bool


@dataclass(frozen=True, slots=True)
class MotorPower:
    """Command to switch the power of motors."""

    on: bool


@dataclass(frozen=True, slots=True)
class Number:
    """A number of little precision: what ROS sends as a Float32."""

    value: float


@dataclass(frozen=True, slots=True)
class DriveCommand:
    """Commands to the two sides of a vessel, in one world or in many.

    Attributes:
        left: Of the full thrust, from -1 to 1, shape () or (n,).
        right: Likewise.
    """

    left: ArrayLike
    right: ArrayLike


@dataclass(frozen=True, slots=True)
class Bias:
    """Error that is added to a sensor from now on.

    Attributes:
        values: Three numbers, in the sensor's unit.
    """

    values: ArrayLike


@dataclass(frozen=True, slots=True)
class GeoReference:
    """Position on Earth of the world's origin.

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
class TurnCommand:
    """An orientation to turn to.

    Attributes:
        frame: Reference frame.
        quaternion: (x, y, z, w), shape (4,).
    """

    frame: str
    quaternion: ArrayLike
