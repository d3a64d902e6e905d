"""robot_pose_ekf on a graph."""

from __future__ import annotations

import math

import numpy as np
import pytest
from ros.graph import until

from gazelle.bridges.conversions import (
    pose_message,
    pose_of_message,
    pose_of_transform,
    set_quaternion,
)
from gazelle.bridges.navigation.robot_pose_ekf import RobotPoseEkfNode
from gazelle.description import Pose
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.clock import SimulatedClock
from gazelle_ros.msgs import robot_pose_ekf


@pytest.fixture
def graph():
    clock = SimulatedClock()
    clock.set(1_000_000_000)
    with Master(port=0, rosout=False) as master:
        node = Node("/robot", master_uri=master.uri, clock=clock)
        node.set_param("/robot_pose_ekf", {"vo_used": False})
        made = RobotPoseEkfNode(Node("/robot_pose_ekf", master_uri=master.uri, clock=clock))
        yield clock, node, made
        made._node.close()
        node.close()


def test_odometry_and_an_imu_give_pose_and_transform(graph):
    """The wheels slip and turn too far; the IMU knows the heading."""
    clock, node, made = graph
    odometries = node.advertise("/odom", load_message("nav_msgs/Odometry"))
    imus = node.advertise("/imu_data", load_message("sensor_msgs/Imu"))
    poses = []
    kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
    node.subscribe("/robot_pose_ekf/odom_combined", kind, poses.append)
    until(lambda: odometries.num_connections and imus.num_connections)
    until(lambda: made._poses.num_connections)
    assert made._missing() == ["messages on /odom", "messages on /imu_data"]
    place, said = Pose(), Pose()
    for step in range(1, 60):
        stamp = Time(nsecs=1_000_000_000 + step * 20_000_000)
        clock.set(stamp.to_nsec())
        place = place * Pose(x=0.02, yaw=0.01)
        said = said * Pose(x=0.02, yaw=0.015)
        odometry = odometries.message_class()
        odometry.header.stamp, odometry.pose.pose = stamp, pose_message(said)
        odometry.pose.covariance = np.diag([1e-4] * 5 + [1.0]).ravel().tolist()
        odometries.publish(odometry)
        imu = imus.message_class()
        imu.header.stamp, imu.header.frame_id = stamp, "base_footprint"
        set_quaternion(imu.orientation, (Pose(yaw=1.0) * place).quaternion)
        imus.publish(imu)
        until(lambda step=step: all(each.count == step for each in made.inputs.values()))
        made.cycle()
    until(lambda: poses and poses[-1].header.stamp == stamp)
    found = pose_of_message(poses[-1].pose.pose)
    # The first messages are not used, and each change counts along the heading before it.
    assert found.yaw == pytest.approx(place.yaw, abs=0.05)
    assert math.dist(found.position, place.position) < 0.06
    assert poses[-1].header.frame_id == "odom_combined"
    tree = made.frames.tree
    until(lambda: tree.has("odom_combined"))
    until(lambda: tree.latest_common_time("odom_combined", "base_footprint") == stamp.to_nsec())
    assert pose_of_transform(tree.lookup("odom_combined", "base_footprint")).is_close(found)
    service = robot_pose_ekf.srv.GetStatus
    status = (
        node.client("/robot_pose_ekf/get_status", service).call(service._request_class()).status
    )
    assert " * Odometry sensor\n   - is used\n   - is active\n   - received 59 messages" in status
    assert " * Visual Odometry sensor\n   - is NOT used\n   - is NOT active" in status
    clock.set(clock.now() + 2_000_000_000)
    made.cycle()
    assert not any(each.active for each in made.inputs.values())


def test_a_variance_of_zero_is_refused(graph, caplog):
    *_, made = graph
    message = load_message("nav_msgs/Odometry")()
    made._odometry("odom", message)
    assert "/odom is ignored: a variance of its pose is zero" in caplog.text
    assert not made.inputs["odom"].active
