"""``<sensor>``: one reader a family of types, in the table ``FAMILIES``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from gazelle.description import ContactSensor, Imu, Lidar, Noise, Parameters, Pose, Scan, Sensor
from gazelle.formats import values
from gazelle.formats.sdf.camera import CAMERA, read_camera
from gazelle.formats.sdf.leftover import Pattern, leftover
from gazelle.formats.sdf.noise import read_noise
from gazelle.formats.sdf.plugin import read_plugins

QUANTIZE = "gazelle:quantize"
"""An element of ``<range>``: whether distances are rounded to ``<resolution>``."""

Placer = Callable[[Parameters], Pose]


def read_sensor(node: Parameters, place: Placer) -> Sensor:
    """Read a sensor with what its type adds.

    Args:
        node: The element.
        place: Gives the pose of a child element in the frame of the link.
    """
    kind = values.attribute(node, "type")
    sensor = Sensor(
        name=values.attribute(node, "name"),
        type=kind,
        pose=place(node),
        update_rate=values.real(node, "update_rate", 0.0),
        always_on=values.flag(node, "always_on", default=False),
        visualize=values.flag(node, "visualize", default=False),
        topic=_topic(node),
        settings=read_settings(node, kind),
        plugins=read_plugins(node),
        source=node.source,
    )
    family = FAMILIES.get(kind)
    return sensor if family is None else family(sensor, node)


def read_settings(node: Parameters, kind: str) -> Parameters:
    """Return the settings of the element that have no field of their own."""
    family = FAMILIES.get(kind)
    pattern = {**_COMMON, **({} if family is None else _PATTERNS[family])}
    settings = _with_lidar_tag(leftover(node, pattern), node, kind)
    cameras = [c for c in node.children if c.tag == "camera"] if "camera" in pattern else []
    if len(cameras) < 2 or settings.find("camera") is None:
        return settings
    # of several cameras all stay, even if nothing is left of one: they go by their order
    kept = (leftover(camera, CAMERA) for camera in cameras)
    others = (child for child in settings.children if child.tag != "camera")
    return replace(settings, children=(*kept, *others))


def lidar_tag(kind: str) -> str:
    """Return the element with the rays of a sensor type: Gazebo Classic's, or the later one."""
    return "lidar" if "lidar" in kind else "ray"


def _with_lidar_tag(settings: Parameters, node: Parameters, kind: str) -> Parameters:
    """Return the settings with an empty element of the rays, if its name is unusual."""
    other = {"lidar": "ray", "ray": "lidar"}[lidar_tag(kind)]
    read = FAMILIES.get(kind) is read_lidar_sensor and other in node
    if not read or lidar_tag(kind) in node or other in settings:
        return settings
    return replace(settings, children=(*settings.children, Parameters(other)))


def _topic(node: Parameters) -> str:
    topic = values.word(node, "topic")
    return "" if topic == "__default__" else topic


def read_lidar_sensor(sensor: Sensor, node: Parameters) -> Sensor:
    """Read types ``ray``, ``gpu_ray``, ``lidar``, ``gpu_lidar``."""
    inner = node.find("ray") or node.find("lidar")
    return sensor if inner is None else replace(sensor, lidar=read_lidar(inner))


def read_lidar(node: Parameters) -> Lidar:
    """Read ``<ray>`` or ``<lidar>``."""
    nearest = values.real(node, "range/min", 0.0)
    farthest = values.limit(node, "range/max", 0.0)
    place = node.find("range") or node
    if nearest < 0.0 or farthest < nearest:
        raise values.fail(place, f"the range must grow from 0, found {nearest:g} to {farthest:g}")
    return Lidar(
        horizontal=read_scan(node.find("scan/horizontal"), 640),
        vertical=read_scan(node.find("scan/vertical"), 1),
        range_min=nearest,
        range_max=farthest,
        range_resolution=values.real(node, "range/resolution", 0.0),
        quantized=values.flag(node, f"range/{QUANTIZE}", default=False),
        noise=read_noise(node.find("noise"), "gaussian"),
    )


