"""One small reader for each type of model that Stage has, in the table ``KINDS``."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gazelle.description.material import Color
from gazelle.stage.description.devices import (
    Quartet,
    StageActuator,
    StageBlinkenlight,
    StageBlobfinder,
    StageBumper,
    StageCamera,
    StageDevice,
    StageFiducial,
    StageGripper,
    StageLightIndicator,
    StagePosition,
    StageRanger,
    StageSensor,
)
from gazelle.stage.description.models import StageSize
from gazelle.stage.format.colors import color_of
from gazelle.stage.format.entity import Entity
from gazelle.stage.format.properties import Properties, items_of

MAX_SAMPLES = 1_000_000
MAX_STRIPS = 10_000
_ORIGIN: Quartet = (0.0, 0.0, 0.0, 0.0)
_NO_LENGTH = StageSize(0.0, 0.0, 0.0)
_USUAL_SIZE = StageSize()


def read_position(properties: Properties) -> StagePosition:
    """Read ``position``."""
    default = StagePosition()
    properties.note("odom", "'odom' is no longer used", "say 'localization_origin'")
    drive = properties.choice("drive", ("diff", "omni", "car"), "diff")
    localization = properties.choice("localization", ("gps", "odom"), "gps")
    origin, error = properties.get("localization_origin"), properties.get("odom_error")
    return StagePosition(
        drive="omni" if drive == "omni" else "car" if drive == "car" else "diff",
        velocity=read_pose_tuple(properties, "velocity", _ORIGIN),
        localization="odom" if localization == "odom" else "gps",
        localization_origin=(
            None if origin is None else read_pose_tuple(properties, "localization_origin", _ORIGIN)
        ),
        odom_error=None if error is None else read_pose_tuple(properties, "odom_error", _ORIGIN),
        wheelbase=_positive(properties, "wheelbase", default.wheelbase),
        velocity_bounds=_bounds(properties, "velocity_bounds", default.velocity_bounds),
        acceleration_bounds=_bounds(properties, "acceleration_bounds", default.acceleration_bounds),
    )


def read_pose_tuple(properties: Properties, name: str, default: Quartet) -> Quartet:
    """Return x, y, z and an angle."""
    x, y, z, yaw = properties.numbers(name, "llla", default)
    return (x, y, z, yaw)


def _positive(properties: Properties, name: str, default: float) -> float:
    value = properties.length(name, default)
    written = properties.get(name)
    if written is not None and value <= 0.0:
        raise written.fail(f"'{name}' must be greater than zero, found {value:g}")
    return value


Bounds = tuple[tuple[float, float], tuple[float, float], tuple[float, float], tuple[float, float]]


def _bounds(properties: Properties, name: str, default: Bounds) -> Bounds:
    flat = tuple(value for pair in default for value in pair)
    x0, x1, y0, y1, z0, z1, a0, a1 = properties.numbers(name, "llllllaa", flat)
    bounds = ((x0, x1), (y0, y1), (z0, z1), (a0, a1))
    written = properties.get(name)
    if written is not None and any(low > high for low, high in bounds):
        raise written.fail(
            f"in '{name}' a least value is greater than the greatest: {written.token.text}"
        )
    return bounds


def read_ranger(properties: Properties) -> StageRanger:
    """Read ``ranger`` with its ``sensor`` parts."""
    parts = [part for part in properties.entity.parts if part.type == "sensor"]
    return StageRanger(tuple(read_sensor(part, properties) for part in parts))


def read_sensor(entity: Entity, outer: Properties) -> StageSensor:
    """Read ``sensor``."""
    properties = Properties(entity, outer.reading, outer.units)
    default = StageSensor()
    size = properties.size("size", StageSize(*default.size))
    constant, share, angle = _noise(properties, default.noise)
    color = properties.color()
    for name in ("range_min", "range_max", "view"):
        properties.note(
            name,
            f"'{name}' is not a property in Stage 4 and was ignored",
            "write range [ min max ] and fov",
        )
    sensor = StageSensor(
        pose=read_pose_tuple(properties, "pose", _ORIGIN),
        size=size,
        range=_range(properties, "range", default.range),
        fov=properties.angle("fov", default.fov),
        samples=_samples(properties, default.samples),
        noise=(constant, share, angle),
        color=None if isinstance(color, str) else color,
    )
    properties.report_unknown()
    return sensor


def _range(properties: Properties, name: str, default: tuple[float, float]) -> tuple[float, float]:
    low, high = properties.numbers(name, "ll", default)
    written = properties.get(name)
    if written is not None and not 0.0 <= low <= high:
        raise written.fail(f"'{name}' must be [ nearest farthest ], found {written.token.text}")
    return low, high


def _noise(properties: Properties, default: tuple[float, ...]) -> tuple[float, ...]:
    values, written = properties.numbers("noise", "lfa", default), properties.get("noise")
    if written is not None and values[0] < 0.0:
        raise written.fail("the first number of 'noise' is a variance, which is never negative")
    return values


def _samples(properties: Properties, default: int) -> int:
    value = properties.whole("samples", default, least=1)
    written = properties.get("samples")
    if written is not None and value > MAX_SAMPLES:
        raise written.fail(f"more than {MAX_SAMPLES} samples")
    return value


def read_laser(properties: Properties) -> StageRanger:
    """Read ``laser`` of Stage 3, which is a ranger with one sensor now."""
    low, high = properties.length("range_min", 0.0), properties.length("range_max", 8.0)
    fov = properties.angle("fov", math.pi)
    properties.reading.remark(
        "'laser' is a model of Stage 3, and read as a ranger",
        properties.entity.source,
        "write a ranger with sensor( range [ min max ] fov ... samples ... )",
    )
    return StageRanger(
        (StageSensor(range=(low, high), fov=fov, samples=_samples(properties, 180)),)
    )


def read_camera(properties: Properties) -> StageCamera:
    """Read ``camera``; its angles are in degrees whatever the file's unit."""
    default = StageCamera()
    columns, rows = properties.numbers("resolution", "ff", default.resolution)
    fov = properties.numbers("fov", "dd", default.fov)
    pan, tilt = properties.numbers("pantilt", "dd", default.pantilt)
    written = properties.get("resolution")
    if written is not None and not (1 <= columns <= 10_000 and 1 <= rows <= 10_000):
        raise written.fail(f"'resolution' must be 1 to 10000 pixels, found {written.token.text}")
    return StageCamera(
        resolution=(int(columns), int(rows)),
        range=_range(properties, "range", default.range),
        fov=(fov[0], fov[1]),
        pantilt=(pan, tilt),
    )


