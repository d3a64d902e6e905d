"""Writer of ``<sensor>``: the fields of its type, merged into the kept element."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from gazelle.description import (
    Camera,
    ContactSensor,
    Imu,
    Lidar,
    Noise,
    Parameters,
    Scan,
    Sensor,
)
from gazelle.formats.sdf.sensor import QUANTIZE, lidar_tag
from gazelle.formats.write.element import (
    element,
    group,
    inside,
    leaf,
    limit,
    overlay,
    pose_leaf,
)
from gazelle.formats.write.sdf.plugin import write_plugin

_NOISE = (
    "mean", "stddev", "bias_mean", "bias_stddev", "dynamic_bias_stddev",
    "dynamic_bias_correlation_time", "precision",
)  # fmt: skip
_DISTORTION = ("k1", "k2", "k3", "p1", "p2")


def write_sensor(sensor: Sensor) -> Parameters:
    """Write a sensor with all contents of its file."""
    with inside("sensor", sensor):
        own = element(
            "sensor",
            pose_leaf(sensor.pose),
            leaf("always_on", sensor.always_on, False),
            leaf("update_rate", sensor.update_rate, 0.0),
            leaf("visualize", sensor.visualize, False),
            leaf("topic", sensor.topic, ""),
            None if sensor.lidar is None else write_lidar(sensor.lidar, _lidar_tag(sensor)),
            None if sensor.imu is None else write_imu(sensor.imu),
            *map(write_camera, sensor.cameras),
            None if sensor.contact is None else write_contact(sensor.contact),
            *map(write_plugin, sensor.plugins),
            name=sensor.name,
            type=sensor.type,
        )
        return overlay(replace(sensor.settings, tag="sensor"), own)


def _lidar_tag(sensor: Sensor) -> str:
    """Return the element that holds the rays; the one that is kept already, if there is one."""
    for tag in ("ray", "lidar"):
        if tag in sensor.settings:
            return tag
    return lidar_tag(sensor.type)


def write_noise(noise: Noise) -> Parameters | None:
    """Write ``<noise>``; None for none at all."""
    if noise == Noise():
        return None
    return element("noise", *_noise_values(noise), type=noise.type)


def _plain_noise(noise: Noise) -> Parameters | None:
    """Return ``<noise>`` of rays and cameras, where the type is an element, not an attribute."""
    if noise == Noise():
        return None
    return element("noise", leaf("type", noise.type), *_noise_values(noise))


def _noise_values(noise: Noise) -> Iterator[Parameters | None]:
    return (leaf(name, getattr(noise, name), 0.0) for name in _NOISE)


def write_lidar(lidar: Lidar, tag: str) -> Parameters:
    """Write ``<ray>`` or ``<lidar>``."""
    return element(
        tag,
        element(
            "scan",
            write_scan(lidar.horizontal, "horizontal"),
            write_scan(lidar.vertical, "vertical"),
        ),
        element(
            "range",
            leaf("min", lidar.range_min),
            limit("max", lidar.range_max),
            leaf("resolution", lidar.range_resolution, 0.0),
            leaf(QUANTIZE, lidar.quantized, False),
        ),
        _plain_noise(lidar.noise),
    )


def write_scan(scan: Scan, tag: str) -> Parameters:
    """Write ``<horizontal>`` or ``<vertical>``."""
    return element(
        tag,
        leaf("samples", scan.samples),
        leaf("resolution", scan.resolution),
        leaf("min_angle", scan.min_angle),
        leaf("max_angle", scan.max_angle),
    )


def write_imu(imu: Imu) -> Parameters:
    """Write ``<imu>``."""
    return element(
        "imu",
        _axes("angular_velocity", imu.angular_velocity),
        _axes("linear_acceleration", imu.linear_acceleration),
        group(
            "orientation_reference_frame",
            leaf("localization", imu.localization, "CUSTOM"),
            leaf("custom_rpy", imu.custom_rpy, (0.0, 0.0, 0.0)),
        ),
        leaf("enable_orientation", imu.enable_orientation, True),
    )


def _axes(tag: str, noises: tuple[Noise, Noise, Noise]) -> Parameters | None:
    axes = (group(axis, write_noise(noise)) for axis, noise in zip("xyz", noises, strict=True))
    return group(tag, *axes)


def write_camera(camera: Camera) -> Parameters:
    """Write ``<camera>``."""
    depth = group("clip", _optional("near", camera.depth_near), _optional("far", camera.depth_far))
    return element(
        "camera",
        pose_leaf(camera.pose),
        leaf("horizontal_fov", camera.horizontal_fov),
        element(
            "image",
            leaf("width", camera.width),
            leaf("height", camera.height),
            leaf("format", camera.format, "R8G8B8"),
        ),
        element("clip", leaf("near", camera.near), limit("far", camera.far)),
        group("depth_camera", depth),
        _plain_noise(camera.noise),
        _distortion(camera),
        camera.lens,
        name=camera.name,
    )


def _optional(tag: str, value: float | None) -> Parameters | None:
    return None if value is None else limit(tag, value)


def _distortion(camera: Camera) -> Parameters | None:
    named = zip(_DISTORTION, camera.distortion, strict=True)
    return group(
        "distortion",
        *(leaf(tag, value, 0.0) for tag, value in named),
        leaf("center", camera.distortion_center, (0.5, 0.5)),
    )


def write_contact(contact: ContactSensor) -> Parameters:
    """Write ``<contact>``."""
    return element(
        "contact",
        *(leaf("collision", name) for name in contact.collisions),
        leaf("topic", contact.topic, ""),
    )
