"""ekf_localization_node and ukf_localization_node on a graph."""

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
from gazelle.bridges.navigation import localization_filter
from gazelle.description import Pose
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.clock import SimulatedClock
from gazelle_ros.msgs import robot_localization, std_srvs

SPEED, TURN, STEP_NS = 0.8, 0.4, 20_000_000
FLAT = [False] * 6 + [True, True, False, False, False, True] + [False] * 3
HEADING = [False] * 5 + [True] + [False] * 5 + [True] + [False] * 3


class Drive:
    """A robot on a circle, whose wheels and IMU a test reads out."""

    def __init__(self, uri, parameters, kind="extended"):
        self.clock, self.now = SimulatedClock(), 1_000_000_000
        self.clock.set(self.now)
        self.node = Node("/simulator", master_uri=uri, clock=self.clock)
        self.node.set_param("/ekf", {"frequency": 50.0, "two_d_mode": True, **parameters})
        self.wheels = self.node.advertise("/wheels", load_message("nav_msgs/Odometry"))
        self.imus = self.node.advertise("/imu", load_message("sensor_msgs/Imu"))
        self.tf = self.node.advertise("/tf_static", load_message("tf2_msgs/TFMessage"), latch=True)
        self.estimates = []
        kind_of = load_message("nav_msgs/Odometry")
        self.node.subscribe("/odometry/filtered", kind_of, self.estimates.append)
        prediction = getattr(localization_filter, f"_{kind}")
        self.filter = localization_filter.LocalizationFilterNode(
            Node("/ekf", master_uri=uri, clock=self.clock), prediction
        )
        self.tree = self.filter.frames.tree
        until(lambda: self.tf.num_connections)

    def truth(self):
        """Return where the robot is: on a circle through the origin."""
        yaw = TURN * (self.now * 1e-9 - 1.0)
        radius = SPEED / TURN
        return Pose(x=radius * math.sin(yaw), y=radius * (1.0 - math.cos(yaw)), yaw=yaw)

    def mount(self, child, pose, parent="base_link"):
        """Place a frame on the robot."""
        link = load_message("geometry_msgs/TransformStamped")()
        link.header.frame_id, link.child_frame_id = parent, child
        set_point(link.transform.translation, pose.position)
        set_quaternion(link.transform.rotation, pose.quaternion)
        self.tf.publish(self.tf.message_class(transforms=[link]))
        until(lambda: self.tree.has(child))

    def advance(self, imu=None):
        """Move on by a step, publish the wheels' speed and an IMU's heading, and estimate."""
        self.now += STEP_NS
        self.clock.set(self.now)
        wheels = self.wheels.message_class()
        wheels.header.stamp, wheels.header.frame_id = Time(nsecs=self.now), "odom"
        wheels.child_frame_id = "base_link"
        wheels.twist.twist.linear.x, wheels.twist.twist.angular.z = SPEED, TURN
        wheels.twist.covariance[0] = wheels.twist.covariance[7] = 1e-4
        wheels.twist.covariance[35] = 1e-4
        seen = self.seen()
        self.wheels.publish(wheels)
        if imu is not None:
            message = self.imus.message_class()
            message.header.stamp, message.header.frame_id = wheels.header.stamp, "imu_link"
            set_quaternion(message.orientation, (self.truth() * imu).quaternion)
            message.angular_velocity.z = TURN
            message.orientation_covariance[8] = message.angular_velocity_covariance[8] = 1e-4
            self.imus.publish(message)
        until(lambda: self.seen() == seen + 1 + (imu is not None))
        self.filter.cycle()

    def seen(self):
        return sum(each.seen for each in self.filter._sources)

    def estimate(self):
        """Return the message of the last estimate."""
        until(lambda: self.estimates and self.estimates[-1].header.stamp.to_nsec() == self.now)
        return self.estimates[-1]

    def close(self):
        self.filter._node.close()
        self.node.close()


@pytest.fixture
def start():
    made = []
    with Master(port=0, rosout=False) as master:

        def make(parameters, kind="extended"):
            made.append(Drive(master.uri, parameters, kind))
            drive = made[-1]
            wanted = [each.topic for each in drive.filter._sources if each._settings.used.any()]
            until(lambda: drive.wheels.num_connections + drive.imus.num_connections == len(wanted))
            return drive

        yield make
        for each in made:
            each.close()


WHEELS = {"odom0": "wheels", "odom0_config": FLAT, "odom0_queue_size": 10}
IMU = {"imu0": "imu", "imu0_config": HEADING, "imu0_queue_size": 10}


@pytest.mark.parametrize("kind", ["extended", "unscented"])
def test_wheels_and_a_turned_imu_give_odometry_and_its_transform(start, kind):
    """The IMU is mounted with a yaw of 1 rad, which the estimate does not show."""
    drive = start({**WHEELS, **IMU}, kind)
    mounted = Pose(x=0.1, yaw=1.0)
    drive.mount("imu_link", mounted)
    for _ in range(100):
        drive.advance(imu=Pose(yaw=1.0))
    message = drive.estimate()
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_link")
    # The first message sets the velocity 20 ms after the start: 16 mm of way are missing.
    assert pose_of_message(message.pose.pose).is_close(drive.truth(), position=0.03, angle=0.01)
    assert message.twist.twist.linear.x == pytest.approx(SPEED, abs=1e-3)
    assert message.twist.twist.angular.z == pytest.approx(TURN, abs=1e-3)
    assert 0.0 < message.pose.covariance[35] < 1e-3
    until(
        lambda: drive.tree.has("base_link") and drive.tree.latest_common_time("odom", "base_link")
    )
    until(lambda: drive.tree.latest_common_time("odom", "base_link") == drive.now)
    found = pose_of_transform(drive.tree.lookup("odom", "base_link"))
    assert found.is_close(pose_of_message(message.pose.pose))


