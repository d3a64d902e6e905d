"""Conversions of the readings of sensor plugins to ROS messages, registered on import."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.bridges import scan_conversions  # noqa: F401  it teaches the common ones
from gazelle.bridges.conversions import (
    ConversionContext,
    Decoder,
    Encoder,
    ServiceCodec,
    add_decoder,
    add_encoder,
    add_service,
    encoder_of,
    point,
    quaternion,
    set_header,
    set_plain_header,
    set_point,
)
from gazelle.rotations import yaw_of
from gazelle.sensors import ImuReading
from gazelle.simulation.values import (
    AltimeterValue,
    Bias,
    BumperValue,
    ChannelPoints,
    CliffValue,
    Fix,
    GeoReference,
    KobukiCore,
    LaserPoints,
    MagneticValue,
    MotorPower,
    PointValue,
    RangeValue,
    SonarValue,
    Transform,
    Transforms,
    Trigger,
    UnsureImu,
    VectorValue,
)
from gazelle_ros.msgs import (
    geometry_msgs,
    hector_gazebo_plugins,
    hector_uav_msgs,
    kobuki_msgs,
    sensor_msgs,
    tf2_msgs,
)

# Velodyne's layout: name, offset, type as sensor_msgs/PointField counts, type here.
_FIELDS = (
    ("x", 0, 7, "<f4"),
    ("y", 4, 7, "<f4"),
    ("z", 8, 7, "<f4"),
    ("intensity", 12, 7, "<f4"),
    ("ring", 16, 4, "<u2"),
    ("time", 18, 7, "<f4"),
)
# Of a Kobuki's messages: a turn of an encoder by a tick, where counters wrap, and 16.5 V in 0.1 V.
_TICK_RAD = 0.002436916871363930
_WORD = 1 << 16
_FULL_BATTERY = 165
_POINT = np.dtype([(name, kind) for name, _, _, kind in _FIELDS])


def _point_cloud2(
    message: sensor_msgs.msg.PointCloud2, value: LaserPoints, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    kept = value.kept[view.world]
    points = value.points[view.world][kept]
    packed = np.zeros(len(points), _POINT)
    packed["x"], packed["y"], packed["z"] = points.T
    packed["intensity"], packed["ring"] = value.intensities[kept], value.rings[kept]
    field = sensor_msgs.msg.PointField
    message.fields = [field(name, offset, kind, 1) for name, offset, kind, _ in _FIELDS]
    message.height, message.width = 1, len(points)
    message.point_step, message.row_step = _POINT.itemsize, _POINT.itemsize * len(points)
    message.is_bigendian, message.is_dense = False, True
    message.data = packed.tobytes()


def _point_cloud(
    message: sensor_msgs.msg.PointCloud, value: ChannelPoints, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    kept = value.kept[view.world]
    place = geometry_msgs.msg.Point32
    message.points = [place(*xyz) for xyz in value.points[view.world][kept].tolist()]
    channel = sensor_msgs.msg.ChannelFloat32
    message.channels = [channel("intensities", value.intensities[kept].tolist())]


def _unsure_imu(message: sensor_msgs.msg.Imu, value: UnsureImu, view: ConversionContext) -> None:
    encoder_of(ImuReading).fill(message, value.reading, view)
    message.orientation_covariance = _three(value.orientation_variance)
    message.angular_velocity_covariance = _three(value.rate_variance)
    message.linear_acceleration_covariance = _three(value.acceleration_variance)


def _three(variance: Any) -> list[float]:
    return [float(x) for x in np.diag(variance).ravel()]


def _fix(message: sensor_msgs.msg.NavSatFix, value: Fix, view: ConversionContext) -> None:
    set_plain_header(message, view, value.stamp)
    message.status.status, message.status.service = value.status, value.service
    message.latitude = float(value.latitude[view.world])
    message.longitude = float(value.longitude[view.world])
    message.altitude = float(value.altitude[view.world])
    message.position_covariance = _three(value.variance)
    message.position_covariance_type = 2  # only the diagonal is known


def _vector(
    message: geometry_msgs.msg.Vector3Stamped, value: VectorValue, view: ConversionContext
) -> None:
    set_plain_header(message, view, value.stamp)
    set_point(message.vector, value.values[view.world])


def _magnetic(
    message: sensor_msgs.msg.MagneticField, value: MagneticValue, view: ConversionContext
) -> None:
    set_plain_header(message, view, value.stamp)
    set_point(message.magnetic_field, value.values[view.world])


def _place(
    message: geometry_msgs.msg.PointStamped, value: PointValue, view: ConversionContext
) -> None:
    set_plain_header(message, view, value.stamp)
    set_point(message.point, value.values[view.world])


def _altimeter(
    message: hector_uav_msgs.msg.Altimeter, value: AltimeterValue, view: ConversionContext
) -> None:
    set_plain_header(message, view, value.stamp)
    message.altitude = float(value.altitude[view.world])
    message.pressure = float(value.pressure[view.world])
    message.qnh = value.sea_level


def _sonar(message: sensor_msgs.msg.Range, value: SonarValue, view: ConversionContext) -> None:
    encoder_of(RangeValue).fill(message, value, view)
    set_plain_header(message, view, value.stamp)


def _reference(request: hector_gazebo_plugins.srv.SetReferenceGeoPoseRequest) -> GeoReference:
    position = request.geo_pose.position
    turn = np.asarray(quaternion(request.geo_pose.orientation))
    # A yaw counts from east to north, a heading from north to east.
    heading = math.pi / 2.0 - float(yaw_of(turn[None])[0])
    return GeoReference(position.latitude, position.longitude, position.altitude, heading)


add_encoder(LaserPoints, Encoder("sensor_msgs/PointCloud2", _point_cloud2))
add_encoder(ChannelPoints, Encoder("sensor_msgs/PointCloud", _point_cloud))
add_encoder(UnsureImu, Encoder("sensor_msgs/Imu", _unsure_imu))
add_encoder(Fix, Encoder("sensor_msgs/NavSatFix", _fix))
add_encoder(VectorValue, Encoder("geometry_msgs/Vector3Stamped", _vector))
add_encoder(MagneticValue, Encoder("sensor_msgs/MagneticField", _magnetic))
add_encoder(PointValue, Encoder("geometry_msgs/PointStamped", _place))
add_encoder(AltimeterValue, Encoder("hector_uav_msgs/Altimeter", _altimeter))
add_encoder(SonarValue, Encoder("sensor_msgs/Range", _sonar))
add_service(
    Bias,
    None,
    ServiceCodec("hector_gazebo_plugins/SetBias", lambda r: Bias(point(r.bias)), lambda _: {}),
)
add_service(
    GeoReference,
    None,
    ServiceCodec("hector_gazebo_plugins/SetReferenceGeoPose", _reference, lambda _: {}),
)


def _cliff(message: kobuki_msgs.msg.CliffEvent, value: CliffValue, view: ConversionContext) -> None:
    message.sensor, message.state = value.place, int(value.deep[view.world])
    message.bottom = int(value.reading[view.world])


def _bump(
    message: kobuki_msgs.msg.BumperEvent, value: BumperValue, view: ConversionContext
) -> None:
    message.bumper, message.state = value.place, int(value.pressed[view.world])


def _core(message: kobuki_msgs.msg.SensorState, value: KobukiCore, view: ConversionContext) -> None:
    set_plain_header(message, view, value.stamp)
    message.time_stamp = value.stamp // 1_000_000 % _WORD
    message.bumper, message.cliff = _bits(value.pressed[view.world]), _bits(value.deep[view.world])
    ticks = (value.angles[view.world] // _TICK_RAD).astype(np.int64) % _WORD
    message.left_encoder, message.right_encoder = ticks.tolist()
    message.bottom = value.floor[view.world, ::-1].astype(np.int64).tolist()
    message.charger, message.battery = kobuki_msgs.msg.SensorState.DISCHARGING, _FULL_BATTERY
    message.current, message.analog_input = bytes(2), [0] * 4


def _bits(flags: NDArray[np.bool_]) -> int:
    """Return flags as bits, the last one lowest."""
    return int(flags @ (4, 2, 1))


add_encoder(KobukiCore, Encoder("kobuki_msgs/SensorState", _core))
add_encoder(CliffValue, Encoder("kobuki_msgs/CliffEvent", _cliff))
add_encoder(BumperValue, Encoder("kobuki_msgs/BumperEvent", _bump))
add_decoder(MotorPower, Decoder("kobuki_msgs/MotorPower", lambda m: MotorPower(bool(m.state))))
add_decoder(Trigger, Decoder("std_msgs/Empty", lambda _message: Trigger()))


def _read_transforms(message: tf2_msgs.msg.TFMessage) -> Transforms:
    """Convert transforms; of different stamps in one message the latest counts."""
    frames = tuple(
        Transform(
            each.header.frame_id,
            each.child_frame_id,
            np.array([point(each.transform.translation)]),
            np.array([quaternion(each.transform.rotation)]),
        )
        for each in message.transforms
    )
    stamps = [each.header.stamp.to_nsec() for each in message.transforms]
    return Transforms(max(stamps, default=0), frames)


add_decoder(Transforms, Decoder("tf2_msgs/TFMessage", _read_transforms))
