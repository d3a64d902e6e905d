"""Sensor blocks: camera, depth camera, lidar, IMU, GPS, contact.

Each is made as the ``<sensor>`` element that a file would hold, and read as the readers do:
what a sensor built here means and what a written one means cannot differ.
"""

from __future__ import annotations

import math

from gazelle.argument_checks import checked
from gazelle.builders.elements import element, group
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.solids import ORIGIN
from gazelle.description import Parameters, Plugin, Pose, Sensor
from gazelle.formats.sdf.plugin import read_plugin
from gazelle.formats.sdf.pose import read_pose
from gazelle.formats.sdf.sensor import QUANTIZE, read_sensor


@checked(BuildError)
def camera(
    name: str = "camera",
    *,
    pose: Pose = ORIGIN,
    update_rate: float = 30.0,
    width: int = 640,
    height: int = 480,
    horizontal_fov: float = math.radians(60.0),
    near: float = 0.05,
    far: float = 100.0,
    noise: float = 0.0,
    topic: str = "",
    frame: str = "",
) -> Sensor:
    """Return a colour camera, which looks along its x axis.

    Args:
        name: Unique in its link.
        pose: In the frame of its link.
        update_rate: Pictures a second [Hz].
        width: [pixel].
        height: [pixel].
        horizontal_fov: [rad].
        near: Nearest distance seen [m].
        far: Farthest distance seen [m].
        noise: Standard deviation on each pixel value of 0 to 1.
        topic: ROS name under which Gazebo's camera plugin publishes; empty for no plugin.
        frame: ROS frame of the pictures; empty for the sensor's name.

    Raises:
        BuildError: A figure makes no sense.
    """
    block = _camera(width, height, horizontal_fov, near, far, noise, "R8G8B8")
    plugin = _camera_plugin("libgazebo_ros_camera.so", name, topic, frame, update_rate)
    return _sensor(name, "camera", pose, update_rate, block, plugin if topic else None)


@checked(BuildError)
def depth_camera(
    name: str = "depth_camera",
    *,
    pose: Pose = ORIGIN,
    update_rate: float = 15.0,
    width: int = 640,
    height: int = 480,
    horizontal_fov: float = math.radians(60.0),
    near: float = 0.3,
    far: float = 8.0,
    noise: float = 0.0,
    topic: str = "",
    frame: str = "",
) -> Sensor:
    """Return a camera that also measures depth; arguments are those of ``camera``.

    Raises:
        BuildError: A figure makes no sense.
    """
    block = _camera(width, height, horizontal_fov, near, far, noise, "R8G8B8")
    plugin = _camera_plugin(
        "libgazebo_ros_openni_kinect.so",
        name,
        topic,
        frame,
        update_rate,
        pointCloudCutoff=near,
        pointCloudCutoffMax=far,
    )
    return _sensor(name, "depth", pose, update_rate, block, plugin if topic else None)


