"""Devices of Stage's model types: drives, sensors, grippers, lights.

SI units, radians. Names and defaults are those of Stage 4.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from gazelle.argument_checks import checked
from gazelle.description.material import Color
from gazelle.errors import FormatError

Drive = Literal["diff", "omni", "car"]
Localization = Literal["gps", "odom"]
Quartet = tuple[float, float, float, float]
"""x, y, z [m or m/s] and yaw [rad or rad/s]."""
Range = tuple[float, float]

_BOUNDS = ((-1.0, 1.0), (-1.0, 1.0), (-1.0, 1.0), (-math.pi / 2, math.pi / 2))


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StagePosition:
    """``position``: a base that drives.

    Attributes:
        drive: Type of drive.
        velocity: At the start, x, y, z [m/s] and yaw [rad/s].
        localization: Whether it reports where it is, or where its odometry puts it.
        localization_origin: Pose that odometry starts from [m, rad]; None: where the robot is.
        odom_error: Share by which odometry errs in x, y, z and yaw; None: each robot draws one.
        wheelbase: Of a car [m].
        velocity_bounds: (least, greatest) along x, y, z [m/s] and about yaw [rad/s] of the body,
            also of a car.
        acceleration_bounds: Likewise [m/s², rad/s²]; they hold when it is driven by
            accelerations.
    """

    drive: Drive = "diff"
    velocity: Quartet = (0.0, 0.0, 0.0, 0.0)
    localization: Localization = "gps"
    localization_origin: Quartet | None = None
    odom_error: Quartet | None = None
    wheelbase: float = 1.0
    velocity_bounds: tuple[Range, Range, Range, Range] = _BOUNDS
    acceleration_bounds: tuple[Range, Range, Range, Range] = _BOUNDS


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageSensor:
    """``sensor``: one fan of rays of a ranger.

    Attributes:
        pose: In the ranger's frame; its rays are half the size's z higher.
        size: Of the transducer [m].
        range: Nearest and farthest distance [m].
        fov: Angle from the first to the last ray [rad].
        samples: Rays.
        noise: Variance of the distance [m²], largest share of the distance, and standard
            deviation of the angle [rad].
        color: Of the rays.
    """

    pose: Quartet = (0.0, 0.0, 0.0, 0.0)
    size: tuple[float, float, float] = (0.02, 0.02, 0.02)
    range: Range = (0.0, 5.0)
    fov: float = 0.1
    samples: int = 1
    noise: tuple[float, float, float] = (0.0, 0.0, 0.0)
    color: Color | None = None

    @property
    def height(self) -> float:
        """Height of its rays in the ranger's frame [m]."""
        return self.pose[2] + self.size[2] / 2.0


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageRanger:
    """``ranger``: sonars, infrared sensors and laser scanners."""

    sensors: tuple[StageSensor, ...] = ()


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageCamera:
    """``camera``: colours and depths.

    Attributes:
        resolution: Columns and rows [pixel].
        range: Nearest and farthest depth [m].
        fov: Horizontal and vertical field of view [rad].
        pantilt: Pan to the right and tilt down of the optical axis [rad].
    """

    resolution: tuple[int, int] = (32, 32)
    range: Range = (0.2, 8.0)
    fov: tuple[float, float] = (math.radians(70.0), math.radians(40.0))
    pantilt: tuple[float, float] = (0.0, 0.0)


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageBlobfinder:
    """``blobfinder``: patches of colour.

    Attributes:
        colors: Those it looks for; empty for all.
        image: Columns and rows [pixel].
        range: [m].
        fov: Horizontal field of view [rad].
        pan: Yaw of its axis [rad].
    """

    colors: tuple[Color, ...] = ()
    image: tuple[int, int] = (80, 60)
    range: float = 12.0
    fov: float = math.radians(60.0)
    pan: float = 0.0


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageFiducial:
    """``fiducial``: finds models that have a ``fiducial_return``.

    Attributes:
        range: Nearest and farthest distance at which it sees one [m]; Stage 4.3 reads the
            nearest, and sees nearer ones too.
        range_id: Distance up to which it can read the number [m].
        fov: [rad].
        ignore_height: Whether it sees models lower or higher than itself too.
    """

    range: Range = (0.0, 8.0)
    range_id: float = 5.0
    fov: float = math.pi
    ignore_height: bool = False


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageBumper:
    """``bumper``: (pose [m, rad], length [m]) of each strip."""

    strips: tuple[tuple[Quartet, float], ...] = ()


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageGripper:
    """``gripper``: paddles that open, close, go up and down.

    Attributes:
        paddle_size: Shares of the body's size.
        paddles: At the start.
        lift: At the start.
        autosnatch: Whether it closes when something is between the paddles.
    """

    paddle_size: tuple[float, float, float] = (0.66, 0.1, 0.4)
    paddles: Literal["open", "closed"] = "open"
    lift: Literal["up", "down"] = "down"
    autosnatch: bool = False


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageActuator:
    """``actuator``: a joint that moves what is mounted on it.

    Attributes:
        type: Along or about its axis.
        axis: Direction; of a rotational one always z.
        range: Least and greatest position [m or rad].
        start: Position at the start [m or rad].
        max_speed: [m/s or rad/s].
    """

    type: Literal["linear", "rotational"] = "linear"
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    range: Range = (0.0, 1.0)
    start: float = 0.0
    max_speed: float = 1.0

    @property
    def offset(self) -> Quartet:
        """Offset of the start from the pose, in the frame of the pose."""
        if self.type == "rotational":
            return (0.0, 0.0, 0.0, self.start)
        length = math.hypot(*self.axis)
        x, y, z = (part * self.start / length if length else 0.0 for part in self.axis)
        return (x, y, z, 0.0)


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageBlinkenlight:
    """``blinkenlight``: a light that blinks.

    Attributes:
        period: [s].
        duty_cycle: Share of the period in which it shines.
        enabled: Whether it blinks at all.
    """

    period: float = 0.25
    duty_cycle: float = 1.0
    enabled: bool = True


@dataclass(frozen=True, slots=True)
class StageLightIndicator:
    """``lightindicator``: a lamp that programs turn on and off."""


StageDevice = (
    StagePosition
    | StageRanger
    | StageCamera
    | StageBlobfinder
    | StageFiducial
    | StageBumper
    | StageGripper
    | StageActuator
    | StageBlinkenlight
    | StageLightIndicator
)