def read_blobfinder(properties: Properties) -> StageBlobfinder:
    """Read ``blobfinder``."""
    default = StageBlobfinder()
    columns, rows = properties.numbers("image", "ff", default.image)
    return StageBlobfinder(
        colors=_blob_colors(properties),
        image=(max(int(columns), 1), max(int(rows), 1)),
        range=properties.number("range", default.range),  # in metres, whatever the unit of lengths
        fov=properties.angle("fov", default.fov),
        pan=properties.angle("pan", default.pan),
    )


def _blob_colors(properties: Properties) -> tuple[Color, ...]:
    count, written = properties.whole("colors_count", 0, least=0), properties.get("colors")
    if written is None:
        return ()
    names = items_of(written, written.value)
    if len(names) != count:
        properties.reading.remark(
            f"'colors_count' is {count}, and 'colors' has {len(names)}", written.source
        )
    found = [color_of(str(name)) for name in names[:count]]
    if None in found:
        properties.reading.remark("'colors' names an unknown X11 color", written.source)
    return tuple(color for color in found if color is not None)


def read_fiducial(properties: Properties) -> StageFiducial:
    """Read ``fiducial``."""
    default = StageFiducial()
    return StageFiducial(
        range=(
            properties.length("range_min", default.range[0]),
            properties.length("range_max", default.range[1]),
        ),
        range_id=properties.length("range_max_id", default.range_id),
        fov=properties.angle("fov", default.fov),
        ignore_height=properties.flag("ignore_zloc", default=default.ignore_height),
    )


