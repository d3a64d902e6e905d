"""The node ``navsat_transform_node``: satellite fixes as odometry (http://wiki.ros.org/robot_localization)."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.conversions import (
    point,
    pose_of_message,
    quaternion,
    set_point,
    set_quaternion,
)
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.bridges.navigation.transforms import TransformFinder
from gazelle.description import Pose
from gazelle.errors import Error
from gazelle.navigation.estimation.navsat import (
    EarthGrid,
    GeographicPlace,
    NavsatSettings,
    WorldPlacement,
)
from gazelle.navigation.estimation.utm import UtmZone
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND, Rate
from gazelle_ros.errors import ServiceError
from gazelle_ros.msgs import (
    geometry_msgs,
    nav_msgs,
    robot_localization,
    sensor_msgs,
    tf2_msgs,
)
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_LOG = logging.getLogger(__name__)
_UNIT = np.array((0.0, 0.0, 0.0, 1.0))


def main(arguments: Sequence[str]) -> int:
    """Place fixes until shutdown; returns the exit code."""
    return run_node(arguments, "navsat_transform_node", NavsatTransformNode)


class NavsatTransformNode:
    """Fixes of ``gps/fix`` as odometry in the world of ``odometry/filtered``.

    Args:
        node: On the graph; parameters are those of ``navsat_transform_node``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self.settings = settings = NavsatSettings.read(values)
        self._node, self._lock = node, threading.RLock()
        self._world_frame, self._base, self._gps_frame = "odom", "base_link", ""
        self._world: Pose | None = None
        self._start: GeographicPlace | None = None
        self._attitude: Pose | None = None
        self._by_datum = settings.wait_for_datum
        self._zone: UtmZone | None = None
        self._odometry: nav_msgs.msg.Odometry | None = None
        self._fix: sensor_msgs.msg.NavSatFix | None = None
        self._odometry_is_new = False
        self.placement: WorldPlacement | None = None
        """Of the earth in the world; None until it is known."""
        self.frames = GraphFrames(node)
        self._transforms = TransformFinder(self.frames, settings.transform_timeout)
        self._placed = node.advertise("odometry/gps", nav_msgs.msg.Odometry, queue_size=10)
        self._filtered = None
        if settings.publish_filtered_gps:
            fix = sensor_msgs.msg.NavSatFix
            self._filtered = node.advertise("gps/filtered", fix, queue_size=10)
        self._static = None
        if settings.broadcast_cartesian_transform:
            kind = tf2_msgs.msg.TFMessage
            self._static = node.advertise("/tf_static", kind, queue_size=1, latch=True)
        if settings.datum is not None:
            self._set_datum(*settings.datum)
        self._connect()
        self._diagnosis = StartDiagnosis(node, self._missing)

    def _connect(self) -> None:
        node, srv = self._node, robot_localization.srv
        node.subscribe("odometry/filtered", nav_msgs.msg.Odometry, self._take_odometry, 1)
        node.subscribe("gps/fix", sensor_msgs.msg.NavSatFix, self._take_fix, queue_size=1)
        if not (self.settings.use_odometry_yaw or self.settings.wait_for_datum):
            node.subscribe("imu/data", sensor_msgs.msg.Imu, self._take_imu, queue_size=1)
        node.serve("datum", srv.SetDatum, self._datum)
        node.serve("toLL", srv.ToLL, self._to_earth)
        node.serve("fromLL", srv.FromLL, self._from_earth)
        node.serve("setUTMZone", srv.SetUTMZone, self._set_zone)

    # The cycle ------------------------------------------------------------------------------

    def run(self, stop: threading.Event) -> None:
        """Place fixes at the rate of ``frequency`` until shutdown."""
        self._node.clock.sleep(round(self.settings.delay * SECOND), stop.is_set)
        rate = Rate(self._node.clock, self.settings.frequency, reset=True)
        while not stop.is_set() and not self._node.closed:
            self._diagnosis.check(waiting=self.placement is None)
            self.cycle()
            rate.sleep(stop.is_set)

    def cycle(self) -> None:
        """Find where the earth is in the world, then publish the fixes."""
        with self._lock:
            if self.placement is None:
                self._place()
                return
            if self._fix is not None and self._odometry is not None:
                self._placed.publish(self._odometry_of(self._fix, self.placement))
                self._fix = None
            if self._filtered is not None and self._odometry_is_new and self._odometry is not None:
                self._filtered.publish(self._fix_of(self._odometry, self.placement))
                self._odometry_is_new = False

    def _place(self) -> None:
        """Place the earth by the first fix, heading and pose."""
        start, attitude, world = self._start, self._attitude, self._world
        if start is None or attitude is None or world is None:
            return
        try:
            grid = EarthGrid(start, local=self.settings.use_local_cartesian, zone=self._zone)
        except Error as error:
            _LOG.error("%s", error)
            self._start = None
            return
        settings, place = self.settings, grid.point(start)
        yaw = attitude.yaw + settings.magnetic_declination_radians + settings.yaw_offset
        if not self._by_datum:
            upright = Pose(0.0, 0.0, 0.0, attitude.roll, attitude.pitch, yaw + grid.convergence)
            place = place - upright.rotate(self._antenna(0))
        self.placement = WorldPlacement(grid, world, place, yaw)
        if self._static is not None:
            transform = self._grid_transform(self.placement)
            self._static.publish(tf2_msgs.msg.TFMessage(transforms=[transform]))

    def _antenna(self, stamp: int) -> tuple[float, float, float]:
        """Return the place of the receiver on the robot [m]; its origin if that is not known."""
        found = None
        if self._gps_frame:
            found = self._transforms.find(self._base, self._gps_frame, stamp)
        return (0.0, 0.0, 0.0) if found is None else found.position

    def _grid_transform(self, placement: WorldPlacement) -> geometry_msgs.msg.TransformStamped:
        grid, world = self.settings.cartesian_frame_id, self._world_frame
        pose, message = placement.pose, geometry_msgs.msg.TransformStamped()
        message.header.frame_id, message.child_frame_id = world, grid
        if self.settings.broadcast_cartesian_transform_as_parent_frame:
            message.header.frame_id, message.child_frame_id = grid, world
            pose = pose.inverse()
        message.header.stamp = Time(nsecs=self._node.clock.now())
        z = 0.0 if self.settings.zero_altitude else pose.z
        set_point(message.transform.translation, (pose.x, pose.y, z))
        set_quaternion(message.transform.rotation, pose.quaternion)
        return message

    def _odometry_of(
        self, fix: sensor_msgs.msg.NavSatFix, placement: WorldPlacement
    ) -> nav_msgs.msg.Odometry:
        """Return a fix as the place of the robot in its world."""
        stamp = fix.header.stamp.to_nsec()
        found = placement.to_world(_place_of(fix))
        robot = self._transforms.find(self._world_frame, self._base, stamp)
        if robot is not None:
            found = found - robot.rotate(self._antenna(stamp))
        if self.settings.zero_altitude:
            found[2] = 0.0
        message = nav_msgs.msg.Odometry()
        message.header.stamp, message.header.frame_id = fix.header.stamp, self._world_frame
        message.child_frame_id = self._base
        set_point(message.pose.pose.position, found)
        set_quaternion(message.pose.pose.orientation, _UNIT)
        spread = np.zeros((6, 6))
        covariance = np.array(fix.position_covariance, float).reshape(3, 3)
        spread[:3, :3] = _turned(placement.pose, covariance)
        message.pose.covariance = spread.ravel().tolist()
        return message

    def _fix_of(
        self, odometry: nav_msgs.msg.Odometry, placement: WorldPlacement
    ) -> sensor_msgs.msg.NavSatFix:
        """Return the place of the robot on the earth."""
        message = sensor_msgs.msg.NavSatFix()
        message.header.stamp, message.header.frame_id = odometry.header.stamp, self._base
        _fill(message, placement.to_earth(np.array(point(odometry.pose.pose.position))))
        covariance = np.array(odometry.pose.covariance, float).reshape(6, 6)[:3, :3]
        turned = _turned(placement.pose.inverse(), covariance)
        message.position_covariance = turned.ravel().tolist()
        message.position_covariance_type = message.COVARIANCE_TYPE_KNOWN
        message.status.status = message.status.STATUS_GBAS_FIX
        return message

    # What comes -----------------------------------------------------------------------------

    def _take_odometry(self, message: nav_msgs.msg.Odometry) -> None:
        with self._lock:
            self._world_frame = message.header.frame_id.strip("/")
            self._base = message.child_frame_id.strip("/")
            self._odometry, self._odometry_is_new = message, True
            if self.placement is None and not self._by_datum:
                self._world = pose_of_message(message.pose.pose)
                if self.settings.use_odometry_yaw:
                    self._attitude = self._world

    def _take_fix(self, message: sensor_msgs.msg.NavSatFix) -> None:
        numbers = message.latitude, message.longitude, message.altitude
        if message.status.status == message.status.STATUS_NO_FIX or not all(
            math.isfinite(each) for each in numbers
        ):
            return
        with self._lock:
            self._gps_frame = message.header.frame_id.strip("/")
            if self.placement is None and not self._by_datum:
                self._start = _place_of(message)
            self._fix = message

    def _take_imu(self, message: sensor_msgs.msg.Imu) -> None:
        with self._lock:
            if self.placement is not None or self._world is None or self._by_datum:
                return
            frame = message.header.frame_id.strip("/") or self._base
            mounted = self._transforms.find(self._base, frame, message.header.stamp.to_nsec())
            if mounted is not None:
                turned = Pose.from_quaternion((0.0, 0.0, 0.0), quaternion(message.orientation))
                self._attitude = turned * mounted.inverse()

    def _set_datum(self, place: GeographicPlace, yaw: float) -> None:
        """Make a place the origin of the world, with a heading from east along x [rad]."""
        with self._lock:
            self._by_datum, self.placement = True, None
            self._start, self._world, self._attitude = place, Pose(), Pose(yaw=yaw)

    # Services -------------------------------------------------------------------------------

    def _datum(self, request: robot_localization.srv.SetDatumRequest) -> dict[str, Any]:
        pose = request.geo_pose
        turned = Pose.from_quaternion((0.0, 0.0, 0.0), quaternion(pose.orientation))
        self._set_datum(_place_of(pose.position), turned.yaw)
        return {}

    def _set_zone(self, request: robot_localization.srv.SetUTMZoneRequest) -> dict[str, Any]:
        with self._lock:
            self._zone = UtmZone.named(request.utm_zone)
            self._by_datum, self.placement, self._start = False, None, None
        return {}

    def _to_earth(self, request: robot_localization.srv.ToLLRequest) -> dict[str, Any]:
        found = self._known().to_earth(np.array(point(request.map_point)))
        response = robot_localization.srv.ToLLResponse()
        _fill(response.ll_point, found)
        return {"ll_point": response.ll_point}

    def _from_earth(self, request: robot_localization.srv.FromLLRequest) -> dict[str, Any]:
        found = self._known().to_world(_place_of(request.ll_point))
        if self.settings.zero_altitude:
            found[2] = 0.0
        response = geometry_msgs.msg.Point()
        set_point(response, found)
        return {"map_point": response}

    def _known(self) -> WorldPlacement:
        if self.placement is None:
            raise ServiceError("the geographic origin of the world is not known yet")
        return self.placement

    def _missing(self) -> list[str]:
        node = self._node
        required = (
            (self._world, "odometry/filtered", "odometry"),
            (self._start, "gps/fix", "fixes"),
            (self._attitude, "imu/data", "a heading"),
        )
        found = [f"{what} on {node.resolve(topic)}" for has, topic, what in required if has is None]
        if self._by_datum and self._start is None:
            found = ["a datum (the parameter 'datum' or the service of that name)"]
        return [*found, *self._transforms.described()]


def _place_of(message: Any) -> GeographicPlace:
    return GeographicPlace(message.latitude, message.longitude, message.altitude)


def _fill(message: Any, place: GeographicPlace) -> None:
    message.latitude, message.longitude = place.latitude, place.longitude
    message.altitude = place.altitude


def _turned(pose: Pose, covariance: Floats) -> Floats:
    turn = pose.matrix()[:3, :3]
    return np.asarray(turn @ covariance @ turn.T)
