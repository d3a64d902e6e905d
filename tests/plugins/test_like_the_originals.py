"""Rules of Gazebo's plugins that are easily missed."""

import numpy as np
import pytest
from models import base, block, plugin, simulate
from test_state_plugins import ARM, RAYS

from gazelle import Pose, formats
from gazelle.errors import PluginWarning

SIZES = {"wheelSeparation": "0.4", "wheelDiameter": "0.2", "wheelTorque": "20"}


def drive(left, right, **tags):
    tags = {"leftJoint": left, "rightJoint": right, **SIZES, **tags}
    return plugin("libgazebo_ros_diff_drive.so", **tags)


def count(sim, output, seconds=1.0):
    heard = []
    output.subscribe(heard.append)
    sim.run(seconds=seconds)
    return len(heard)


def test_a_base_may_have_a_drive_for_each_pair_of_wheels():
    with simulate(base(drive("joint0", "joint1") + drive("joint2", "joint3"))) as sim:
        robot = sim.robots["base"]
        topics = [port.topic for port in robot.inputs.values()]
        assert topics == ["/base/cmd_vel"] * 2
        assert [port.topic for port in robot.outputs.values()].count("/base/odom") == 2
        for port in robot.inputs.values():
            port.send(linear=0.3)
        sim.run(seconds=1.0)
        for name in ("joint0", "joint1", "joint2", "joint3"):
            assert robot.joints[name].velocity == pytest.approx(3.0, rel=0.05)
        sim.reset()
        sim.run(seconds=0.2)
        assert abs(robot.joints["joint0"].velocity) < 0.01


def test_a_drive_with_the_tags_of_ros_2_says_so():
    tags = plugin("libgazebo_ros_diff_drive.so", left_joint="joint0", right_joint="joint1")
    with pytest.raises(PluginWarning, match=r"has the tags of ROS 2.*<leftJoint>"):
        simulate(base(tags))


def test_joints_may_be_told_by_several_plugins_on_one_topic():
    told = plugin("libgazebo_ros_joint_state_publisher.so", jointName="joint2")
    wheels = drive("joint0", "joint1", publishWheelJointState="true")
    with simulate(base(wheels + told)) as sim:
        outputs = [o for o in sim.robots["base"].outputs.values() if "joint_states" in o.topic]
        assert {output.topic for output in outputs} == {"/base/joint_states"}
        assert {output.last.names for output in outputs} == {("joint1", "joint0"), ("joint2",)}


def test_a_drives_odometry_tells_the_motion_on_the_ground():
    with simulate(base(drive("joint0", "joint1")), ground=False) as sim:
        robot = sim.robots["base"]
        # Nose up, heading to the left, falling and rolling over.
        robot.set_pose((0.0, 0.0, 2.0), Pose(0, 0, 0, 0.0, -0.3, np.pi / 2).quaternion)
        robot.set_twist((0.1, 0.5, -0.7), (0.4, 0.3, 0.2))
        odometry = robot.outputs["odom"].last
        x, y, _ = robot.twist.linear
        assert odometry.linear[0] == pytest.approx([y, -x, 0.0], abs=1e-6)
        assert odometry.angular[0] == pytest.approx([0.0, 0.0, 0.2], abs=1e-6)
        assert odometry.quaternion[0] == pytest.approx(robot.quaternion[0])


@pytest.mark.parametrize(
    ("model", "queues"),
    [
        (
            base(drive("joint0", "joint1", publishWheelTF="true", publishWheelJointState="true")),
            {"odom": 1, "odom_tf": 100, "wheel_tf": 100, "joint_states": 1000},
        ),
        (
            block(plugin=plugin("libgazebo_ros_hand_of_god.so", linkName="core")),
            {"hog_actual": 100, "hog_desired": 100, "hog_static": 100},
        ),
        (
            block(plugin=plugin("libhector_gazebo_ros_gps.so")),
            {"fix": 10, "fix_velocity": 10},
        ),
        (block(plugin=plugin("libhector_gazebo_ros_magnetic.so")), {"magnetic": 1}),
        (block(plugin=plugin("libhector_gazebo_ros_imu.so")), {"imu": 10, "imu/bias": 10}),
        (
            block(plugin=plugin("libgazebo_ros_joint_pose_trajectory.so")),
            {"set_joint_trajectory": 100},
        ),
        (block(RAYS.format(plugin=plugin("libgazebo_ros_laser.so"))), {"world": 1}),
    ],
)
def test_queues_have_the_length_of_the_originals(model, queues):
    with simulate(model, ground=False) as sim:
        robot = next(iter(sim.robots.values()))
        ports = {**robot.inputs, **robot.outputs}
        assert {name: ports[name].queue_size for name in queues} == queues