@checked(BuildError)
def lidar(
    name: str = "lidar",
    *,
    pose: Pose = ORIGIN,
    update_rate: float = 10.0,
    samples: int = 360,
    min_angle: float = -math.pi,
    max_angle: float = math.pi,
    rows: int = 1,
    min_elevation: float = 0.0,
    max_elevation: float = 0.0,
    range_min: float = 0.12,
    range_max: float = 10.0,
    resolution: float = 0.0,
    quantized: bool = False,
    noise: float = 0.0,
    topic: str = "",
    frame: str = "",
) -> Sensor:
    """Return a laser range finder: planar, or with several ``rows`` of rays.

    Args:
        name: Unique in its link.
        pose: In the frame of its link.
        update_rate: Scans a second [Hz].
        samples: Rays a row.
        min_angle: Of the first ray, counter-clockwise from x [rad].
        max_angle: Of the last ray [rad].
        rows: Rows of rays.
        min_elevation: Of the lowest row [rad].
        max_elevation: Of the highest row [rad].
        range_min: Nearest distance measured [m].
        range_max: Farthest distance measured [m].
        resolution: Step of the measured distance [m]; 0 for none.
        quantized: Whether distances are rounded to it, which Gazebo classic does not do.
        noise: Standard deviation of the distance [m].
        topic: ROS topic on which Gazebo's laser plugin publishes; empty for no plugin.
        frame: ROS frame of the scans; empty for the sensor's name.

    Raises:
        BuildError: A figure makes no sense.
    """
    _whole(samples, "the number of samples")
    _whole(rows, "the number of rows")
    _grows(range_min, range_max, "the range")
    _grows(min_angle, max_angle, "the angle", strict=samples > 1)
    _grows(min_elevation, max_elevation, "the elevation", strict=rows > 1)
    horizontal = _fan("horizontal", samples, min_angle, max_angle)
    vertical = _fan("vertical", rows, min_elevation, max_elevation) if rows > 1 else None
    block = group(
        "ray",
        scan=group("scan", horizontal=horizontal, vertical=vertical),
        range=group(
            "range",
            min=range_min,
            max=range_max,
            resolution=resolution or None,
            **{QUANTIZE: True if quantized else None},
        ),
        noise=_noise(noise) if noise else None,
    )
    plugin = _plugin(
        f"{name}_publisher", "libgazebo_ros_laser.so", topicName=topic, frameName=frame or name
    )
    return _sensor(name, "ray", pose, update_rate, block, plugin if topic else None)


@checked(BuildError)
def imu(
    name: str = "imu",
    *,
    pose: Pose = ORIGIN,
    update_rate: float = 100.0,
    rate_noise: float = 0.0,
    accel_noise: float = 0.0,
    rate_bias: float = 0.0,
    accel_bias: float = 0.0,
    topic: str = "",
    frame: str = "",
) -> Sensor:
    """Return an inertial measurement unit.

    Args:
        name: Unique in its link.
        pose: In the frame of its link.
        update_rate: [Hz].
        rate_noise: Standard deviation of angular rates [rad/s].
        accel_noise: Standard deviation of accelerations [m/s²].
        rate_bias: Standard deviation of their constant bias, drawn once a run [rad/s].
        accel_bias: Standard deviation of their constant bias, drawn once a run [m/s²].
        topic: ROS topic on which Gazebo's IMU plugin publishes; empty for no plugin.
        frame: ROS frame of the readings; empty for the sensor's name.

    Raises:
        BuildError: A figure makes no sense.
    """
    block = group(
        "imu",
        angular_velocity=_axes("angular_velocity", rate_noise, rate_bias),
        linear_acceleration=_axes("linear_acceleration", accel_noise, accel_bias),
    )
    plugin = _plugin(
        f"{name}_publisher",
        "libgazebo_ros_imu_sensor.so",
        topicName=topic,
        frameName=frame or name,
        updateRateHZ=update_rate,
    )
    return _sensor(name, "imu", pose, update_rate, block, plugin if topic else None)


@checked(BuildError)
def gps(
    name: str = "gps",
    *,
    pose: Pose = ORIGIN,
    update_rate: float = 5.0,
    horizontal_noise: float = 0.0,
    vertical_noise: float = 0.0,
    velocity_noise: float = 0.0,
) -> Sensor:
    """Return a satellite receiver; the world needs ``spherical_coordinates``.

    Args:
        name: Unique in its link.
        pose: In the frame of its link.
        update_rate: Fixes a second [Hz].
        horizontal_noise: Standard deviation along east and north [m].
        vertical_noise: Standard deviation of the altitude [m].
        velocity_noise: Standard deviation of each velocity [m/s].

    Raises:
        BuildError: A figure makes no sense.
    """
    block = group(
        "gps",
        position_sensing=_sensing("position_sensing", horizontal_noise, vertical_noise),
        velocity_sensing=_sensing("velocity_sensing", velocity_noise, velocity_noise),
    )
    return _sensor(name, "gps", pose, update_rate, block, None)