def read_bumper(properties: Properties) -> StageBumper:
    """Read ``bumper``."""
    count = properties.whole("bcount", 0, least=0)
    common = properties.length("blength", 0.0)
    properties.matching("bpose["), properties.matching("blength[")
    return StageBumper(
        tuple(
            (
                read_pose_tuple(properties, f"bpose[{i}]", _ORIGIN),
                properties.length(f"blength[{i}]", common),
            )
            for i in range(min(count, MAX_STRIPS))
        )
    )


def read_gripper(properties: Properties) -> StageGripper:
    """Read ``gripper``."""
    default = StageGripper()
    x, y, z = properties.numbers("paddle_size", "lll", default.paddle_size)
    paddles, lift = "open", "down"
    written = properties.get("paddle_state")
    if written is not None:
        items = items_of(written, written.value)
        first = items[0] if items else None
        second = items[1] if len(items) > 1 else None
        if first not in {"open", "closed"} or second not in {"up", "down"}:
            raise written.fail(
                f'\'paddle_state\' must be like [ "open" "down" ], found {written.token.text}'
            )
        paddles, lift = str(first), str(second)
    return StageGripper(
        paddle_size=(x, y, z),
        paddles="closed" if paddles == "closed" else "open",
        lift="up" if lift == "up" else "down",
        autosnatch=properties.flag("autosnatch", default=default.autosnatch),
    )


def read_actuator(properties: Properties) -> StageActuator:
    """Read ``actuator``; its positions have no unit in Stage, so they are metres or radians."""
    default = StageActuator()
    kind = properties.choice("type", ("linear", "rotational"), default.type)
    x, y, z = properties.numbers("axis", "fff", default.axis)
    return StageActuator(
        type="rotational" if kind == "rotational" else "linear",
        axis=(x, y, z),
        range=(
            properties.number("min_position", default.range[0]),
            properties.number("max_position", default.range[1]),
        ),
        start=properties.number("start_position", default.start),
        max_speed=properties.number("max_speed", default.max_speed),
    )


def read_blinkenlight(properties: Properties) -> StageBlinkenlight:
    """Read ``blinkenlight``."""
    default = StageBlinkenlight()
    return StageBlinkenlight(
        period=properties.number("period", default.period * 1000.0) / 1000.0,
        duty_cycle=properties.number("dutycycle", default.duty_cycle),
        enabled=properties.flag("enabled", default=default.enabled),
    )


def read_light_indicator(_: Properties) -> StageLightIndicator:
    """Read ``lightindicator``, which has no properties of its own."""
    return StageLightIndicator()


@dataclass(frozen=True, slots=True)
class ModelType:
    """A type of model.

    Attributes:
        read: Its own properties; None if it has none.
        size: Of its body where the file says none.
        solid: Whether it has a body by default.
        color: Colour where the file has none.
    """

    read: Callable[[Properties], StageDevice] | None = None
    size: StageSize = _USUAL_SIZE
    solid: bool = True
    color: Color = (1.0, 0.0, 0.0, 1.0)


_RANGER_SIZE = StageSize(0.15, 0.15, 0.2)
_BLUE = (0.0, 0.0, 0.5, 1.0)

KINDS: dict[str, ModelType] = {
    "actuator": ModelType(read_actuator),
    "blinkenlight": ModelType(
        read_blinkenlight, StageSize(0.02, 0.02, 0.02), color=(0.0, 1.0, 0.0, 1.0)
    ),
    "blobfinder": ModelType(read_blobfinder, solid=False),
    "bumper": ModelType(read_bumper),
    "camera": ModelType(read_camera, StageSize(0.1, 0.07, 0.05), color=(0.0, 0.0, 0.0, 1.0)),
    "fiducial": ModelType(read_fiducial, _NO_LENGTH, solid=False),
    "gripper": ModelType(read_gripper, StageSize(0.2, 0.3, 0.2), color=(0.3, 0.3, 0.3, 1.0)),
    "laser": ModelType(read_laser, _RANGER_SIZE, solid=False, color=_BLUE),
    "lightindicator": ModelType(read_light_indicator),
    "model": ModelType(),
    "position": ModelType(read_position),
    "ranger": ModelType(read_ranger, _RANGER_SIZE, solid=False, color=_BLUE),
}