def test_in_a_map_the_odometry_is_placed(start):
    drive = start({**WHEELS, "world_frame": "map", "transform_time_offset": 0.5})
    drive.mount("base_link", Pose(x=0.5, yaw=0.2), parent="odom")
    for _ in range(5):
        drive.advance()
    base = pose_of_message(drive.estimate().pose.pose)
    stamp = drive.now + 500_000_000
    until(lambda: drive.tree.has("map"))
    until(lambda: drive.tree.latest_common_time("map", "odom") == stamp)
    assert (pose_of_transform(drive.tree.lookup("map", "odom")) * Pose(x=0.5, yaw=0.2)).is_close(
        base
    )


def test_without_a_transform_the_node_says_what_it_waits_for(start):
    drive = start({**WHEELS, **IMU})
    assert drive.filter._missing() == ["messages on /wheels", "messages on /imu"]
    drive.advance(imu=Pose())
    (text,) = drive.filter._missing()
    assert "a transform from 'imu_link' to 'base_link'" in text
    drive.mount("imu_link", Pose())
    drive.advance(imu=Pose())
    assert drive.filter._missing() == []


def test_the_pose_is_set_by_topic_and_by_service(start):
    drive = start(WHEELS)
    for _ in range(3):
        drive.advance()
    wanted = Pose(x=5.0, y=-3.0, yaw=2.0)
    covariant = load_message("geometry_msgs/PoseWithCovarianceStamped")
    message = covariant()
    message.header.stamp, message.header.frame_id = Time(nsecs=drive.now), "odom"
    message.pose.pose = pose_message(wanted)
    message.pose.covariance = (0.01 * np.eye(6)).ravel().tolist()
    service = robot_localization.srv.SetPose
    drive.node.client("/set_pose", service).call(service._request_class(pose=message))
    estimate = drive.filter.kalman.estimate
    np.testing.assert_allclose(estimate.state[:6], [5.0, -3.0, 0, 0, 0, 2.0], atol=1e-12)
    assert estimate.covariance[5, 5] == pytest.approx(0.01)
    drive.advance()
    after = pose_of_message(drive.estimate().pose.pose)
    assert after.is_close(wanted, position=0.05, angle=0.05)
    poses = drive.node.advertise("/set_pose", covariant)
    until(lambda: poses.num_connections)
    message.pose.pose = pose_message(Pose(x=1.0))
    poses.publish(message)
    until(lambda: abs(drive.filter.kalman.estimate.state[0] - 1.0) < 1e-9)


def test_processing_is_toggled_and_enabled(start):
    drive = start({**WHEELS, "disabled_at_startup": True})
    drive.advance()
    assert not drive.filter.kalman.initialised
    drive.node.client("/ekf/enable", std_srvs.srv.Empty).call(std_srvs.srv.EmptyRequest())
    drive.advance()
    assert drive.filter.kalman.initialised
    service = robot_localization.srv.ToggleFilterProcessing
    toggle, off = drive.node.client("/ekf/toggle", service), service._request_class(on=False)
    assert [toggle.call(off).status, toggle.call(off).status] == [True, False]
    before = drive.filter.kalman.estimate.state
    drive.advance()
    assert drive.filter.kalman.estimate.state is before
    assert drive.estimate().twist.twist.linear.x == pytest.approx(SPEED)


@pytest.mark.parametrize("again", [False, True])
def test_old_messages_are_ignored_unless_time_begins_again(start, again):
    drive = start({**WHEELS, "reset_on_time_jump": again})
    for _ in range(3):
        drive.advance()
    last = drive.now
    drive.now = 900_000_000
    drive.advance()
    assert drive.filter.kalman.estimate.stamp == (drive.now if again else last)
    assert ("odom0_twist" in drive.filter._warnings) == (not again)


def test_corrections_of_what_was_published_are_not(start):
    drive = start(WHEELS)
    drive.advance()
    drive.estimate()
    drive.filter.cycle()
    drive.advance()
    drive.estimate()
    assert len(drive.estimates) == 2


def test_accelerations_and_diagnostics_are_published(start):
    drive = start({**WHEELS, "publish_acceleration": True})
    accelerations, reports = [], []
    kind = load_message("geometry_msgs/AccelWithCovarianceStamped")
    drive.node.subscribe("/accel/filtered", kind, accelerations.append)
    drive.node.subscribe(
        "/diagnostics", load_message("diagnostic_msgs/DiagnosticArray"), reports.append
    )
    until(lambda: drive.filter._accelerations.num_connections)
    until(lambda: drive.filter._diagnostics.num_connections)
    for _ in range(3):
        drive.advance()
    drive.filter._warn("odom0_twist", "a message is older than the one before it")
    drive.filter._report(drive.now, 3 * STEP_NS * 1e-9)
    until(lambda: len(accelerations) == 3 and reports)
    assert accelerations[-1].header.frame_id == "base_link"
    state, topic = reports[0].status
    assert (state.level, state.values[0].key) == (state.WARN, "odom0_twist")
    assert topic.message == "Desired frequency met"