@checked(BuildError)
def contact_sensor(collision: str, name: str = "contact", *, update_rate: float = 50.0) -> Sensor:
    """Return a sensor of what touches one collision of its link.

    Raises:
        BuildError: The rate is not positive, or the collision has no name.
    """
    if not collision:
        raise BuildError("a contact sensor needs the name of a collision")
    block = group("contact", collision=collision)
    return _sensor(name, "contact", ORIGIN, update_rate, block, None)


def _sensor(
    name: str,
    kind: str,
    pose: Pose,
    update_rate: float,
    block: Parameters,
    plugin: Parameters | None,
) -> Sensor:
    if not name:
        raise BuildError("a sensor needs a name")
    positive(update_rate, f"the update rate of '{name}'")
    children = (
        element("pose", pose),
        element("update_rate", update_rate),
        element("always_on", value=True),
        block,
        *(() if plugin is None else (plugin,)),
    )
    node = element("sensor", None, *children, attributes={"name": name, "type": kind})
    return read_sensor(node, lambda part: read_pose(part.find("pose")))


def _camera(
    width: int, height: int, fov: float, near: float, far: float, noise: float, pixels: str
) -> Parameters:
    _whole(width, "the width")
    _whole(height, "the height")
    _grows(near, far, "the distance")
    if not 0.0 < fov < math.pi:
        raise BuildError(f"the field of view must be between 0 and pi, found {fov:g} rad")
    return group(
        "camera",
        horizontal_fov=fov,
        image=group("image", width=width, height=height, format=pixels),
        clip=group("clip", near=near, far=far),
        noise=_noise(noise) if noise else None,
    )


def _fan(tag: str, samples: int, low: float, high: float) -> Parameters:
    return group(tag, samples=samples, resolution=1, min_angle=low, max_angle=high)


def _noise(stddev: float, bias: float = 0.0) -> Parameters:
    """Return white noise; its type is an attribute and an element, for old and new readers."""
    for value in (stddev, bias):
        if not 0.0 <= value < math.inf:
            raise BuildError(f"a standard deviation must not be negative, found {value:g}")
    children = [element("mean", 0.0), element("stddev", stddev)]
    if bias:
        children += [element("bias_mean", 0.0), element("bias_stddev", bias)]
    return element("noise", None, *children, attributes={"type": "gaussian"})


def _axes(tag: str, stddev: float, bias: float) -> Parameters | None:
    if not stddev and not bias:
        return None
    return group(tag, **{axis: group(axis, noise=_noise(stddev, bias)) for axis in "xyz"})


def _sensing(tag: str, horizontal: float, vertical: float) -> Parameters | None:
    if not horizontal and not vertical:
        return None
    return group(
        tag,
        horizontal=group("horizontal", noise=_noise(horizontal)),
        vertical=group("vertical", noise=_noise(vertical)),
    )


def _plugin(name: str, filename: str, **values: str | float) -> Parameters:
    children = tuple(element(tag, value) for tag, value in values.items())
    return element("plugin", None, *children, attributes={"name": name, "filename": filename})


def _camera_plugin(
    filename: str, name: str, topic: str, frame: str, rate: float, **values: float
) -> Parameters:
    return _plugin(
        f"{name}_publisher",
        filename,
        cameraName=topic,
        imageTopicName="image_raw",
        cameraInfoTopicName="camera_info",
        frameName=frame or name,
        updateRate=rate,
        **values,
    )


@checked(BuildError)
def plugin(name: str, filename: str, **values: str | float | bool) -> Plugin:
    """Return a plugin with one tag a keyword, such as ``leftJoint="left_wheel"``.

    Raises:
        BuildError: A number is not a number.
    """
    return read_plugin(_plugin(name, filename, **values))


def _whole(value: int, what: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise BuildError(f"{what} must be an int above zero, found {value!r}")


def _grows(low: float, high: float, what: str, *, strict: bool = True) -> None:
    negative = what in {"the range", "the distance"} and low < 0.0
    if not math.isfinite(low + high) or negative or high < low or (strict and high == low):
        raise BuildError(f"{what} must grow, found {low:g} to {high:g}")