def read_scan(node: Parameters | None, samples: int) -> Scan:
    """Read ``<horizontal>`` or ``<vertical>``."""
    if node is None:
        return Scan(samples=samples)
    count = values.whole(node, "samples", samples)
    if count < 0:
        raise values.fail(
            node.find("samples") or node, f"<samples> must not be negative, found {count}"
        )
    return Scan(
        samples=count,
        resolution=values.real(node, "resolution", 1.0),
        min_angle=values.real(node, "min_angle", 0.0),
        max_angle=values.real(node, "max_angle", 0.0),
    )


def read_imu_sensor(sensor: Sensor, node: Parameters) -> Sensor:
    """Read type ``imu``."""
    inner = node.find("imu")
    return replace(sensor, imu=Imu() if inner is None else read_imu(inner))


def read_imu(node: Parameters) -> Imu:
    """Read ``<imu>``."""
    return Imu(
        angular_velocity=_axes(node, "angular_velocity"),
        linear_acceleration=_axes(node, "linear_acceleration"),
        localization=values.word(node, "orientation_reference_frame/localization", "CUSTOM"),
        custom_rpy=values.vector(node, "orientation_reference_frame/custom_rpy", (0.0, 0.0, 0.0)),
        enable_orientation=values.flag(node, "enable_orientation", default=True),
    )


def _axes(node: Parameters, tag: str) -> tuple[Noise, Noise, Noise]:
    x, y, z = (read_noise(node.find(f"{tag}/{axis}/noise")) for axis in "xyz")
    return (x, y, z)


def read_camera_sensor(sensor: Sensor, node: Parameters) -> Sensor:
    """Read types with one or several ``<camera>``."""
    return replace(sensor, cameras=tuple(map(read_camera, node.find_all("camera"))))


def read_contact_sensor(sensor: Sensor, node: Parameters) -> Sensor:
    """Read type ``contact``."""
    inner = node.find("contact")
    if inner is None:
        return sensor
    topic = values.word(inner, "topic")
    return replace(
        sensor,
        contact=ContactSensor(
            collisions=tuple(c.text for c in inner.find_all("collision") if c.text),
            topic="" if topic == "__default_topic__" else topic,
        ),
    )


FAMILIES: dict[str, Callable[[Sensor, Parameters], Sensor]] = {
    "boundingbox_camera": read_camera_sensor,
    "camera": read_camera_sensor,
    "contact": read_contact_sensor,
    "depth": read_camera_sensor,
    "depth_camera": read_camera_sensor,
    "gpu_lidar": read_lidar_sensor,
    "gpu_ray": read_lidar_sensor,
    "imu": read_imu_sensor,
    "lidar": read_lidar_sensor,
    "multicamera": read_camera_sensor,
    "ray": read_lidar_sensor,
    "rgbd_camera": read_camera_sensor,
    "segmentation_camera": read_camera_sensor,
    "thermal": read_camera_sensor,
    "thermal_camera": read_camera_sensor,
    "wide_angle_camera": read_camera_sensor,
    "wideanglecamera": read_camera_sensor,
}

_COMMON: Pattern = dict.fromkeys(
    ("@name", "@type", "always_on", "plugin", "pose", "topic", "update_rate", "visualize")
)
_SCAN: Pattern = dict.fromkeys(("samples", "resolution", "min_angle", "max_angle"))
_LIDAR: Pattern = {
    "scan": {"horizontal": _SCAN, "vertical": _SCAN},
    "range": dict.fromkeys(("min", "max", "resolution", QUANTIZE)),
    "noise": None,
}
_NOISES: Pattern = {axis: {"noise": None} for axis in "xyz"}
_IMU: Pattern = {
    "angular_velocity": _NOISES,
    "linear_acceleration": _NOISES,
    "orientation_reference_frame": dict.fromkeys(("localization", "custom_rpy")),
    "enable_orientation": None,
}
_PATTERNS: dict[Callable[[Sensor, Parameters], Sensor], Pattern] = {
    read_lidar_sensor: {"ray": _LIDAR, "lidar": _LIDAR},
    read_imu_sensor: {"imu": _IMU},
    read_camera_sensor: {"camera": CAMERA},
    read_contact_sensor: {"contact": dict.fromkeys(("collision", "topic"))},
}
