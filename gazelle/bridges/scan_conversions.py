"""Conversions of the values of common sensors to ROS messages, registered on import."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.conversions import (
    ConversionContext,
    Encoder,
    add_encoder,
    point,
    set_header,
    set_plain_header,
    set_point,
    set_quaternion,
)
from gazelle.sensors import ImuReading, LaserScan
from gazelle.simulation.values import RangeValue, Touches
from gazelle_ros.msgs import gazebo_msgs, geometry_msgs, sensor_msgs


def _scan(message: sensor_msgs.msg.LaserScan, value: LaserScan, view: ConversionContext) -> None:
    set_header(message, view, value.stamp)
    message.angle_min, message.angle_max = value.angle_min, value.angle_max
    message.angle_increment = value.angle_increment
    message.range_min, message.range_max = value.range_min, value.range_max
    message.ranges = np.atleast_2d(value.ranges)[view.world].tolist()
    message.intensities = [0.0] * len(message.ranges)


def _imu(message: sensor_msgs.msg.Imu, value: ImuReading, view: ConversionContext) -> None:
    set_plain_header(message, view, value.stamp)
    set_quaternion(message.orientation, value.orientation[view.world])
    set_point(message.angular_velocity, value.angular_velocity[view.world])
    set_point(message.linear_acceleration, value.linear_acceleration[view.world])
    covariance = [value.variance, 0.0, 0.0, 0.0, value.variance, 0.0, 0.0, 0.0, value.variance]
    message.orientation_covariance = covariance
    message.angular_velocity_covariance = covariance
    message.linear_acceleration_covariance = covariance


def _touches(
    message: gazebo_msgs.msg.ContactsState, value: Touches, view: ConversionContext
) -> None:
    """Add one ``ContactState`` for each pair of collisions, as Gazebo groups them."""
    set_header(message, view, value.stamp)
    contacts = value.contacts[view.world]
    pairs: dict[tuple[str, str], Any] = {}
    state = gazebo_msgs.msg.ContactState
    vector = geometry_msgs.msg.Vector3
    for i, pair in enumerate(zip(contacts.collisions, contacts.others, strict=True)):
        one: Any = pairs.get(pair)
        if one is None:
            one = pairs[pair] = state(collision1_name=pair[0], collision2_name=pair[1])
            one.info = f"{pair[0]} touches {pair[1]}"
            message.states.append(one)
        wrench = geometry_msgs.msg.Wrench()
        set_point(wrench.force, contacts.force[i])
        set_point(wrench.torque, contacts.torque[i])
        one.wrenches.append(wrench)
        one.contact_positions.append(vector(*contacts.position[i].tolist()))
        one.contact_normals.append(vector(*contacts.normal[i].tolist()))
        one.depths.append(float(contacts.depth[i]))
        _add(one.total_wrench, contacts.force[i], contacts.torque[i])


def _add(wrench: geometry_msgs.msg.Wrench, force: Floats, torque: Floats) -> None:
    total, turning = point(wrench.force), point(wrench.torque)
    set_point(wrench.force, np.add(total, force))
    set_point(wrench.torque, np.add(turning, torque))


def _range(message: sensor_msgs.msg.Range, value: RangeValue, view: ConversionContext) -> None:
    set_header(message, view, value.stamp)
    message.radiation_type = 0 if value.ultrasound else 1
    message.field_of_view = value.field_of_view
    message.min_range, message.max_range = value.least, value.most
    message.range = float(value.distance[view.world])


add_encoder(LaserScan, Encoder("sensor_msgs/LaserScan", _scan))
add_encoder(ImuReading, Encoder("sensor_msgs/Imu", _imu))
add_encoder(Touches, Encoder("gazebo_msgs/ContactsState", _touches))
add_encoder(RangeValue, Encoder("sensor_msgs/Range", _range))