def test_wheel_frames_hang_on_the_link_that_bears_the_wheel():
    with simulate(base(drive("joint0", "joint1", publishWheelTF="true"))) as sim:
        frames = sim.robots["base"].outputs["wheel_tf"].last.transforms
        assert [(f.frame, f.child_frame) for f in frames] == [
            ("body", "wheel1"),
            ("body", "wheel0"),
        ]
        assert frames[0].position[0] == pytest.approx([0.2, -0.2, -0.02], abs=1e-3)


@pytest.mark.parametrize(("rate", "heard"), [("5", 5), ("50", 20), ("0", 20)])
def test_a_range_finder_is_no_quicker_than_its_sensor(rate, heard):
    tags = plugin("libgazebo_ros_range.so", topicName="t", updateRate=rate)
    with simulate(block(RAYS.format(plugin=tags), gravity=False), ground=False) as sim:
        assert count(sim, sim.robots["cube"].outputs["t"]) == pytest.approx(heard, abs=1)


@pytest.mark.parametrize(("own", "rate", "heard"), [(20, "50", 20), (20, "5", 5), (0, "50", 50)])
def test_an_imu_sensors_plugin_is_no_quicker_than_its_sensor(own, rate, heard):
    tags = plugin("libgazebo_ros_imu_sensor.so", topicName="t", updateRateHZ=rate)
    sensor = f'<sensor name="s" type="imu"><update_rate>{own}</update_rate>{tags}</sensor>'
    with simulate(block(sensor, gravity=False), ground=False) as sim:
        assert count(sim, sim.robots["cube"].outputs["t"]) == pytest.approx(heard, abs=1)


def test_an_imu_sensors_offset_turns_what_is_measured():
    tags = plugin("libgazebo_ros_imu_sensor.so", topicName="t", rpyOffset="0 0 1.5707963267949")
    sensor = f'<sensor name="s" type="imu">{tags}</sensor>'
    with simulate(block(sensor, gravity=False), ground=False) as sim:
        robot = sim.robots["cube"]
        half = np.sqrt(0.5)
        robot.set_pose((0.0, 0.0, 1.0), (half, 0.0, 0.0, half))
        # A quarter turn about the world's z after one about x.
        orientation = robot.outputs["t"].last.orientation[0]
        assert orientation == pytest.approx([0.5, 0.5, 0.5, 0.5], abs=1e-6)


@pytest.mark.parametrize(("tag", "topic"), [({}, "/cube/t"), ({"robotNamespace": ""}, "/t")])
def test_an_imu_sensor_without_a_namespace_takes_the_models_name(tag, topic):
    tags = plugin("libgazebo_ros_imu_sensor.so", topicName="t", **tag)
    sensor = f'<sensor name="s" type="imu">{tags}</sensor>'
    with simulate(block(sensor, gravity=False), ground=False) as sim:
        assert sim.robots["cube"].outputs["t"].topic == topic


def test_forces_on_a_body_come_at_every_step_whatever_the_tag_says():
    tags = plugin("libgazebo_ros_f3d.so", bodyName="core", topicName="t", updateRate="10")
    with simulate(block(plugin=tags, gravity=False), ground=False) as sim:
        assert count(sim, sim.robots["cube"].outputs["t"], 0.1) == pytest.approx(100, abs=1)


@pytest.mark.parametrize(
    ("filename", "tags", "output"),
    [
        ("libgazebo_ros_p3d.so", {"bodyName": "arm::tip", "topicName": "t"}, "t"),
        ("libgazebo_ros_imu.so", {"bodyName": "arm::tip"}, "imu"),
        ("libgazebo_ros_f3d.so", {"bodyName": "arm::tip", "topicName": "t"}, "t"),
        ("libgazebo_ros_ft_sensor.so", {"jointName": "arm::elbow", "topicName": "t"}, "t"),
        ("libgazebo_ros_joint_state_publisher.so", {"jointName": "arm::elbow"}, "joint_states"),
    ],
)
def test_names_may_have_their_models_before_them(filename, tags, output):
    arm = ARM.format(gravity=0, kind="revolute", plugin=plugin(filename, **tags))
    with simulate(arm, ground=False) as sim:
        port = sim.robots["arm"].outputs[output]
        assert port.frame in ("", "tip", "arm::tip", "world")
        assert getattr(port.last, "names", ("elbow",)) == ("elbow",)


def test_an_empty_namespace_keeps_away_the_one_of_the_spawn():
    given = plugin(
        "libgazebo_ros_ft_sensor.so", jointName="elbow", topicName="a", robotNamespace=""
    )
    left_out = plugin("libgazebo_ros_ft_sensor.so", jointName="elbow", topicName="b")
    arm = ARM.format(gravity=0, kind="fixed", plugin=given + left_out)
    with simulate(ground=False) as sim:
        model = formats.load_string(f'<sdf version="1.6">{arm}</sdf>').models[0]
        outputs = sim.spawn(model, namespace="/r1").outputs
        assert [port.topic for port in outputs.values()] == ["/a", "/r1/b"]
