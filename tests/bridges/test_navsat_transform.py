"""navsat_transform_node on a graph."""

from __future__ import annotations

import math

import numpy as np
import pytest
from ros.graph import until

from gazelle.bridges.conversions import (
    pose_message,
    pose_of_message,
    pose_of_transform,
    set_point,
    set_quaternion,
)
from gazelle.bridges.navigation.navsat_transform import NavsatTransformNode
from gazelle.description import Pose
from gazelle.errors import Error
from gazelle.navigation.estimation.navsat import EarthGrid, GeographicPlace, NavsatSettings
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.clock import SimulatedClock
from gazelle_ros.errors import ServiceError
from gazelle_ros.msgs import robot_localization

ORIGIN = GeographicPlace(49.9, 8.9, 120.0)
ANTENNA = Pose(x=-0.4, y=0.1, z=0.5)


class Rover:
    """A robot whose world begins where the test says on the earth.

    Its world is turned by an angle from the grid of the earth.
    """

    def __init__(self, uri, parameters, *, turn=0.7):
        self.turn, self.now = turn, 1_000_000_000
        local = parameters.get("use_local_cartesian", False)
        self.grid = EarthGrid(ORIGIN, local=local)
        east, north, up = self.grid.point(ORIGIN).tolist()
        self.world = Pose(east, north, up, yaw=turn)
        self.clock = SimulatedClock()
        self.clock.set(self.now)
        self.node = Node("/rover", master_uri=uri, clock=self.clock)
        self.node.set_param("/navsat", parameters)
        self.odometry = self.node.advertise("/odometry/filtered", load_message("nav_msgs/Odometry"))
        self.fixes = self.node.advertise("/gps/fix", load_message("sensor_msgs/NavSatFix"))
        self.imus = self.node.advertise("/imu/data", load_message("sensor_msgs/Imu"))
        self.tf = self.node.advertise("/tf", load_message("tf2_msgs/TFMessage"))
        self.placed, self.filtered = [], []
        kind = load_message("nav_msgs/Odometry")
        self.node.subscribe("/odometry/gps", kind, self.placed.append)
        kind = load_message("sensor_msgs/NavSatFix")
        self.node.subscribe("/gps/filtered", kind, self.filtered.append)
        self.made = NavsatTransformNode(Node("/navsat", master_uri=uri, clock=self.clock))
        self.tree = self.made.frames.tree
        until(lambda: self.tf.num_connections and self.fixes.num_connections)
        until(lambda: self.odometry.num_connections)

    def tell(self, pose, *, heading=None):
        """Publish a pose of the world, the fix of the antenna there, and an IMU's heading."""
        self.now += 100_000_000
        self.clock.set(self.now)
        self._frames(pose)
        stamp = Time(nsecs=self.now)
        odometry = self.odometry.message_class(child_frame_id="base_link")
        odometry.header.stamp, odometry.header.frame_id = stamp, "odom"
        odometry.pose.pose = pose_message(pose)
        self.odometry.publish(odometry)
        until(lambda: self.made._odometry and self.made._odometry.header.stamp == stamp)
        if heading is not None:
            imu = self.imus.message_class()
            imu.header.stamp, imu.header.frame_id = stamp, "base_link"
            set_quaternion(imu.orientation, Pose(yaw=heading).quaternion)
            self.imus.publish(imu)
            until(lambda: self.made._attitude or self.made.placement)
        place = self.grid.place(np.array((self.world * pose * ANTENNA).position))
        fix = self.fixes.message_class(
            latitude=place.latitude, longitude=place.longitude, altitude=place.altitude
        )
        fix.header.stamp, fix.header.frame_id = stamp, "gps"
        fix.position_covariance = np.diag([4.0, 1.0, 9.0]).ravel().tolist()
        self.fixes.publish(fix)
        until(lambda: self.made._fix and self.made._fix.header.stamp == stamp)
        self.made.cycle()

    def _frames(self, pose):
        links = []
        for parent, child, at in (("odom", "base_link", pose), ("base_link", "gps", ANTENNA)):
            link = load_message("geometry_msgs/TransformStamped")()
            link.header.stamp, link.header.frame_id = Time(nsecs=self.now), parent
            link.child_frame_id = child
            set_point(link.transform.translation, at.position)
            set_quaternion(link.transform.rotation, at.quaternion)
            links.append(link)
        self.tf.publish(self.tf.message_class(transforms=links))
        until(lambda: self.tree.has("gps"))
        until(lambda: self.tree.latest_common_time("odom", "gps") == self.now)

    def place(self):
        """Return the last place that the node published."""
        until(lambda: self.placed and self.placed[-1].header.stamp.to_nsec() == self.now)
        return self.placed[-1]

    def close(self):
        self.made._node.close()
        self.node.close()


@pytest.fixture
def start():
    made = []
    with Master(port=0, rosout=False) as master:

        def make(parameters, **keywords):
            made.append(Rover(master.uri, parameters, **keywords))
            return made[-1]

        yield make
        for each in made:
            each.close()


FIRST, SECOND = Pose(x=1.0, y=2.0, yaw=0.3), Pose(x=6.0, y=-1.0, z=0.5, yaw=-1.0)


