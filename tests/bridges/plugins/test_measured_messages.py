"""Measurements of Gazebo's older plugins, as a client on a graph with a tf_prefix gets them."""

import math

import pytest
from models import GROUND, block, plugin
from plugin_graph import first, running
from test_state_plugins import ARM, RAYS, WALL

PREFIX = {"/tf_prefix": "r1"}
HINGE = ARM.format(gravity=1, kind="fixed", plugin="{plugin}")


def heard(model, topic, kind, *others):
    with running(model, *others, parameters=PREFIX) as graph:
        return first(graph, topic, kind)


def seen(filename, kind, **tags):
    tags = plugin(filename, topicName="seen", frameName="eye_link", **tags)
    model = block(RAYS.format(plugin=tags), gravity=False)
    return heard(model, "/seen", kind, WALL)


def body(filename, kind, **tags):
    tags = plugin(filename, bodyName="core", topicName="felt", **tags)
    return heard(block(plugin=tags, gravity=False), "/felt", kind)


def test_a_laser_tells_its_scan():
    scan = seen("libgazebo_ros_laser.so", "sensor_msgs/LaserScan")
    assert scan.header.frame_id == "r1/eye_link"
    assert (scan.angle_min, scan.angle_max) == pytest.approx((-0.2, 0.2))
    assert scan.angle_increment == pytest.approx(0.1)
    assert (scan.range_min, scan.range_max) == pytest.approx((0.05, 2.0))
    wanted = [0.8 / math.cos(angle) for angle in (-0.2, -0.1, 0.0, 0.1, 0.2)]
    assert list(scan.ranges) == pytest.approx(wanted, abs=1e-4)
    assert len(scan.intensities) == 5
    assert (scan.time_increment, scan.scan_time) == (0.0, 0.0)


def test_a_range_finder_tells_the_shortest():
    message = seen("libgazebo_ros_range.so", "sensor_msgs/Range", fov="0.3", radiation="infrared")
    assert (message.header.frame_id, message.radiation_type) == ("r1/eye_link", 1)
    assert message.range == pytest.approx(0.8, abs=1e-4)
    assert message.field_of_view == pytest.approx(0.3)
    assert (message.min_range, message.max_range) == pytest.approx((0.05, 2.0))


def test_a_true_pose_has_its_frames_and_variances():
    message = body("libgazebo_ros_p3d.so", "nav_msgs/Odometry", gaussianNoise="0.1")
    assert (message.header.frame_id, message.child_frame_id) == ("r1/world", "core")
    assert message.pose.pose.position.z == pytest.approx(0.5, abs=1e-6)
    assert message.pose.pose.orientation.w == pytest.approx(1.0)
    diagonal = [message.pose.covariance[i * 7] for i in range(6)]
    assert diagonal == pytest.approx([0.01] * 6)
    assert [message.twist.covariance[i * 7] for i in range(6)] == pytest.approx([0.01] * 6)


def test_an_imu_leaves_its_frame_as_it_is():
    message = body("libgazebo_ros_imu.so", "sensor_msgs/Imu", frameName="imu_link")
    assert message.header.frame_id == "imu_link"
    assert message.orientation.w == pytest.approx(1.0)
    assert message.angular_velocity.z == pytest.approx(0.0, abs=1e-9)


def test_the_forces_on_a_body_are_told():
    message = body("libgazebo_ros_f3d.so", "geometry_msgs/WrenchStamped", frameName="base")
    assert message.header.frame_id == "r1/base"
    assert message.wrench.force.z == pytest.approx(0.0, abs=1e-6)


def test_what_a_joint_bears_is_told_in_the_frame_of_its_child():
    tags = plugin("libgazebo_ros_ft_sensor.so", jointName="elbow", topicName="load")
    message = heard(HINGE.format(plugin=tags), "/load", "geometry_msgs/WrenchStamped")
    assert message.header.frame_id == "r1/tip"
    assert abs(message.wrench.force.z) == pytest.approx(2.0 * 9.8, rel=1e-3)
    assert abs(message.wrench.torque.y) == pytest.approx(9.8, rel=1e-3)


def test_joints_are_told_by_name():
    tags = plugin("libgazebo_ros_joint_state_publisher.so", jointName="elbow")
    arm = ARM.format(gravity=0, kind="revolute", plugin=tags)
    message = heard(arm, "/arm/joint_states", "sensor_msgs/JointState")
    assert message.name == ["elbow"]
    assert (len(message.position), len(message.velocity), len(message.effort)) == (1, 1, 0)


def test_a_bumper_tells_what_touches_it():
    sensor = """<sensor name="skin" type="contact"><update_rate>50</update_rate><contact><collision>
    hull</collision></contact>{plugin}</sensor>"""
    tags = plugin("libgazebo_ros_bumper.so", bumperTopicName="touch", frameName="core")
    model = block(sensor.format(plugin=tags)).replace("0 0 0.5", "0 0 0.1")
    with running(model, GROUND, parameters=PREFIX) as graph:
        while not (message := first(graph, "/touch", "gazebo_msgs/ContactsState")).states:
            pass
    assert message.header.frame_id == "r1/core"
    state = message.states[0]
    assert {state.collision1_name, state.collision2_name} >= {"cube::core::hull"}
    count = len(state.depths)
    assert count == len(state.contact_positions) == len(state.contact_normals)
    assert count == len(state.wrenches)
    assert sum(wrench.force.z for wrench in state.wrenches) == pytest.approx(
        state.total_wrench.force.z
    )


@pytest.mark.parametrize(
    ("kind", "count"),
    [
        ("sensor_msgs/LaserScan", lambda message: len(message.ranges)),
        ("sensor_msgs/PointCloud", lambda message: len(message.points)),
        ("sensor_msgs/PointCloud2", lambda message: message.width),
        ("sensor_msgs/Range", lambda message: 5 * (message.range > 0.0)),
    ],
)
def test_rays_come_as_the_message_that_is_asked_for(kind, count):
    tags = plugin("libgazebo_ros_ray_sensor.so", output_type=kind, topicName="seen")
    model = block(RAYS.format(plugin=tags), gravity=False)
    assert count(heard(model, "/seen", kind, WALL)) == 5