@pytest.mark.parametrize("local", [False, True])
def test_fixes_are_places_of_the_robot_in_its_world(start, local):
    """The IMU's zero is 0.2 rad beside east, of which a half is declination."""
    rover = start(
        {
            "use_local_cartesian": local, "publish_filtered_gps": True,
            "magnetic_declination_radians": 0.1, "yaw_offset": 0.1,
        }
    )  # fmt: skip
    convergence = rover.grid.convergence
    assert (abs(convergence) > 1e-3) == (not local)
    until(lambda: rover.imus.num_connections)
    rover.tell(FIRST, heading=rover.turn + FIRST.yaw - convergence - 0.2)
    rover.tell(SECOND)
    message = rover.place()
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_link")
    found = pose_of_message(message.pose.pose)
    np.testing.assert_allclose(found.position, SECOND.position, atol=2e-5)
    covariance = np.array(message.pose.covariance).reshape(6, 6)
    turn = Pose(yaw=-rover.turn).matrix()[:3, :3]
    np.testing.assert_allclose(covariance[:3, :3], turn @ np.diag([4, 1, 9]) @ turn.T, atol=1e-6)
    until(lambda: rover.filtered)
    fix, place = rover.filtered[-1], rover.grid.place(np.array((rover.world * SECOND).position))
    assert fix.latitude == pytest.approx(place.latitude, abs=1e-9)
    assert fix.longitude == pytest.approx(place.longitude, abs=1e-9)
    assert fix.altitude == pytest.approx(place.altitude, abs=1e-5)


def test_the_grid_is_placed_as_the_world_s_parent(start):
    rover = start({
        "broadcast_utm_transform": True, "broadcast_utm_transform_as_parent_frame": True,
        "use_odometry_yaw": True, "yaw_offset": 0.7,
    })  # fmt: skip
    rover.tell(FIRST)
    until(lambda: rover.tree.has("utm"))
    found = pose_of_transform(rover.tree.lookup("utm", "odom"))
    assert found.yaw == pytest.approx(rover.turn + rover.grid.convergence)
    assert (found * FIRST).position == pytest.approx((rover.world * FIRST).position, abs=0.02)


def test_a_datum_is_the_origin_of_the_world(start):
    rover = start(
        {"wait_for_datum": True, "datum": [ORIGIN.latitude, ORIGIN.longitude, 0.7, "map", "base"]},
    )
    convergence = rover.grid.convergence
    rover.made.cycle()
    rover.tell(FIRST)
    found = pose_of_message(rover.place().pose.pose)
    turned = Pose(yaw=-convergence) * FIRST
    np.testing.assert_allclose(found.position[:2], turned.position[:2], atol=0.02)
    srv = robot_localization.srv
    to_earth = rover.node.client("/toLL", srv.ToLL)
    from_earth = rover.node.client("/fromLL", srv.FromLL)
    request = srv.ToLL._request_class()
    request.map_point.x, request.map_point.y = 100.0, 50.0
    place = to_earth.call(request).ll_point
    back = srv.FromLL._request_class(ll_point=place)
    assert from_earth.call(back).map_point.x == pytest.approx(100.0, abs=1e-6)
    assert from_earth.call(back).map_point.y == pytest.approx(50.0, abs=1e-6)
    assert math.hypot(place.latitude - ORIGIN.latitude, place.longitude - ORIGIN.longitude) > 1e-4


def test_services_set_the_datum_and_the_zone(start):
    rover = start({"wait_for_datum": True})
    srv = robot_localization.srv
    with pytest.raises(ServiceError, match="not known yet"):
        rover.node.client("/toLL", srv.ToLL).call(srv.ToLL._request_class())
    assert rover.made._missing() == ["a datum (the parameter 'datum' or the service of that name)"]
    request = srv.SetDatum._request_class()
    request.geo_pose.position.latitude, request.geo_pose.position.longitude = 51.0, 7.0
    request.geo_pose.orientation.w = 1.0
    rover.node.client("/datum", srv.SetDatum).call(request)
    rover.made.cycle()
    place = rover.node.client("/toLL", srv.ToLL).call(srv.ToLL._request_class()).ll_point
    assert (place.latitude, place.longitude) == pytest.approx((51.0, 7.0))
    zone = srv.SetUTMZone._request_class(utm_zone="33U")
    rover.node.client("/setUTMZone", srv.SetUTMZone).call(zone)
    assert rover.made.placement is None
    assert rover.made._zone.number == 33


def test_fixes_without_a_position_do_not_count(start):
    rover = start({"use_odometry_yaw": True})
    fix = rover.fixes.message_class(latitude=math.nan)
    rover.made._take_fix(fix)
    fix = rover.fixes.message_class(latitude=1.0)
    fix.status.status = fix.status.STATUS_NO_FIX
    rover.made._take_fix(fix)
    assert rover.made._start is None


def test_wrong_parameters_are_errors_and_unknown_ones_logged(caplog):
    NavsatSettings.read({"zero_altitud": True})
    assert "~/zero_altitud is an unknown parameter; did you mean 'zero_altitude'" in caplog.text
    with pytest.raises(Error, match="'datum' is latitude and longitude"):
        NavsatSettings.read({"wait_for_datum": True, "datum": "here"})
    with pytest.raises(Error, match="frequency must be above 0"):
        NavsatSettings.read({"frequency": -1.0})
